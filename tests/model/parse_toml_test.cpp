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
