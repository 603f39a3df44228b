#pragma once
// Makes names and texts from outside safe to show in messages: they must neither command a terminal nor look like
// something else.

#include <string>
#include <string_view>

namespace vkdose {

/// The text as one line in which every character can be seen. Characters that command a terminal, turn the direction of
/// writing or cannot be seen are written as \x1b or \u202e. Bytes that are not UTF-8 are written in the same way.
std::string printable(std::string_view text);

/// The same for a text whose line breaks are kept.
std::string printableLines(std::string_view text);

/// A path as a word of a command that can be typed. It is quoted if a shell would take it apart, and it never looks
/// like an option.
std::string shellWord(const std::string& path);

}  // namespace vkdose
