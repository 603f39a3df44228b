#pragma once
// Text for a person who watches a command whose product is files.

#include <fmt/format.h>

#include <cstdio>
#include <utility>

namespace vkdose {

/// As fmt::print, but a text that cannot be written is dropped: a command must not end because its terminal was closed
/// or because a disk is full that only its messages go to. A command whose product is its text uses fmt::print, which
/// throws.
template <class... A>
void tell(std::FILE* stream, fmt::format_string<A...> format, A&&... arguments) {
    std::fputs(fmt::format(format, std::forward<A>(arguments)...).c_str(), stream);
}

/// The same on stdout.
template <class... A>
void tell(fmt::format_string<A...> format, A&&... arguments) {
    tell(stdout, format, std::forward<A>(arguments)...);
}

}  // namespace vkdose
