#pragma once
// What all ways to a new case have in common: the file that is written, and what is told of it.

#include <filesystem>
#include <string>

#include "host/model/case.h"

namespace vkdose {

/// Throws UsageError if there is something of this name.
void requireAbsent(const std::filesystem::path& file);
/// The same of a new case; throws UsageError too if its name does not end in .toml.
void requireNewFile(const std::filesystem::path& file);

/// Writes a file that was not there: never over another one, even if that has come in the meantime. Throws OutputError.
void writeNew(const std::filesystem::path& file, const std::string& text);

/// Work and run time on the device that a run would take. The run time is told only if the device could be asked: a
/// case with a mesh can take many times as long as another with as many spheres.
void tellRunTime(const Case& c, const Insertion& filled);

/// Warnings of `vkdose check`, and the commands that come next.
void tellNext(const Case& c, const Insertion& filled, const std::filesystem::path& file);

}  // namespace vkdose
