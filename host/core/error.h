#pragma once
// Errors a user can meet. The message always says what was wrong and what would be right.

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace vkdose {

/// `Diagnostic::file` of a fault in an override given on the command line.
inline constexpr const char* kCommandLine = "--set";

/// Whether `text` is well-formed UTF-8 (no overlong forms, no surrogates).
bool isUtf8(std::string_view text);

/// Shortens a text from outside for a message, but keeps enough to recognise it. The cut is made where a character of
/// UTF-8 begins.
std::string shortened(const std::string& text);

/// One fault in an input file: where it stands, what it says and what would be right.
struct Diagnostic {
    std::string file;
    int line = 0;  ///< 1-based; 0 when the fault has no line (a missing key of the whole file)
    std::string key;
    std::string value;  ///< as written; empty when the key is missing
    std::string problem;
    std::string remedy;

    /// "file:line: key = value: problem; remedy", or "--set key = value: problem; remedy"
    std::string text() const;
};

/// The input cannot be run. Carries every fault found, not only the first.
class CaseError : public std::runtime_error {
  public:
    explicit CaseError(std::vector<Diagnostic> faults);
    const std::vector<Diagnostic>& faults() const { return faults_; }

  private:
    std::vector<Diagnostic> faults_;
};

/// The run cannot go on: a lost particle, NaN, a full neighbour row, an overlap no contact law covers.
class RunError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A result cannot be written: a full disk, a folder that is gone.
class OutputError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The Vulkan loader, driver or device refused.
class DeviceError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace vkdose
