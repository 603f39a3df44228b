#pragma once
// Where the tests find the project and the program. Both may have been carried elsewhere since the build
// (tools/gpu-minutes); then the environment says where they are.

#include <cstdlib>
#include <string>

namespace vkdose::test {

inline std::string placeOf(const char* variable, const char* built) {
    const char* place = std::getenv(variable);
    return place == nullptr ? built : place;
}

/// The folder with cases and tools.
inline std::string sourceDir() {
    return placeOf("VKDOSE_TEST_SOURCE", VKDOSE_SOURCE_DIR);
}

/// The program.
inline std::string programFile() {
    return placeOf("VKDOSE_TEST_PROGRAM", VKDOSE_BINARY_DIR "/vkdose");
}

/// Whether the validation layer may be missing, as on a machine to which the tests were carried. A test then says so.
inline bool unvalidated() {
    return std::getenv("VKDOSE_TEST_UNVALIDATED") != nullptr;
}

}  // namespace vkdose::test
