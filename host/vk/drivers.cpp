#include "host/vk/drivers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "host/core/printable.h"
#include "host/vk/instance.h"

namespace vkdose::vk {

namespace fs = std::filesystem;

namespace {

/// The paths in a variable of the environment, or in `standard` if it is not set.
std::vector<fs::path> pathsIn(const char* variable, const std::string& standard = "") {
    const char* value = std::getenv(variable);
    std::string_view rest = value != nullptr && *value != '\0' ? value : std::string_view(standard);
    std::vector<fs::path> paths;
    while (!rest.empty()) {
        const std::string_view one = rest.substr(0, rest.find(':'));
        rest.remove_prefix(std::min(rest.size(), one.size() + 1));
        if (!one.empty()) paths.emplace_back(one);
    }
    return paths;
}

/// The folders that the loader searches, in its order.
std::vector<fs::path> searchPath() {
    const char* value = std::getenv("HOME");
    const std::string home = value != nullptr ? value : "";
    const auto ofHome = [&](const char* folder) { return home.empty() ? "" : home + folder; };
    std::vector<fs::path> folders;
    const auto add = [&](const std::vector<fs::path>& parents) {
        for (const fs::path& parent : parents) folders.push_back(parent / "vulkan" / "icd.d");
    };
    add(pathsIn("XDG_CONFIG_HOME", ofHome("/.config")));
    add(pathsIn("XDG_CONFIG_DIRS", "/etc/xdg"));
    add({"/usr/local/etc", "/etc"});
    add(pathsIn("XDG_DATA_HOME", ofHome("/.local/share")));
    add(pathsIn("XDG_DATA_DIRS", "/usr/local/share:/usr/share"));
    return folders;
}

/// The file, or the descriptions in the folder.
void gather(const fs::path& path, std::vector<fs::path>& files) {
    std::error_code none;
    std::vector<fs::path> found{path};
    if (fs::is_directory(path, none)) {
        found.clear();
        for (const auto& entry : fs::directory_iterator(path, none))
            if (entry.path().extension() == ".json") found.push_back(entry.path());
        std::sort(found.begin(), found.end());
    }
    for (const fs::path& file : found)
        if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
}

constexpr const char* kChoosing[] = {"VK_DRIVER_FILES",
                                     "VK_ICD_FILENAMES"};  // the first one wins; old loaders know one

}  // namespace

std::vector<fs::path> driverFiles() {
    std::vector<fs::path> files;
    for (const char* variable : kChoosing) {
        for (const fs::path& path : pathsIn(variable)) gather(path, files);
        if (!files.empty()) return files;
    }
    for (const fs::path& path : pathsIn("VK_ADD_DRIVER_FILES")) gather(path, files);
    std::error_code none;
    for (const fs::path& folder : searchPath())
        if (fs::is_directory(folder, none)) gather(folder, files);
    return files;
}

OnlyDrivers::OnlyDrivers(const std::vector<fs::path>& files) {
    std::string list;
    for (const fs::path& file : files) list += (list.empty() ? "" : ":") + file.string();
    for (const char* name : kChoosing) {
        const char* before = std::getenv(name);
        variables_.push_back({name, before != nullptr ? std::optional<std::string>(before) : std::nullopt});
        setenv(name, list.c_str(), 1);
    }
}

OnlyDrivers::~OnlyDrivers() {
    for (const Variable& variable : variables_) {
        if (variable.before)
            setenv(variable.name, variable.before->c_str(), 1);
        else
            unsetenv(variable.name);
    }
}

TriedDrivers tryDrivers() {
    TriedDrivers tried;
    for (const fs::path& file : driverFiles()) {
        const OnlyDrivers only({file});
        const Start start = startDrivers();
        if (start.showsDevices) tried.good.push_back(file);
        if (!start.problem.empty()) tried.broken.push_back({file, start.problem});
    }
    return tried;
}

std::string textOf(const std::vector<BrokenDriver>& drivers) {
    std::string text;
    for (const BrokenDriver& d : drivers)
        text += fmt::format("; the driver {} cannot be used: {}", printable(d.file.string()), d.problem);
    return text;
}

}  // namespace vkdose::vk
