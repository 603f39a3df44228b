#include "host/app/find_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "host/app/backends.h"
#include "host/core/closest_word.h"
#include "host/core/file.h"
#include "host/core/printable.h"
#include "host/model/case_tree.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

/// Something to be read: a file, or a pipe, which its reader refuses by name.
bool isThere(const fs::path& file) {
    std::error_code code;
    const fs::file_status status = fs::status(file, code);
    return fs::exists(status) && !fs::is_directory(status);
}

/// `folder` and the folders in it, in the order of their names.
std::vector<fs::path> places(const fs::path& folder) {
    std::vector<fs::path> all;
    for (const fs::path& entry : entriesOf(folder))
        if (fs::is_directory(entry)) all.push_back(entry);
    std::sort(all.begin(), all.end());
    all.insert(all.begin(), folder);
    return all;
}

/// Whether a file is a study, or else a case; neither for what is neither.
bool isKind(const fs::path& file, bool study) {
    try {
        const Node tree = readTreeAlone(file);
        const bool varies =
            tree.child("axis") != nullptr || tree.child("calibrate") != nullptr || tree.child("design") != nullptr;
        const bool powder = tree.child("title") != nullptr;
        return study ? varies
                     : !varies && !powder && (tree.child("particles") != nullptr || tree.child("base") != nullptr);
    } catch (const CaseError&) {
        return false;
    }
}

}  // namespace

std::vector<fs::path> caseFolders() {
    std::error_code code;
    const fs::path program = fs::read_symlink("/proc/self/exe", code).parent_path();
    std::vector<fs::path> found;
    for (const fs::path& folder : {fs::path("cases"), program / "../../cases", program / "../share/vkdose/cases"})
        if (fs::is_directory(folder, code)) found.push_back(folder.lexically_normal());
    return found;
}

fs::path findCase(const fs::path& name, const std::vector<fs::path>& folders) {
    if (isThere(name) || name.is_absolute() || name.empty()) return name;
    for (const fs::path& folder : folders) {
        for (const fs::path& place : places(folder)) {
            const fs::path plain = place / name;
            for (const fs::path& file : {plain, fs::path(plain.string() + ".toml")})
                if (isThere(file)) return file;
        }
    }
    if (name.has_parent_path() || name.has_extension()) return name;
    std::vector<std::string> names = namesOfCases(false, folders), studies = namesOfCases(true, folders);
    names.insert(names.end(), studies.begin(), studies.end());
    const std::string meant = closestWord(name.string(), names);
    throw UsageError(fmt::format("there is neither a file {} nor a case of that name; {}", name.string(),
                                 meant.empty() ? "give the path of a case file, or a name such as quickstart"
                                               : fmt::format("did you mean {}?", meant)));
}

std::vector<fs::path> powderFiles(const std::vector<fs::path>& folders) {
    std::map<std::string, fs::path> found;
    for (const fs::path& folder : folders)
        for (const fs::path& entry : entriesOf(folder / "powders"))
            if (entry.extension() == ".toml" && !isKind(entry, true)) found.emplace(entry.stem().string(), entry);
    std::vector<fs::path> files;
    for (const auto& [name, file] : found) files.push_back(file);
    return files;
}

fs::path findPowder(const fs::path& name, const std::vector<fs::path>& folders) {
    if (isThere(name) || name.empty()) return name;
    std::vector<std::string> names;
    for (const fs::path& file : powderFiles(folders)) {
        names.push_back(file.stem().string());
        if (names.back() == name.string()) return file;
    }
    const std::string meant = closestWord(name.string(), names);
    throw UsageError(fmt::format(
        "there is neither a file {} nor a powder of that name; {}", printable(name.string()),
        meant.empty() ? "`vkdose powders` lists those that there are" : fmt::format("did you mean {}?", meant)));
}

std::vector<std::string> namesOfCases(bool studies, const std::vector<fs::path>& folders) {
    std::set<std::string> names;
    for (const fs::path& folder : folders)
        for (const fs::path& place : places(folder))
            for (const fs::path& entry : entriesOf(place))
                if (entry.extension() == ".toml" && isKind(entry, studies)) names.insert(entry.stem().string());
    return {names.begin(), names.end()};
}

}  // namespace vkdose
