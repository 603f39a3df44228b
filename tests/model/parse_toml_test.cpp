// What is refused before the parser of TOML sees it: keys so deep that its recursion would end the stack.
#include "host/model/parse_toml.h"

#include <string>

#include "host/core/error.h"
#include "tests/support/catch.h"

using namespace vkdose;

namespace {

/// "text text text ..."
std::string times(int count, const std::string& text) {
    std::string all;
    for (int i = 0; i < count; ++i) all += text;
    return all;
}

/// Whether the text is refused for the dots in its keys; any other fault is none here.
bool tooManyDots(const std::string& text) {
    try {
        tomlTree(text, "case.toml");
        return false;
    } catch (const CaseError& error) {
        CHECK_THAT(error.what(), Catch::Contains("more than 64 dots in the keys of a line"));
        return true;
    }
}

}  // namespace

TEST_CASE("a text may have any number of dots but in the keys of a line") {
    CHECK_FALSE(tooManyDots("a" + times(64, ".a") + " = 1\n"));
    CHECK(tooManyDots("a" + times(65, ".a") + " = 1\n"));
    CHECK(tooManyDots("a" + times(65, " . a") + " = 1\n"));
    CHECK(tooManyDots("1" + times(70, ".1") + " = 1\n"));
    CHECK(tooManyDots("\"a\"" + times(65, ".'a'") + " = 1\n"));
    CHECK(tooManyDots("x = [1.5, {a" + times(65, ".a") + " = 1}]\n"));
    CHECK_FALSE(tooManyDots(times(100, "a.b.c = 1\n")));  // each line counts anew

    CHECK_FALSE(tooManyDots("x = [" + times(200, "1.5, ") + "]\n"));
    CHECK_FALSE(tooManyDots("x = \"" + times(200, "c.overlap ") + "\"\n"));
    CHECK_FALSE(tooManyDots("x = '" + times(200, ".") + "' # " + times(200, ".") + "\n"));
    CHECK_FALSE(tooManyDots("x = \"\\\"" + times(200, ".") + "\"\n"));
    CHECK_FALSE(tooManyDots("x = \"\"\"\n" + times(200, ".") + "\"\"\"\n"));
}

TEST_CASE("a string does not hide the dots behind it") {
    const std::string deep = "{a" + times(65, ".a") + " = 1}";
    for (const char* string : {"\"\"", "''", "\"x\"", "'x\\'", "\"x\\\\\"", "\"\"\"\"\"\"", "\"\"\"x\"\"\"\"",
                               "\"\"\"x\"\"\"\"\"", "'''x'''''", "\"\"\"\\\"\"\"\"", "'''\n'''"})
        CHECK(tooManyDots(std::string("x = [") + string + ", " + deep + "]\n"));
    // A string that does not end with its line is a fault of grammar, and no string.
    CHECK(tooManyDots("x = \"a\ny = " + deep + "\n"));
}

TEST_CASE("a long list on one line is read in one go") {
    // With a search from the line's begin for each entry this would take hours.
    constexpr int kEntries = 400000;
    const auto tree = tomlTree("list = [" + times(kEntries - 1, "1,") + "23]\nnext = 4\n", "case.toml");
    REQUIRE(tree.has_value());
    const Node* list = tree->child("list");
    REQUIRE(list != nullptr);
    REQUIRE(list->children.size() == kEntries);
    CHECK(list->children.front().text == "1");
    CHECK(list->children.back().text == "23");
    CHECK(list->line == 1);
    CHECK(tree->child("next")->text == "4");
    // Letters of several bytes, and values that are not sought in their order.
    const auto words = tomlTree("z = \"\u00e4\u00f6\", a = 1\n", "case.toml");
    const auto inlined = tomlTree("t = {z = \"\u00e4\u00f6\", a = 12, m = [3, 45]}\n", "case.toml");
    REQUIRE(inlined.has_value());
    const Node* table = inlined->child("t");
    CHECK(table->child("a")->text == "12");
    CHECK(table->child("m")->text == "[3, 45]");
    CHECK(table->child("m")->children[1].text == "45");
    CHECK_FALSE(words.has_value());
}

TEST_CASE("more keys or tables than a case can have are refused before they are looked through") {
    const auto told = [](const std::string& text) {
        try {
            tomlTree(text, "case.toml");
        } catch (const CaseError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    std::string keys, tables;
    for (int i = 0; i < 2000; ++i) {
        keys += "k" + std::to_string(i) + " = 1\n";
        tables += "[[body]]\n";
    }
    CHECK(told(keys).empty());
    CHECK_THAT(told(keys + "more = 1\n"), Catch::Contains("has 2001 keys, and may have 2000"));
    CHECK_THAT(told("[t]\n" + keys + "more = 1\n"), Catch::Contains("t: has 2001 keys"));
    CHECK(told(tables).empty());
    CHECK_THAT(told(tables + "[[body]]\n"), Catch::Contains("body: has 2001 tables"));
}
