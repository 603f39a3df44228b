#pragma once
// The keys of a case or study file as a JSON Schema, by which editors complete and check TOML.

#include <string>

namespace vkdose {

/// JSON Schema (draft 7) of a case file, or of a study file: names, kinds, words, bounds and meanings of all keys. It
/// knows single keys only. Rules between keys, and what a case takes from its base file, are left to the reader.
std::string keySchema(bool study);

}  // namespace vkdose
