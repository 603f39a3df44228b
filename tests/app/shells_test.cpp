// Completion and pages for man(1), as shells and man take them.

#include <algorithm>
#include <sstream>

#include "tests/app/list_of_commands.h"
#include "tests/app/sandbox.h"
#include "tests/support/catch.h"

using namespace vkdose::test;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// What bash offers for the last of `words`, sorted.
std::vector<std::string> offered(const Sandbox& box, const std::string& words) {
    const std::string script =
        "PATH='" VKDOSE_BINARY_DIR "':$PATH\nset -u\nsource vkdose.bash\nCOMP_WORDS=(" + words +
        ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_vkdose\nprintf '%s\\n' \"${COMPREPLY[@]}\" | sort -u > offered\n";
    box.write("ask.sh", script);
    REQUIRE(std::system(("cd '" + box.path().string() + "' && bash ask.sh > said 2>&1").c_str()) == 0);
    CHECK(readText(box / "said") == "");
    return linesOf(readText(box / "offered"));
}

bool has(const std::vector<std::string>& list, const std::string& word) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

}  // namespace

TEST_CASE("completion: bash completes commands, options, words, files and names of cases") {
    const Sandbox box;
    box.write("vkdose.bash", box.vkdose("manual completion bash").out);
    REQUIRE(std::system(("bash -n '" + (box / "vkdose.bash").string() + "'").c_str()) == 0);
    CHECK(offered(box, "vkdose re") == std::vector<std::string>{"render", "report", "resume"});
    CHECK(offered(box, "vkdose run --b") == std::vector<std::string>{"--backend"});
    CHECK(offered(box, "vkdose run --backend ''") == std::vector<std::string>{"reference", "vulkan"});
    CHECK(offered(box, "vkdose render out --view c") == std::vector<std::string>{"cut", "cut-end"});
    CHECK(offered(box, "vkdose new my.toml --flow ''") == std::vector<std::string>{"cohesive", "easy", "free"});
    CHECK(has(offered(box, "vkdose run q"), "quickstart"));
    CHECK(has(offered(box, "vkdose check paper-48g-w"), "paper-48g-wide"));
    CHECK(has(offered(box, "vkdose sweep strong"), "strong-cohesion"));
    CHECK_FALSE(has(offered(box, "vkdose run strong"), "strong-cohesion"));
    box.write("my case.toml", "");
    fs::create_directories(box / "my out");
    CHECK(offered(box, "vkdose run my") == std::vector<std::string>{"my case.toml", "my out"});
    CHECK(offered(box, "vkdose run x --out my") == std::vector<std::string>{"my out"});
    CHECK(offered(box, "vkdose te") == std::vector<std::string>{"test"});
    CHECK(offered(box, "vkdose test ve") == std::vector<std::string>{"verify"});
    CHECK(offered(box, "vkdose test compare --tw") == std::vector<std::string>{"--twins"});
    CHECK(offered(box, "vkdose test bench --on x --out my") == std::vector<std::string>{"my out"});
    CHECK(has(offered(box, "vkdose test compare q"), "quickstart"));
    CHECK(offered(box, "vkdose manual completion ''") == std::vector<std::string>{"bash", "fish", "zsh"});
    for (const std::string& command : commandsOf(box)) {
        const std::size_t space = command.find(' ') + 1;  // 0 for a command in no group
        CHECK(has(offered(box, "vkdose " + command.substr(0, space) + "''"), command.substr(space)));
    }
}

TEST_CASE("completion: zsh and fish get every command and option") {
    const Sandbox box;
    for (const char* shell : {"zsh", "fish"}) {
        const std::string script = box.vkdose(std::string("manual completion ") + shell).out;
        const bool there = std::system((std::string("command -v ") + shell + " > /dev/null 2>&1").c_str()) == 0;
        box.write("script", script);
        if (there)
            CHECK(std::system((std::string(shell) + " -n '" + (box / "script").string() + "'").c_str()) == 0);
        else
            WARN("skipped: " << shell << " is not installed (tools/packages-shells)");
        for (const std::string& command : commandsOf(box))
            CHECK_THAT(script, Catch::Contains(command.substr(command.find(' ') + 1)));
        const std::string dashes = shell == std::string("zsh") ? "--" : "-l ";
        for (const char* option : {"set", "backend", "sizes", "movie"})
            CHECK_THAT(script, Catch::Contains(dashes + option));
        // Quotes of the shell come in pairs on every line, or a description has broken out of its own.
        for (const std::string& line : linesOf(script)) {
            CAPTURE(line);
            const std::string plain = line.find('#') == 0 ? "" : line;
            const auto quotes = std::count(plain.begin(), plain.end(), '\'');
            std::size_t escapes = 0;
            for (std::size_t at = 0; (at = plain.find("\\'", at)) != std::string::npos; at += 2) ++escapes;
            CHECK((quotes - static_cast<long>(escapes)) % 2 == 0);
        }
    }
    CHECK(box.vkdose("manual completion").code == 2);
    CHECK(box.vkdose("manual completion tcsh").code == 2);
}

TEST_CASE("man: every page reads without a complaint and names its options") {
    const Sandbox box;
    REQUIRE(box.vkdose("manual man --out pages").code == 0);
    CHECK_THAT(readText(box / "pages/vkdose-run.1"),
               Catch::Contains("\\-\\-backend") && Catch::Contains("One of vulkan"));
    CHECK(readText(box / "pages/vkdose-run.1") == box.vkdose("manual man run").out);
    CHECK(readText(box / "pages/vkdose.1") == box.vkdose("manual man").out);
    CHECK(readText(box / "pages/vkdose-test-verify.1") == box.vkdose("manual man test verify").out);
    CHECK_THAT(box.vkdose("manual man verify").err, Catch::Contains("did you mean test verify?"));
    CHECK_THAT(box.vkdose("manual man rnu").err, Catch::Contains("did you mean run?"));
    const std::vector<std::string> all = commandsOf(box);
    CHECK(static_cast<std::size_t>(std::distance(fs::directory_iterator(box / "pages"), {})) == all.size() + 1);
    const bool man = std::system("command -v man > /dev/null 2>&1") == 0;
    for (const auto& page : fs::directory_iterator(box / "pages")) {
        const std::string text = readText(page.path());
        CAPTURE(page.path().filename().string());
        CHECK_THAT(text, Catch::StartsWith(".TH VKDOSE") && Catch::Contains(".SH EXAMPLES"));
        if (!man) continue;
        const std::string command = "cd '" + box.path().string() +
                                    "' && LC_ALL=C.UTF-8 MANWIDTH=100 man --warnings=all -l '" + page.path().string() +
                                    "' > page.txt 2> complaints.txt";
        CHECK(std::system(command.c_str()) == 0);
        CHECK(readText(box / "complaints.txt") == "");
    }
    if (!man) WARN("skipped: man is not installed (tools/packages-shells)");
}
