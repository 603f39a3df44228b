#include "host/app/new_study.h"

#include <fmt/format.h>

#include <string>

#include "host/app/measures.h"
#include "host/app/new_file.h"
#include "host/app/tell.h"
#include "host/core/error.h"
#include "host/core/key.h"
#include "host/core/printable.h"
#include "host/model/case_tree.h"
#include "host/play/backend_choice.h"

namespace vkdose {

namespace fs = std::filesystem;

namespace {

constexpr const char* kHead =
    "# {}\n"
    "# `vkdose {} {}` runs it, and goes on where it was. `--dry-run` tells the runs and what they cost.\n"
    "# `vkdose manual keys --study` explains every key.\n"
    "base = {}\n";

constexpr const char* kSweep =
    "seeds = 2                       # each point with so many fillings of the same powder; they differ by chance\n"
    "\n"
    "[[axis]]                        # another [[axis]] multiplies the runs; any key of the case can stand here\n"
    "key = \"contact.friction\"\n"
    "values = [0.3, 0.5, 0.7]\n";

constexpr const char* kCalibrate =
    "\n"
    "[calibrate]\n"
    "method = \"surrogate\"\n"
    "max_runs = 20\n"
    "\n"
    "[[calibrate.target]]            # one for each figure that was measured\n"
    "figure = \"dose.mean_kg\"\n"
    "value = {:<23} # kg; put in what your balance says{}\n"
    "uncertainty = {:<17} # its standard error\n"
    "\n"
    "[[calibrate.parameter]]         # what is looked for, and between which bounds\n"
    "key = \"contact.friction\"\n"
    "low = 0.2\n"
    "high = 0.9\n"
    "\n"
    "[[calibrate.parameter]]\n"
    "key = \"contact.rolling_friction\"\n"
    "low = 0.0\n"
    "high = 0.4\n";

constexpr const char* kDesign =
    "seeds = 2                       # each point with so many fillings of the same powder\n"
    "\n"
    "[design]\n"
    "max_runs = 20\n"
    "\n"
    "[[design.goal]]\n"
    "figure = \"dose.mean_kg\"\n"
    "wish = \"largest\"\n"
    "\n"
    "[[design.goal]]\n"
    "figure = \"dose.rsd\"             # scatter of the doses over their mean\n"
    "wish = \"smallest\"\n"
    "\n"
    "[[design.parameter]]            # what may be changed of the device; any key with a number can stand here\n"
    "key = \"{}\"\n"
    "low = {}\n"
    "high = {}\n";

struct FreeKey {
    std::string key;
    double value;
};

/// A key of the device that can be searched for, and its value in the case.
FreeKey freeKeyOf(const Case& c) {
    const double rpm = c.schedule.coilSpeed * kRpm.perSI;
    if (c.world.coil && rpm > 0) return {"coil.speed_rpm", rpm};
    if (rpm > 0) return {"dose.speed_rpm", rpm};
    return {"dose.rotate_s", c.schedule.rotateTime};
}

std::string bodyOf(const StudyTemplate& study, const Case& c) {
    const std::string command = study.command;
    if (command == "sweep") return kSweep;
    if (command == "calibrate") {
        const double dose = derive(c, insertParticles(c)).massPerDose;
        const double value = dose > 0 ? dose : 1e-3;
        return fmt::format(kCalibrate, figureText(value), dose > 0 ? "; this is the closed form of the case" : "",
                           figureText(value / 20));
    }
    const FreeKey free = freeKeyOf(c);
    return fmt::format(kDesign, free.key, figureText(free.value / 2), figureText(free.value * 1.5));
}

}  // namespace

void writeStudy(const StudyTemplate& study, const fs::path& base, const fs::path& file) {
    const Case c = loadCase(base);
    if (!(c.schedule.rotateTime > 0) && std::string(study.command) != "sweep")
        throw UsageError(
            fmt::format("new: {} has no doses, and --{} judges by them; write [dose] into it, or take --sweep",
                        printable(base.string()), study.command));
    const fs::path from = fs::absolute(base).lexically_relative(fs::absolute(file).parent_path());
    const std::string told = study.about;
    writeNew(file, fmt::format(kHead, "A" + told.substr(1) + ".", study.command, shellWord(file.filename().string()),
                               tomlString(from.string())) +
                       bodyOf(study, c));
    tell("wrote      {}\n", printable(file.string()));
    tell("study      {}\n", told);
    tell("next       vkdose {} {} --dry-run   (the runs that it plans, and what they cost)\n", study.command,
         shellWord(file.string()));
    tell("           vkdose {} {}\n", study.command, shellWord(file.string()));
}

}  // namespace vkdose
