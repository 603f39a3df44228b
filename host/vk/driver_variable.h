#pragma once
// Variables of the environment that a driver reads when it is loaded.

#include <string>
#include <vector>

namespace vkdose::vk {

/// Sets a variable to `value` if that is wanted; else takes back what an earlier call has set. A value of the user's is
/// kept. The environment belongs to the whole process: call this before other threads read it.
void setForDriver(const char* variable, const char* value, bool wanted);

/// lavapipe keeps compiled passes on the disk, and does not note for which length of vectors it made them. With
/// Mesa 25.0 a pass whose parts differ in that crashes, hangs or yields NaN. So passes are kept for the usual length
/// alone. All drivers of Mesa read the variable that this sets. Without kept passes they compile at every start,
/// lavapipe for two seconds. Call it before a driver is loaded.
void keepPassesOfOneLength();

/// The environment as the user has set it, for other processes: NAME=VALUE each, without what setForDriver has set.
std::vector<std::string> usersEnvironment();

}  // namespace vkdose::vk
