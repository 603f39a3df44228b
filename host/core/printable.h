#pragma once
// Names and texts of others in what we say: they must neither command a terminal nor look like something else.

#include <string>
#include <string_view>

namespace vkdose {

/// One line in which every character shows: those that command a terminal, turn the direction of writing or cannot be
/// seen stand as \x1b or \u202e, and so do bytes that are no UTF-8.
std::string printable(std::string_view text);

/// The same of a text whose line breaks are meant.
std::string printableLines(std::string_view text);

/// A path as a word of a command that can be typed: quoted if a shell would take it apart, never like an option.
std::string shellWord(const std::string& path);

}  // namespace vkdose
