#include "host/app/new_template.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

#include "host/app/find_case.h"
#include "host/app/new_file.h"
#include "host/app/tell.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/printable.h"
#include "host/play/backend_choice.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

struct NewFile {
    fs::path path;
    std::string text;
};

std::string textOf(const fs::path& source) {
    const std::optional<std::string> text = fileContent(source);
    if (!text)
        throw UsageError(fmt::format("new: {} did not come with this program; install its cases", source.string()));
    return *text;
}

/// The tables of motion, NAME-PART.csv beside the template, and last the case. Beside the case my.toml they are called
/// my-PART.csv.
std::vector<NewFile> filesOf(const DeviceTemplate& device, const fs::path& file) {
    const fs::path source = findCase(fs::path("templates") / fmt::format("{}.toml", device.name));
    std::string text = textOf(source);
    std::vector<NewFile> files;
    const std::string prefix = fmt::format("{}-", device.name), own = file.stem().string() + "-";
    for (const auto& entry : fs::directory_iterator(source.parent_path())) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with(prefix) || entry.path().extension() != ".csv") continue;
        const std::string newName = own + name.substr(prefix.size());
        for (std::size_t at = 0; (at = text.find(name, at)) != std::string::npos; at += newName.size())
            text.replace(at, name.size(), newName);
        files.push_back({file.parent_path() / newName, textOf(entry.path())});
    }
    files.push_back({file, text});
    return files;
}

}  // namespace

void writeTemplate(const DeviceTemplate& device, const fs::path& file) {
    const std::vector<NewFile> files = filesOf(device, file);
    for (const NewFile& f : files) requireAbsent(f.path);
    std::size_t written = 0;
    try {
        for (; written < files.size(); ++written) writeNew(files[written].path, files[written].text);
    } catch (const OutputError&) {
        std::error_code ignored;
        for (std::size_t f = 0; f < written; ++f) fs::remove(files[f].path, ignored);
        throw;
    }
    const Case c = loadCase(file, {});
    const Insertion filled = insertParticles(c);
    for (const NewFile& f : files) tell("wrote      {}\n", printable(f.path.string()));
    tell("device     {}\n", device.about);
    tell("powder     {:.4g} g in {} spheres\n", 1e3 * filled.mass, filled.particles.size());
    tellRunTime(c, filled);
    tellNext(c, filled, file);
}

}  // namespace vkdose
