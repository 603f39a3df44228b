// One key of a text changed, and nothing else.

#include "host/studio/edit.h"

#include "host/core/error.h"
#include "host/core/file.h"
#include "tests/support/catch.h"

using namespace vkdose;
using studio::edited;

namespace {

const std::string kText =
    "# A remark that stays.\n"
    "name = \"mine\"  # of the case\n"
    "\n"
    "[contact]  # how spheres touch\n"
    "friction = 0.5   # measured\n"
    "\n"
    "[contact.wall]\n"
    "friction = 0.5\n"
    "\n"
    "[[body]]\n"
    "name = 'floor'\n"
    "at = [0, 0,\n"
    "  0]  # over two lines\n"
    "\n"
    "[[body]]\n"
    "name = 'lid'\n"
    "inline = {a = 1, b = 1}\n"
    "[body.motion]\n"
    "kind = \"slide\"\n";

std::string replaced(std::string text, const std::string& was, const std::string& is) {
    const std::size_t at = text.find(was);
    REQUIRE(at != std::string::npos);
    return text.replace(at, was.size(), is);
}

std::string with(const std::string& was, const std::string& is) {
    return replaced(kText, was, is);
}

}  // namespace

TEST_CASE("a text tells what it states, and where") {
    const auto all = studio::statedIn(kText);
    REQUIRE(all.size() == 9);
    CHECK(all[0].key == "name");
    CHECK(all[2].key == "contact.wall.friction");
    CHECK(all[2].line == 8);
    CHECK(all[4].key == "body[0].at");
    CHECK(all[4].text == "[0, 0, 0]");
    CHECK(all[8].key == "body[1].motion.kind");
    CHECK_THROWS_AS(studio::statedIn("["), CaseError);
}

TEST_CASE("a value is changed where it stands, and its remark stays") {
    CHECK(edited(kText, "name", "\"yours\"") == with("\"mine\"", "\"yours\""));
    CHECK(edited(kText, "contact.friction", "0.25") == with("friction = 0.5   #", "friction = 0.25   #"));
    CHECK(edited(kText, "contact.wall.friction", "0.25") ==
          with("[contact.wall]\nfriction = 0.5", "[contact.wall]\nfriction = 0.25"));
    CHECK(edited(kText, "body[1].name", "\"cover\"") == with("'lid'", "\"cover\""));
    CHECK(edited(kText, "body[0].at", "[1, 2, 3]") == with("at = [0, 0,\n  0]  # over two lines", "at = [1, 2, 3]"));
    CHECK(edited(kText, "body[1].inline.b", "2") == with("b = 1", "b = 2"));
    CHECK(edited(kText, "contact.friction", "0.5") == kText);
}

TEST_CASE("a key that is new stands in its table, which is made if there is none") {
    CHECK(edited(kText, "seed", "7") == with("# of the case\n", "# of the case\nseed = 7\n"));
    CHECK(edited("# alone\n", "seed", "7") == "# alone\nseed = 7\n");
    CHECK(edited("", "seed", "7") == "seed = 7\n");
    CHECK(edited(kText, "contact.damping", "0.1") == with("# measured\n", "# measured\ndamping = 0.1\n"));
    CHECK(edited(kText, "body[0].shape", "\"box\"") ==
          with("# over two lines\n", "# over two lines\nshape = \"box\"\n"));
    CHECK(edited(kText, "body[1].motion.speed", "2") == kText + "speed = 2\n");
    CHECK(edited(kText, "coil.speed_rpm", "60") == kText + "\n[coil]\nspeed_rpm = 60\n");
    CHECK(edited(kText, "body[2].name", "\"gate\"") == kText + "\n[[body]]\nname = \"gate\"\n");
    CHECK(edited(kText, "body[0].motion.kind", "\"turn\"") ==
          with("# over two lines\n", "# over two lines\n[body.motion]\nkind = \"turn\"\n"));
    CHECK(edited("contact.wall.friction = 0.2\n", "contact.friction", "1") ==
          "contact.wall.friction = 0.2\ncontact.friction = 1\n");
}

TEST_CASE("a key that goes takes its line along, and nothing else") {
    CHECK(edited(kText, "contact.friction", std::nullopt) == with("friction = 0.5   # measured\n", ""));
    CHECK(edited(kText, "body[0].at", std::nullopt) == with("at = [0, 0,\n  0]  # over two lines\n", ""));
    CHECK(edited(kText, "coil.turns", std::nullopt) == kText);
    CHECK_FALSE(edited(kText, "body[1].inline.b", std::nullopt).has_value());
}

TEST_CASE("keys of a case within a study are names with dots") {
    const std::string study =
        "base = \"mini.toml\"\n[set]\n\"contact.friction\" = 0.5\n[[axis]]\nkey = \"coil.turns\"\n";
    CHECK(studio::statedIn(study)[1].key == "set.\"contact.friction\"");
    CHECK(edited(study, "set.\"contact.friction\"", "0.6") == replaced(study, "0.5", "0.6"));
    CHECK(edited(study, "set.\"contact.friction\"", std::nullopt) ==
          replaced(study, "\"contact.friction\" = 0.5\n", ""));
    CHECK(edited(study, "set.\"coil.turns\"", "3") == replaced(study, "[[axis]]", "\"coil.turns\" = 3\n[[axis]]"));
    CHECK_FALSE(edited(study, "set.\"contact", "3").has_value());
}

TEST_CASE("what would change more than one value is refused") {
    CHECK_FALSE(edited(kText, "contact.friction.deeper", "1").has_value());
    CHECK_FALSE(edited(kText, "body[7].name", "\"far\"").has_value());
    CHECK_THROWS_AS(edited(kText, "seed", "1\nname = 2"), CaseError);
    CHECK_THROWS_AS(edited(kText, "seed", "what"), CaseError);
    CHECK_THROWS_AS(edited("[", "seed", "1"), CaseError);
    CHECK(edited(kText, "seed", "1 # 2") != std::nullopt);
}

TEST_CASE("every value of a case that comes with the program can be changed and taken out") {
    const std::string text = fileContent(VKDOSE_SOURCE_DIR "/cases/mini.toml").value();
    for (const auto& one : studio::statedIn(text)) {
        CAPTURE(one.key);
        const auto other = edited(text, one.key, "12345");
        REQUIRE(other.has_value());
        CHECK(edited(*other, one.key, one.text) == text);
        CHECK(edited(text, one.key, std::nullopt).has_value());
    }
}
