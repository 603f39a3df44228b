// Our sources must not contain some things: shaders, loops that drivers are known to get wrong; tests, names that only
// one version of Catch2 has; none of them, a line over 120 characters.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

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

/// Characters, not bytes: of UTF-8 the bytes that begin one.
std::size_t width(const std::string& line) {
    return std::size_t(std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

/// Numbers of the lines over 120 characters. A path in an #include cannot be broken.
std::vector<std::size_t> wideLines(const std::string& text) {
    std::vector<std::size_t> wide;
    std::istringstream stream(text);
    std::size_t number = 0;
    for (std::string line; std::getline(stream, line);) {
        ++number;
        if (width(line) > 120 && line.rfind("#include", 0) != 0) wide.push_back(number);
    }
    return wide;
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

// glslang carries `precise` to sums and products, and not into these functions (law/precise.glsl).
TEST_CASE("no precise value is computed with dot or a function like it") {
    const std::regex hidden("\\bprecise\\b[^;]*\\b(dot|length|distance|cross|normalize)\\(");
    CHECK(std::regex_search("precise float a = b - dot(c, d);", hidden));
    CHECK_FALSE(std::regex_search("precise float a = b - preciseDot(c, d); float e = dot(c, d);", hidden));
    for (const auto& entry : fs::recursive_directory_iterator(VKDOSE_SOURCE_DIR "/shaders")) {
        const std::string suffix = entry.path().extension().string();
        if (suffix != ".comp" && suffix != ".glsl") continue;
        INFO(entry.path());
        CHECK_FALSE(std::regex_search(withoutComments(readText(entry.path())), hidden));
    }
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

TEST_CASE("no name of a test holds a semicolon or begins with a minus, which the runner would take for its own") {
    std::size_t names = 0;
    for (const auto& entry : fs::recursive_directory_iterator(VKDOSE_SOURCE_DIR "/tests")) {
        if (entry.path().extension() != ".cpp") continue;
        std::istringstream text(readText(entry.path()));
        for (std::string line; std::getline(text, line);) {
            const std::string_view start = "TEST_CASE(\"";
            if (line.rfind(start, 0) != 0) continue;
            INFO(entry.path() << ": " << line);
            const std::string name = line.substr(start.size(), line.rfind('"') - start.size());
            CHECK(name.find(';') == std::string::npos);
            CHECK(name.front() != '-');
            ++names;
        }
    }
    CHECK(names > 700);
}

TEST_CASE("no line of GLSL, C++ or CMake is over 120 characters") {
    const std::string fits(120, 'x'), umlauts = std::string(119, 'x') + "\u00e4";
    CHECK(wideLines(fits + "\n" + umlauts + "\n").empty());
    CHECK(wideLines("a\n" + fits + "x\n") == std::vector<std::size_t>{2});
    std::size_t files = 0;
    for (const char* folder : {"CMakeLists.txt", "shaders", "host", "geometry", "tests"}) {
        const fs::path root = fs::path(VKDOSE_SOURCE_DIR) / folder;
        std::vector<fs::path> sources;
        if (fs::is_regular_file(root)) sources.push_back(root);
        if (fs::is_directory(root))
            for (const auto& entry : fs::recursive_directory_iterator(root)) sources.push_back(entry.path());
        for (const fs::path& source : sources) {
            static const std::set<std::string> ours{".cpp", ".h", ".comp", ".glsl", ".cmake"};
            if (!ours.contains(source.extension().string()) && source.filename() != "CMakeLists.txt") continue;
            INFO(source);
            CHECK(wideLines(readText(source)) == std::vector<std::size_t>{});
            ++files;
        }
    }
    CHECK(files >= 300);
}
