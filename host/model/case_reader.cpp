#include "host/model/case_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "host/core/number.h"

namespace vkdose {

CaseReader::CaseReader(std::string file, Node tree, std::span<const KeyTable> tables)
    : file_(std::move(file)), tree_(std::move(tree)), tables_(tables) {
    open(&tree_, "", false);
}

Section* CaseReader::opened(const std::string& path) {
    const auto found =
        std::find_if(sections_.begin(), sections_.end(), [&](const Section& s) { return s.path_ == path; });
    return found == sections_.end() ? nullptr : &*found;
}

Section& CaseReader::open(const Node* node, std::string path, bool broken) {
    return sections_.emplace_back(*this, node, std::move(path), broken);
}

const Node* CaseReader::find(const std::string& path, const Node** nearest) const {
    const Node* node = &tree_;
    *nearest = node;
    for (std::size_t start = 0; start <= path.size();) {
        const std::size_t end = std::min(path.find('.', start), path.size());
        std::string name = path.substr(start, end - start);
        const std::size_t bracket = name.find('[');
        const std::string_view inner = bracket == std::string::npos ? "0" : std::string_view(name).substr(bracket + 1);
        const std::size_t index = wholeNumberOf(inner.substr(0, inner.find(']'))).value();
        name.resize(std::min(bracket, name.size()));
        node = node->child(name);
        if (node != nullptr && bracket != std::string::npos) node = &node->children[index];
        if (node == nullptr) return nullptr;
        *nearest = node;
        start = end + 1;
    }
    return node;
}

void CaseReader::fault(const std::string& path, std::string problem, std::string remedy) {
    const Node* nearest = nullptr;
    const Node* node = find(path, &nearest);
    add({fileOf(path), nearest->line, path, node == nullptr ? "" : node->text, std::move(problem), std::move(remedy)});
}

const std::string& CaseReader::fileOf(const std::string& path) const {
    const Node* nearest = nullptr;
    (void)find(path, &nearest);
    return nearest == &tree_ ? file_ : nearest->file;
}

void CaseReader::finish() {
    for (Section& section : sections_) section.finish();
}

void CaseReader::throwIfFaulty() const {
    if (faults_.empty()) return;
    std::vector<Diagnostic> sorted = faults_;
    std::stable_sort(sorted.begin(), sorted.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return a.file != b.file ? a.file < b.file : a.line < b.line;
    });
    throw CaseError(std::move(sorted));
}

std::string CaseReader::resolved() const {
    std::string text;
    const auto write = [&](const Section& section) {
        if (section.used_.empty()) return;
        std::string path = section.path_;
        if (const std::size_t index = path.find('['); index != std::string::npos)
            path.erase(index, path.find(']') + 1 - index);
        if (section.isItem_)
            text += fmt::format("\n[[{}]]\n", path);
        else if (!path.empty())
            text += fmt::format("\n[{}]\n", path);
        for (const auto& [key, value] : section.used_) text += fmt::format("{} = {}\n", key, value);
    };
    for (const Section& section : sections_) {
        const bool inItem = section.path_.find("].") != std::string::npos;
        if (inItem) continue;
        write(section);
        if (!section.isItem_) continue;
        // A table inside an item belongs to the item that stands before it.
        for (const Section& inside : sections_)
            if (inside.path_.starts_with(section.path_ + ".")) write(inside);
    }
    return text;
}

std::filesystem::path CaseReader::folderOf(const std::string& path) const {
    const Node* nearest = nullptr;
    const Node* node = find(path, &nearest);
    if (node == nullptr || node->file == kCommandLine) return {};
    return std::filesystem::path(node->file).parent_path();
}

}  // namespace vkdose
