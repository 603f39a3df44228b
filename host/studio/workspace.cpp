#include "host/studio/workspace.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/error.h"
#include "host/core/printable.h"

namespace vkdose::studio {

namespace fs = std::filesystem;

namespace {

bool isHidden(const fs::path& file) {
    return file.filename().string().starts_with(".");
}

/// Folders that hold a run keep their files to themselves.
bool isRun(const fs::path& folder) {
    std::error_code code;
    return fs::is_regular_file(folder / "case.toml", code) && fs::exists(folder / "timeseries.csv", code);
}

}  // namespace

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
            if (at.depth() >= kDepth || isRun(file)) at.disable_recursion_pending();
            if (isRun(file)) found.push_back({name, true});
        } else if (file.extension() == ".toml") {
            found.push_back({name, false});
        }
    }
    std::sort(found.begin(), found.end(), [](const Entry& a, const Entry& b) { return a.name < b.name; });
    return found;
}

}  // namespace vkdose::studio
