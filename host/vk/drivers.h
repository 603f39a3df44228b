#pragma once
// The drivers on this machine, each by itself. The Vulkan loader loads all of them, and some of its versions fail as a
// whole when one driver fails.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vkdose::vk {

/// The description files of all drivers that the loader looks at: those that VK_DRIVER_FILES or VK_ICD_FILENAMES name,
/// else those in the loader's search path and in VK_ADD_DRIVER_FILES. Folders stand for the *.json in them, by name.
std::vector<std::filesystem::path> driverFiles();

/// While it lives, the loader looks at these drivers alone. It changes the environment of the process, so no other
/// thread may read that meanwhile.
class OnlyDrivers {
  public:
    explicit OnlyDrivers(const std::vector<std::filesystem::path>& files);
    ~OnlyDrivers();
    OnlyDrivers(const OnlyDrivers&) = delete;
    OnlyDrivers& operator=(const OnlyDrivers&) = delete;

  private:
    struct Variable {
        const char* name = "";
        std::optional<std::string> before;
    };
    std::vector<Variable> variables_;
};

/// A driver that cannot be used, and why. One that only finds no hardware of its kind is none.
struct BrokenDriver {
    std::filesystem::path file;
    std::string problem;
};

struct TriedDrivers {
    std::vector<std::filesystem::path> good;  ///< that show a device
    std::vector<BrokenDriver> broken;
};

/// Starts each driver by itself. Throws DeviceError if there is no loader.
TriedDrivers tryDrivers();

/// "; the driver FILE cannot be used: WHY" for each.
std::string textOf(const std::vector<BrokenDriver>& drivers);

}  // namespace vkdose::vk
