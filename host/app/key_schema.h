#pragma once
// The keys of a file that people write as a JSON Schema, by which editors complete and check TOML.

#include <string>

#include "host/app/manual.h"

namespace vkdose {

/// JSON Schema (draft 7) of a case file, a study file or a powder file: names, kinds, words, bounds and meanings of all
/// keys. It knows single keys only. Rules between keys, and what a case takes from its base file, are left to the
/// reader.
std::string keySchema(FileKind kind);

}  // namespace vkdose
