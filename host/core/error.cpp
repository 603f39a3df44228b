#include "host/core/error.h"

#include <fmt/format.h>

namespace vkdose {

std::string Diagnostic::text() const {
    std::string place = line > 0 ? fmt::format("{}:{}: ", file, line) : fmt::format("{}: ", file);
    std::string what = value.empty() ? key : fmt::format("{} = {}", key, value);
    return fmt::format("{}{}: {}; {}", place, what, problem, remedy);
}

namespace {
std::string join(const std::vector<Diagnostic>& faults) {
    std::string text;
    for (const Diagnostic& fault : faults) text += (text.empty() ? "" : "\n") + fault.text();
    return text;
}
}  // namespace

CaseError::CaseError(std::vector<Diagnostic> faults) : std::runtime_error(join(faults)), faults_(std::move(faults)) {}

}  // namespace vkdose
