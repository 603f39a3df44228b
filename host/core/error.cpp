#include "host/core/error.h"

#include <fmt/format.h>

#include "host/core/printable.h"

namespace vkdose {

std::string shortened(const std::string& text, std::size_t shown) {
    if (text.size() <= shown) return text;
    std::size_t end = shown;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80U) --end;
    return text.substr(0, end) + "...";
}

std::string shortenedPath(const std::string& path) {
    return shortened(path, 500);
}

bool isUtf8(std::string_view text) {
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
    for (std::size_t i = 0; i < text.size();) {
        const unsigned lead = byte(i);
        const std::size_t length = lead < 0x80 ? 1 : lead < 0xc2 ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
        if (length == 0 || lead > 0xf4) return false;
        for (std::size_t k = 1; k < length; ++k)
            if ((byte(i + k) & 0xc0U) != 0x80U) return false;
        const unsigned next = byte(i + 1);
        const bool overlong = (lead == 0xe0 && next < 0xa0) || (lead == 0xf0 && next < 0x90);
        if (overlong || (lead == 0xed && next > 0x9f) || (lead == 0xf4 && next > 0x8f)) return false;
        i += length;
    }
    return true;
}

std::string Diagnostic::text() const {
    // A fault of the command line has no line; it reads as it was typed: "--set contact.friction = -1: ...".
    const std::string name = shortenedPath(file);
    std::string place = name.empty() ? "" : name + ": ";
    if (file == kCommandLine) place = name + " ";
    if (line > 0) place = fmt::format("{}:{}: ", name, line);
    std::string what = shortened(key);
    if (!value.empty()) what += " = " + shortened(value);
    if (!what.empty()) what += ": ";
    constexpr std::size_t kLongest = 1000;  // they may quote what a file says
    return printable(place + what + shortened(problem, kLongest) +
                     (remedy.empty() ? "" : "; " + shortened(remedy, kLongest)));
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
