#pragma once
// Cases and studies by name: `vkdose run quickstart` from any folder.

#include <filesystem>
#include <string>
#include <vector>

namespace vkdose {

/// The folders with cases that have a name: `cases` in the current folder, and the one that came with the program (in
/// the project that it was built in, or beside its installation). Only those that exist.
std::vector<std::filesystem::path> caseFolders();

/// `name` if it is a file. Else the file of that name, with or without ".toml", in one of `folders` or in a folder
/// within. Throws UsageError if a bare name is none of them; any other path is returned as it is, for its reader to
/// report.
std::filesystem::path findCase(const std::filesystem::path& name,
                               const std::vector<std::filesystem::path>& folders = caseFolders());

/// The same of a powder: the file of that name in the folder `powders` of one of `folders`.
std::filesystem::path findPowder(const std::filesystem::path& name,
                                 const std::vector<std::filesystem::path>& folders = caseFolders());

/// The powder files in these folders, by their names; of two with one name that of the first folder.
std::vector<std::filesystem::path> powderFiles(const std::vector<std::filesystem::path>& folders = caseFolders());

/// The names by which `findCase` finds the cases in these folders, or the studies; each once, in order.
std::vector<std::string> namesOfCases(bool studies, const std::vector<std::filesystem::path>& folders = caseFolders());

}  // namespace vkdose
