#include "host/core/error.h"

#include <fmt/format.h>

namespace vkdose {

std::string Diagnostic::text() const {
    // A fault of the command line has no line; it reads as it was typed: "--set contact.friction = -1: ...".
    std::string place = file.empty() ? "" : file + ": ";
    if (file == kCommandLine) place = file + " ";
    if (line > 0) place = fmt::format("{}:{}: ", file, line);
    std::string what = value.empty() ? key : fmt::format("{} = {}", key, value);
    if (!what.empty()) what += ": ";
    return remedy.empty() ? place + what + problem : fmt::format("{}{}{}; {}", place, what, problem, remedy);
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
