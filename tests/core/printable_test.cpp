#include "host/core/printable.h"

#include <cstdlib>

#include "host/core/error.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose;
using namespace vkdose::test;

// NOLINTBEGIN(misc-misleading-bidirectional): these texts are meant to mislead.
TEST_CASE("what commands a terminal, turns the direction or cannot be seen is shown as its number") {
    CHECK(printable("plain, grün, 粉末, שלום") == "plain, grün, 粉末, שלום");
    CHECK(printable("a\x1b[31m\nb\x7f") == "a\\x1b[31m\\x0ab\\x7f");
    CHECK(printable("case\u202etxt.\u2066x\u200b\ufeff") == "case\\u202etxt.\\u2066x\\u200b\\ufeff");
    CHECK(printable("\u0085\u00ad\u2028") == "\\u0085\\u00ad\\u2028");
    CHECK(printable("\xff z\xc3") == "\\xff z\\xc3");
    CHECK(printable("\U000e0041\U0001f600") == "\\ue0041\U0001f600");
    CHECK(printableLines("a\nb\tc\n") == "a\nb\\x09c\n");
    CHECK(Diagnostic{"a\u202eb", 3, "k", "", "is bad", ""}.text() == "a\\u202eb:3: k: is bad");
}

TEST_CASE("a path in a command that is told can be typed as it stands") {
    CHECK(shellWord("out/mini-1.5") == "out/mini-1.5");
    CHECK(shellWord("-rf") == "./-rf");
    CHECK(shellWord("my case ") == "'my case '");
    const Sandbox box;
    for (const std::string name :
         {"it's", "a b", "-", "$HOME`ls`", "\u202egnp.x", "tab\there", "back\\slash", "ü", ""}) {
        box.write("say", "printf %s " + shellWord(name) + " > said");
        REQUIRE(std::system(("cd '" + box.path().string() + "' && bash say").c_str()) == 0);
        CHECK(readText(box / "said") == (name == "-" ? "./-" : name));
        CHECK(printable(shellWord(name)) == shellWord(name));
    }
}
// NOLINTEND(misc-misleading-bidirectional)
