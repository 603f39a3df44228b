#include "host/studio/workspace.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/printable.h"
#include "host/model/parse_toml.h"

namespace vkdose::studio {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kMostRead = 1 << 20;  // bytes of a file whose kind is looked for

bool isHidden(const fs::path& file) {
    return file.filename().string().starts_with(".");
}

/// What a folder holds that keeps its files to itself; nothing for any other.
std::optional<Workspace::Kind> outputIn(const fs::path& folder) {
    std::error_code code;
    if (fs::is_regular_file(folder / "case.toml", code) && fs::exists(folder / "timeseries.csv", code))
        return Workspace::Kind::Run;
    if (fs::is_regular_file(folder / "study.toml", code) && fs::exists(folder / "members.csv", code))
        return Workspace::Kind::Sweep;
    return std::nullopt;
}

/// A file that cannot be read, or is none of a study, passes for a case, so that its fault is told when it is opened.
Workspace::Kind kindOf(const fs::path& file) {
    std::error_code code;
    if (fs::file_size(file, code) > kMostRead || code) return Workspace::Kind::Case;
    return commandOfStudy(fileContent(file).value_or("")) ? Workspace::Kind::Study : Workspace::Kind::Case;
}

}  // namespace

const char* commandOfStudy(const std::string& text) {
    std::optional<Node> tree;
    try {
        tree = tomlTree(text, "");
    } catch (const CaseError&) {  // too large
    }
    if (!tree) return nullptr;
    if (tree->child("calibrate")) return "calibrate";
    if (tree->child("design")) return "design";
    return tree->child("axis") || tree->child("seeds") || tree->child("set") ? "sweep" : nullptr;
}

Workspace::Workspace(const fs::path& folder) {
    std::error_code code;
    folder_ = fs::canonical(folder.empty() ? "." : folder, code);
    if (code || !fs::is_directory(folder_, code))
        throw RunError(fmt::format("studio: there is no folder {}", printable(folder.string())));
}

std::optional<fs::path> Workspace::inside(const std::string& name) const {
    const fs::path given = name;
    if (name.empty() || given.is_absolute()) return std::nullopt;
    const auto odd = [](unsigned char c) { return c < ' ' || c == '\\' || c == 127; };
    if (std::any_of(name.begin(), name.end(), odd)) return std::nullopt;
    for (const fs::path& part : given)
        if (isHidden(part)) return std::nullopt;
    std::error_code code;
    const fs::path full = fs::weakly_canonical(folder_ / given, code);
    if (code) return std::nullopt;
    const fs::path relative = full.lexically_relative(folder_);
    if (relative.empty() || *relative.begin() == ".." || relative == ".") return std::nullopt;
    return full;
}

std::vector<Workspace::Entry> Workspace::entries() const {
    std::vector<Entry> found;
    std::error_code code;
    const auto options = fs::directory_options::skip_permission_denied;
    fs::recursive_directory_iterator at(folder_, options, code), end;
    for (; !code && at != end && found.size() < kMost; at.increment(code)) {
        const fs::path& file = at->path();
        const std::string name = file.lexically_relative(folder_).generic_string();
        std::error_code unknown;
        if (isHidden(file) || at->is_symlink(unknown)) {
            at.disable_recursion_pending();
        } else if (at->is_directory(unknown)) {
            const auto output = outputIn(file);
            if (at.depth() >= kDepth || output) at.disable_recursion_pending();
            if (output) found.push_back({name, *output});
        } else if (file.extension() == ".toml") {
            found.push_back({name, kindOf(file)});
        }
    }
    std::sort(found.begin(), found.end(), [](const Entry& a, const Entry& b) { return a.name < b.name; });
    return found;
}

}  // namespace vkdose::studio
