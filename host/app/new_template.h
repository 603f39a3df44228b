#pragma once
// Devices that `vkdose new` has ready: a commented case of cases/templates, which is copied.

#include <array>
#include <filesystem>

namespace vkdose {

struct DeviceTemplate {
    const char* name;  ///< of the option without its dashes, and of the file
    const char* about;
};

inline constexpr std::array<DeviceTemplate, 5> kDeviceTemplates{{
    {"screw", "a screw feeder: a hopper over a screw that turns without a stop"},
    {"twin-screw", "a feeder with two screws that turn the same way"},
    {"tray", "a vibrating tray that a hopper feeds"},
    {"wheel", "a paddle wheel whose pockets carry powder from a hopper to an outlet"},
    {"dosator", "a dosator: a tube with a piston takes a plug from a bed and pushes it out"},
}};

/// Writes the case of this device to a file that is not there yet, and beside it the tables of the device's motions.
/// Throws UsageError if one of them is there, or if the template did not come with the program.
void writeTemplate(const DeviceTemplate& device, const std::filesystem::path& file);

}  // namespace vkdose
