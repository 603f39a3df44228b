// What our sources must not contain: in shaders what drivers are known to get wrong, in tests what only one version of
// Catch2 has.
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>

#include "tests/support/catch.h"

namespace {

namespace fs = std::filesystem;

std::string withoutComments(const std::string& text) {
    std::string code;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) code += line.substr(0, line.find("//")) + "\n";
    return code;
}

bool hasDo(const std::string& code) {
    return std::regex_search(code, std::regex("\\bdo\\b\\s*[\\{\\n]"));
}

/// A loop without a condition, bounded by a break alone if at all.
bool hasEndlessLoop(const std::string& code) {
    return std::regex_search(code, std::regex("while\\s*\\(\\s*true\\s*\\)|for\\s*\\([^;]*;\\s*;[^)]*\\)"));
}

std::string readText(const fs::path& file) {
    std::ifstream stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

}  // namespace

// lavapipe of Mesa 22.3 miscompiles a do-while whose invocations leave at different trips, and ends any loop silently
// after 65535 trips of one invocation's loops together. So: for and while only, each with a condition that bounds it.
// The bounds: rows of at most 64, at most 27 cells around a particle and kMostVisits particles in them, 8 Newton steps
// for each of a handful of turns, 28 surfaces; a picture: 9 rays through some hundred cells of some ten spheres each.
TEST_CASE("no shader holds a do-while loop or a loop without a condition") {
    CHECK(hasDo(withoutComments("do {\n} while (x);")));
    CHECK(hasDo(withoutComments("  do\n  {")));
    CHECK_FALSE(hasDo(withoutComments("double dot; // do { }\n")));
    CHECK(hasEndlessLoop("for (;;) {"));
    CHECK(hasEndlessLoop("for (uint i = 0u; ; ++i) {"));
    CHECK(hasEndlessLoop("while (true) {"));
    CHECK_FALSE(hasEndlessLoop("for (uint i = 0u; i < n; ++i) {"));
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(VKDOSE_SOURCE_DIR "/shaders")) {
        const std::string suffix = entry.path().extension().string();
        if (suffix != ".comp" && suffix != ".glsl" && suffix != ".h") continue;
        const std::string text = readText(entry.path());
        INFO(entry.path());
        REQUIRE_FALSE(text.empty());
        CHECK_FALSE(hasDo(withoutComments(text)));
        CHECK_FALSE(hasEndlessLoop(withoutComments(text)));
        ++files;
    }
    CHECK(files >= 15);
}

// A test that compiles with Catch2 2 alone would be seen on the next Debian only.
TEST_CASE("tests take Catch2 from tests/support/catch.h, under names that both its versions have") {
    const std::regex oneVersion("#include <catch2/|Catch::Matchers::|ContainsSubstring");
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(VKDOSE_SOURCE_DIR "/tests")) {
        const std::string name = entry.path().filename().string();
        const std::string suffix = entry.path().extension().string();
        if ((suffix != ".cpp" && suffix != ".h") || name == "catch.h" || name == "sources_test.cpp") continue;
        INFO(entry.path());
        CHECK_FALSE(std::regex_search(readText(entry.path()), oneVersion));
        ++files;
    }
    CHECK(files >= 100);
}
