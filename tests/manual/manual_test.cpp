// The manual is true where that can be tested: links lead somewhere, printed parts are those of the program, and the
// examples run.

#include <cstdlib>

#include "tests/app/sandbox.h"
#include "tests/manual/pages.h"
#include "tests/support/catch.h"

using namespace vkdose::test;
namespace fs = std::filesystem;

namespace {

const fs::path kRoot = VKDOSE_SOURCE_DIR;

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

}  // namespace

TEST_CASE("every link and path of the manual leads somewhere, and every page can be reached from the README") {
    const std::vector<Page> pages = readPages(kRoot);
    REQUIRE(pages.size() >= 15);
    REQUIRE(pages.front().file == "README.md");
    std::size_t links = 0;
    for (const Page& page : pages) {
        CHECK(joined(deadLinks(page, pages, kRoot)) == "");
        CHECK(joined(deadPaths(page, kRoot)) == "");
        CHECK(joined(page.faults) == "");
        links += page.links.size();
    }
    CHECK(links > 100);
    CHECK(joined(unreachable(pages)) == "");
}

TEST_CASE("printed parts stand on the pages as the program prints them, else run tools/manual") {
    const Sandbox box;
    int parts = 0;
    for (const Page& page : readPages(kRoot)) {
        for (const PrintedPart& part : page.parts) {
            const auto printed = box.vkdose(part.arguments);
            CAPTURE(page.file, part.line, part.arguments, printed.err);
            CHECK(printed.code == 0);
            CHECK(part.text == "\n" + printed.out + "\n");
            ++parts;
        }
    }
    CHECK(parts >= 4);
}

TEST_CASE("the examples of the manual run") {
    const Sandbox box;
    for (const char* folder : {"cases", "tools"}) fs::create_directory_symlink(kRoot / folder, box / folder);
    int examples = 0;
    for (const Page& page : readPages(kRoot)) {
        for (const Example& example : page.examples) {
            box.write("example.sh", "set -e\nPATH='" VKDOSE_BINARY_DIR "':$PATH\n" + example.commands);
            const std::string command =
                "cd '" + box.path().string() + "' && bash example.sh > said.txt 2>&1 < /dev/null";
            const int status = std::system(command.c_str());
            CAPTURE(page.file, example.line, example.commands, readText(box / "said.txt"));
            CHECK(status == 0);
            ++examples;
        }
    }
    CHECK(examples >= 5);
}

TEST_CASE("the comparators of pages tell what is wrong") {
    CHECK(anchorOf("`[contact]`, `[contact.wall]`") == "contact-contactwall");
    CHECK(anchorOf("A step: 2 floats") == "a-step-2-floats");

    const Page page = parsePage("a/page.md",
                                "# Two words\n## Two words\n[good](#two-words-1) [bad](#three) [out](../../x)\n"
                                "[gone](gone.md)\n![no picture](no.png) [world](https://toml.io)\n"
                                "`[code](gone.md)`\n    [code](gone.md)\n```\n[code](gone.md)\n# no heading\n```\n"
                                "[split\nlink](gone.md#x)\n");
    CHECK(page.anchors == std::set<std::string>{"two-words", "two-words-1"});
    const Sandbox box;
    fs::create_directory(box / "a");
    box.write("a/page.md", "");
    const std::vector<std::string> dead = deadLinks(page, {page}, box.path());
    CAPTURE(joined(dead));
    REQUIRE(dead.size() == 5);
    CHECK(dead[0] == "a/page.md:3: #three has no such anchor");
    CHECK(dead[1] == "a/page.md:3: ../../x leads out of the repository");
    CHECK(dead[2] == "a/page.md:4: gone.md is not there");
    CHECK(dead[3] == "a/page.md:5: no.png is not there");
    CHECK(dead[4] == "a/page.md:13: gone.md#x is not there");

    const Page paths =
        parsePage("p.md", "`host/gone.h` `host` `tools/bench-DEVICE.csv` `cases/*.toml`\n`a/page.md` \n");
    REQUIRE(paths.paths.size() == 1);
    CHECK(deadPaths(paths, box.path()) == std::vector<std::string>{"p.md:1: host/gone.h is not there"});

    const Page parts = parsePage("p.md",
                                 "<!-- vkdose manual keys --study -->\n\n| a |\n\n<!-- end -->\n"
                                 "```sh example\nvkdose devices\n```\n```sh\nrm -r x\n```\n<!-- vkdose x -->\n");
    REQUIRE(parts.parts.size() == 2);
    CHECK(parts.parts[0].arguments == "manual keys --study");
    CHECK(parts.parts[0].text == "\n| a |\n\n");
    REQUIRE(parts.examples.size() == 1);
    CHECK(parts.examples[0].commands == "vkdose devices\n");
    CHECK(parts.faults.size() == 1);
    CHECK(unreachable({page, parts}) == std::vector<std::string>{"p.md"});
}
