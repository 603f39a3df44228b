#include "host/app/new_template.h"

#include <fmt/format.h>

#include <optional>
#include <string>

#include "host/app/find_case.h"
#include "host/app/new_file.h"
#include "host/app/tell.h"
#include "host/core/error.h"
#include "host/core/file.h"
#include "host/core/printable.h"

namespace vkdose {

namespace fs = std::filesystem;

void writeTemplate(const DeviceTemplate& device, const fs::path& file) {
    const fs::path source = findCase(fs::path("templates") / fmt::format("{}.toml", device.name));
    const std::optional<std::string> text = fileContent(source);
    if (!text)
        throw UsageError(fmt::format("new: {} did not come with this program; install its cases", source.string()));
    writeNew(file, *text);
    const Case c = loadCase(file, {});
    const Insertion filled = insertParticles(c);
    tell("wrote      {}\n", printable(file.string()));
    tell("device     {}\n", device.about);
    tell("powder     {:.4g} g in {} spheres\n", 1e3 * filled.mass, filled.particles.size());
    tellRunTime(c, filled);
    tellNext(c, filled, file);
}

}  // namespace vkdose
