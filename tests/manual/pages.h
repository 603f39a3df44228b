#pragma once
// The manual's pages as the tests see them: their links, anchors, printed parts and examples.

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace vkdose::test {

struct Link {
    std::string target;  ///< as written: "../study/README.md#keys"
    int line = 0;
};

/// A part that the program prints, between "<!-- vkdose ARGUMENTS -->" and "<!-- end -->".
struct PrintedPart {
    std::string arguments;
    std::string text;
    int line = 0;
};

/// A block that a reader can try, between "```sh example" and "```".
struct Example {
    std::string commands;
    int line = 0;
};

struct Page {
    std::filesystem::path file;  ///< relative to the root
    std::vector<Link> links;     ///< of pictures too; none of what stands in code
    std::set<std::string> anchors;
    std::vector<Link>
        paths;  ///< of files and folders named in code: `host/model/key.h`; those with a placeholder left out
    std::vector<PrintedPart> parts;
    std::vector<Example> examples;
    std::vector<std::string> faults;  ///< of the page's form: a part or a block without an end
};

/// The name under which a forge puts a heading: lower case, without punctuation, blanks as hyphens.
std::string anchorOf(const std::string& heading);

Page parsePage(const std::filesystem::path& file, const std::string& text);

/// Every *.md file below `root` but in hidden folders, `build` and `out`: README.md first, then by name.
std::vector<Page> readPages(const std::filesystem::path& root);

/// The faults of a page's links, a line for each: nothing there, outside `root`, or without that anchor.
std::vector<std::string> deadLinks(const Page& page, const std::vector<Page>& all, const std::filesystem::path& root);

/// The paths that a page names and that are not there.
std::vector<std::string> deadPaths(const Page& page, const std::filesystem::path& root);

/// The pages that no way of links leads to from the first one.
std::vector<std::string> unreachable(const std::vector<Page>& all);

}  // namespace vkdose::test
