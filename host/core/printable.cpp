#include "host/core/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdint>

#include "host/core/error.h"

namespace vkdose {

namespace {

/// The code point of one well-formed character.
std::uint32_t codePoint(std::string_view character) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
    if (character.size() == 1) return byte(0);
    std::uint32_t point = byte(0) & (0xffU >> (character.size() + 1));
    for (std::size_t i = 1; i < character.size(); ++i) point = point << 6U | (byte(i) & 0x3fU);
    return point;
}

/// Whether a character cannot be seen: controls, marks and overrides of direction, blanks of no width, separators of
/// lines, tags (Unicode: Cc, Cf, Zl, Zp, without the joiners, which some scripts need).
bool isHidden(std::uint32_t c) {
    const auto within = [c](std::uint32_t first, std::uint32_t last) { return c >= first && c <= last; };
    return c < 0x20 || within(0x7f, 0x9f) || c == 0xad || c == 0x61c || c == 0x180e || c == 0x200b ||
           within(0x200e, 0x200f) || within(0x2028, 0x202e) || within(0x2060, 0x206f) || c == 0xfeff ||
           within(0xfff9, 0xfffb) || within(0xe0000, 0xe007f);
}

/// Bytes of the character that begins `text`; 0 if none does.
std::size_t lengthOf(std::string_view text) {
    for (std::size_t length = 1; length <= std::min<std::size_t>(4, text.size()); ++length)
        if (isUtf8(text.substr(0, length))) return length;
    return 0;
}

}  // namespace

std::string printable(std::string_view text) {
    if (std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; })) return std::string(text);
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const std::size_t length = std::max<std::size_t>(1, lengthOf(text));
        const auto first = static_cast<unsigned char>(text.front());
        const std::uint32_t point = lengthOf(text) == 0 ? 0 : codePoint(text.substr(0, length));
        if (!isHidden(point))
            out += text.substr(0, length);
        else if (length == 1)
            out += fmt::format("\\x{:02x}", first);
        else
            out += fmt::format("\\u{:04x}", point);
        text.remove_prefix(length);
    }
    return out;
}

std::string printableLines(std::string_view text) {
    std::string out;
    for (;;) {
        const std::size_t end = text.find('\n');
        out += printable(text.substr(0, end));
        if (end == std::string_view::npos) return out;
        out += '\n';
        text.remove_prefix(end + 1);
    }
}

std::string shellWord(const std::string& path) {
    std::string word = path.starts_with('-') ? "./" + path : path;
    const std::string shown = printable(word);
    const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
               std::string_view("/._-+=:,@%").find(c) != std::string_view::npos;
    });
    if (plain) return word;
    std::string quoted = shown == word ? "'" : "$'";
    for (const char c : word) {
        const auto byte = static_cast<unsigned char>(c);
        if (shown == word)
            quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
        else if (byte < 0x20 || byte > 0x7e || c == '\'' || c == '\\')
            quoted += fmt::format("\\x{:02x}", byte);
        else
            quoted += c;
    }
    return quoted + "'";
}

}  // namespace vkdose
