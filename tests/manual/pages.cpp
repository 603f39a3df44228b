#include "tests/manual/pages.h"

#include <algorithm>
#include <cctype>
#include <deque>
#include <fstream>
#include <map>
#include <sstream>

namespace vkdose::test {
namespace fs = std::filesystem;

namespace {

bool startsWith(const std::string& text, const std::string& beginning) {
    return text.rfind(beginning, 0) == 0;
}

/// `text` with what stands between backticks blanked out, so that code holds no links. Lines stay where they are.
std::string withoutCode(const std::string& text) {
    std::string plain = text;
    bool code = false;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        if (plain[i] == '`') code = !code;
        if (plain[i] == '\n' && i + 1 < plain.size() && plain[i + 1] == '\n') code = false;  // a paragraph ends it
        if (code && plain[i] != '\n') plain[i] = ' ';
    }
    return plain;
}

void findLinks(const std::string& text, Page& page) {
    for (std::size_t at = text.find("]("); at != std::string::npos; at = text.find("](", at + 1)) {
        const std::size_t end = text.find(')', at);
        if (end == std::string::npos) continue;
        const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n') + 1;
        page.links.push_back({text.substr(at + 2, end - at - 2), static_cast<int>(line)});
    }
}

/// Code that begins with a room and is nothing but a path. "NAME", "DEVICE" and "..." stand for something.
void findPaths(const std::string& text, Page& page) {
    const std::string allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./";
    for (std::size_t at = text.find('`'); at != std::string::npos; at = text.find('`', at + 1)) {
        const std::size_t end = text.find('`', at + 1);
        if (end == std::string::npos) return;
        const std::string code = text.substr(at + 1, end - at - 1);
        const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n') + 1;
        at = end;
        bool room = false;
        for (const char* name : {"cases/", "geometry/", "host/", "shaders/", "tests/", "tools/"})
            room = room || startsWith(code, name);
        const bool path = code.find_first_not_of(allowed) == std::string::npos;
        bool placeholder = false;
        for (const char* word : {"NAME", "DEVICE", "..", "/."})
            placeholder = placeholder || code.find(word) != std::string::npos;
        if (room && path && !placeholder) page.paths.push_back({code, static_cast<int>(line)});
    }
}

/// The file and the anchor of a link on `page`; both empty if it leads out into the world.
std::pair<fs::path, std::string> resolved(const Page& page, const std::string& target) {
    if (target.find("://") != std::string::npos || startsWith(target, "mailto:")) return {};
    const std::size_t hash = target.find('#');
    const std::string file = target.substr(0, hash);
    const std::string anchor = hash == std::string::npos ? "" : target.substr(hash + 1);
    if (file.empty()) return {page.file, anchor};
    return {(page.file.parent_path() / file).lexically_normal(), anchor};
}

const Page* pageAt(const std::vector<Page>& all, const fs::path& file) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Page& p) { return p.file == file; });
    return found == all.end() ? nullptr : &*found;
}

}  // namespace

std::string anchorOf(const std::string& heading) {
    std::string anchor;
    for (const char c : heading) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == ' ' || c == '-')
            anchor += '-';
        else if (std::isalnum(byte) != 0 || c == '_' || byte >= 0x80)
            anchor += static_cast<char>(std::tolower(byte));
    }
    return anchor;
}

Page parsePage(const fs::path& file, const std::string& text) {
    Page page;
    page.file = file;
    std::map<std::string, int> seen;
    std::string prose;
    enum class In { Text, Code, Example } in = In::Text;
    bool printed = false;
    std::istringstream lines(text);
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        prose += '\n';
        if (line == "<!-- end -->") {
            if (!printed) page.faults.push_back(std::to_string(number) + ": an end without a part");
            printed = false;
        }
        if (printed) page.parts.back().text += line + "\n";
        if (in == In::Text && startsWith(line, "<!-- vkdose ")) {
            if (printed) page.faults.push_back(std::to_string(number) + ": the part before has no end");
            printed = true;
            page.parts.push_back({line.substr(12, line.size() - 12 - 4), "", number});
        }
        if (startsWith(line, "```")) {
            in = in != In::Text ? In::Text : line == "```sh example" ? In::Example : In::Code;
            if (in == In::Example) page.examples.push_back({"", number});
            continue;
        }
        if (in == In::Example) page.examples.back().commands += line + "\n";
        if (in != In::Text || startsWith(line, "    ")) continue;  // a block of code
        prose.insert(prose.size() - 1, line);
        if (!startsWith(line, "#")) continue;
        const std::string anchor = anchorOf(line.substr(std::min(line.size(), line.find(' ') + 1)));
        const int before = seen[anchor]++;
        page.anchors.insert(before == 0 ? anchor : anchor + "-" + std::to_string(before));
    }
    if (printed) page.faults.push_back(std::to_string(number) + ": a part has no end");
    if (in != In::Text) page.faults.push_back(std::to_string(number) + ": a block has no end");
    findPaths(prose, page);
    findLinks(withoutCode(prose), page);
    return page;
}

std::vector<Page> readPages(const fs::path& root) {
    std::vector<Page> pages;
    for (auto at = fs::recursive_directory_iterator(root); at != fs::recursive_directory_iterator(); ++at) {
        const std::string name = at->path().filename().string();
        const bool made = name == "build" || name == "out" || name == "runs";  // as in .gitignore
        const bool skipped = name.front() == '.' || (at.depth() == 0 && made);
        if (at->is_directory() && skipped) at.disable_recursion_pending();
        if (skipped || at->path().extension() != ".md") continue;
        std::ifstream stream(at->path(), std::ios::binary);
        std::ostringstream text;
        text << stream.rdbuf();
        pages.push_back(parsePage(at->path().lexically_relative(root), text.str()));
    }
    const auto key = [](const Page& p) { return std::make_pair(p.file != "README.md", p.file.string()); };
    std::sort(pages.begin(), pages.end(), [&](const Page& a, const Page& b) { return key(a) < key(b); });
    return pages;
}

std::vector<std::string> deadLinks(const Page& page, const std::vector<Page>& all, const fs::path& root) {
    std::vector<std::string> dead;
    const auto tell = [&](const Link& link, const char* what) {
        dead.push_back(page.file.string() + ":" + std::to_string(link.line) + ": " + link.target + " " + what);
    };
    for (const Link& link : page.links) {
        const auto [file, anchor] = resolved(page, link.target);
        if (file.empty()) continue;
        if (file.is_absolute() || *file.begin() == "..") {
            tell(link, "leads out of the repository");
            continue;
        }
        if (!fs::exists(root / file)) {
            tell(link, "is not there");
            continue;
        }
        if (anchor.empty()) continue;
        const Page* target = pageAt(all, file);
        if (target == nullptr || !target->anchors.contains(anchor)) tell(link, "has no such anchor");
    }
    return dead;
}

std::vector<std::string> deadPaths(const Page& page, const fs::path& root) {
    std::vector<std::string> dead;
    for (const Link& path : page.paths)
        if (!fs::exists(root / path.target))
            dead.push_back(page.file.string() + ":" + std::to_string(path.line) + ": " + path.target + " is not there");
    return dead;
}

std::vector<std::string> unreachable(const std::vector<Page>& all) {
    std::set<fs::path> reached{all.front().file};
    std::deque<fs::path> next{all.front().file};
    while (!next.empty()) {
        const Page* page = pageAt(all, next.front());
        next.pop_front();
        if (page == nullptr) continue;
        for (const Link& link : page->links) {
            const fs::path file = resolved(*page, link.target).first;
            if (reached.insert(file).second) next.push_back(file);
        }
    }
    std::vector<std::string> missing;
    for (const Page& page : all)
        if (!reached.contains(page.file)) missing.push_back(page.file.string());
    return missing;
}

}  // namespace vkdose::test
