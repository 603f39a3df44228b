// Our sources must not contain some things: shaders, loops that drivers are known to get wrong; tests, names that only
// one version of Catch2 has; none of them, a line over 120 characters.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/catch.h"
#include "tests/support/folder.h"

namespace {

namespace fs = std::filesystem;
using vkdose::test::readText;

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

using Uses = std::multimap<std::string, std::string>;  ///< what a file holds, by its name

/// The first of `words` in the code that is not the end of a longer word; empty if there is none.
std::string wordIn(const std::string& code, const std::vector<std::string>& words) {
    const auto inWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    for (const std::string& word : words)
        for (std::size_t at = code.find(word); at != std::string::npos; at = code.find(word, at + 1))
            if (at == 0 || !inWord(code[at - 1])) return word;
    return "";
}

/// Files of the program that hold one of `words` outside of comments, and that word. From the files in `others` those
/// words are taken first, once each, which must be there.
Uses usesOf(const std::vector<std::string>& words, const Uses& others) {
    Uses found;
    std::size_t files = 0;
    for (const char* folder : {"host", "geometry"}) {
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(VKDOSE_SOURCE_DIR) / folder)) {
            const std::string suffix = entry.path().extension().string();
            if (suffix != ".cpp" && suffix != ".h") continue;
            const std::string name = entry.path().lexically_relative(VKDOSE_SOURCE_DIR).string();
            std::string code = withoutComments(readText(entry.path()));
            const auto [begin, end] = others.equal_range(name);
            for (auto other = begin; other != end; ++other) {
                INFO(name << " no longer holds " << other->second);
                const std::size_t at = code.find(other->second);
                REQUIRE(at != std::string::npos);
                code.erase(at, other->second.size());
            }
            const std::string word = wordIn(code, words);
            if (!word.empty()) found.emplace(name, word);
            ++files;
        }
    }
    REQUIRE(files >= 300);
    return found;
}

// host/core/file.cpp looks at every read. What a stream or a FILE reads ends at an error as it does at the end.
TEST_CASE("no file but host/core/file.cpp opens another one to read") {
    const std::vector<std::string> reads{"ifstream",  "basic_ifstream",   "fstream ", "std::fstream", "filebuf",
                                         "fopen(",    "freopen(",         "fread(",   "fgets(",       "parse_file(",
                                         "H5Fopen(",  "create_from_png(", "pixRead(", "::open(",      "::open64(",
                                         "::openat(", "::read(",          "::pread("};
    CHECK(wordIn("std::ifstream stream(file);", reads) == "ifstream");
    CHECK(wordIn("std::FILE* file = std::fopen(name, \"r\");", reads) == "fopen(");
    CHECK(wordIn("const int handle = ::open(name, O_RDONLY);", reads) == "::open(");
    CHECK(wordIn("auto stream = InputFile::open(file); book.open(0); Table::read(file);", reads).empty());
    // Folders are opened to lock them; pipes and files without a name are read.
    CHECK(usesOf(reads, {{"host/core/folder_lock.cpp", "::open(folder.c_str(), "},
                         {"host/core/file.cpp", "::open(file.c_str(), O_RDONLY "},
                         {"host/core/file.cpp", "::read(handle_, "},
                         {"host/core/file.cpp", "::open(file.c_str(), flags "},
                         {"host/core/file.cpp", "::open(fresh.c_str(), kFlags"},
                         {"host/core/file.cpp", "::open(above.c_str(), O_RDONLY | O_DIRECTORY"},
                         {"host/app/tell.cpp", "::open(\"/dev/null\""},
                         {"host/app/child_runner.cpp", "::read(child->said, "},
                         {"host/app/film.cpp", "::pread(file, "},
                         {"host/app/orders.cpp", "::read(file_, "},
                         {"host/studio/child.cpp", "::read(file, "},
                         {"host/output/hdf5.cpp", "H5Fopen("}}) == Uses{});  // of a file in memory
}

// These read and write numbers as the locale of the process has it.
TEST_CASE("nothing reads or writes a number by a function that knows locales") {
    const std::vector<std::string> known{
        "stoi(",    "stol(",     "stoll(",     "stoul(",     "stoull(",  "stof(",         "stod(",     "stold(",
        "strtof(",  "strtod(",   "strtold(",   "strtol(",    "strtoll(", "strtoul(",      "strtoull(", "atof(",
        "atoi(",    "atol(",     "atoll(",     "scanf(",     "fscanf(",  "sscanf(",       "printf(",   "fprintf(",
        "sprintf(", "snprintf(", "vsnprintf(", "setlocale(", "imbue(",   "locale::global"};
    CHECK(wordIn("std::stod(text)", known) == "stod(");
    CHECK(wordIn("std::snprintf(to, 8, \"%g\", x)", known) == "snprintf(");
    CHECK(wordIn("std::to_string(3); numberOf(text); custodi(1)", known).empty());
    CHECK(usesOf(known, {}) == Uses{});
    // Of fmt the L of a format: {:L}, {:.3Lg}.
    const std::vector<std::string> formats{"{:L", "{:.1L", "{:.2L", "{:.3L", "{:.4L", "{:.6L", "{:.9L"};
    CHECK(usesOf(formats, {}) == Uses{});
}

// Elsewhere a text that does not arrive would be lost without a word.
TEST_CASE("nothing but host/app/tell.cpp writes on stdout") {
    const std::vector<std::string> prints{"fmt::print(", "std::cout", "std::cerr", "std::clog", "puts(",  "fputs(",
                                          "putc(",       "fputc(",    "putchar(",  "fwrite(",   "fflush("};
    CHECK(wordIn("fmt::print(\"{}\", x);", prints) == "fmt::print(");
    CHECK(wordIn("std::fputs(text, stdout);", prints) == "fputs(");
    CHECK(usesOf(prints, {{"host/app/tell.cpp", "std::fwrite("},
                          {"host/app/tell.cpp", "std::fflush("},
                          {"host/bench/copies.cpp", "std::fputs("},  // of a copy of the program, on stderr
                          {"host/bench/copies.cpp", "std::fflush("},
                          {"host/bench/copies.cpp", "std::fflush("}}) == Uses{});
}

// A test that compiles with Catch2 2 alone would be seen on the next Debian only.
TEST_CASE("tests take Catch2 from tests/support/catch.h, under names that both its versions have") {
    const std::regex oneVersion("#include <catch2/|Catch::(Matchers|Detail)::|ContainsSubstring");
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
