#pragma once
// Text on stdout and stderr. No other place writes there, so that at its end the program knows whether all of the text
// arrived.

#include <fmt/format.h>

#include <cstdio>
#include <string_view>
#include <utility>

namespace vkdose {

/// Writes a text. One that cannot be written is dropped, and the command goes on: it must not end because its terminal
/// was closed or because a disk is full that only its messages go to. Returns false then.
bool say(std::FILE* stream, std::string_view text);
/// Sends what is held back. Returns false if that cannot be written.
bool sendText(std::FILE* stream);

/// As fmt::print, by `say`.
template <class... A>
void tell(std::FILE* stream, fmt::format_string<A...> format, A&&... arguments) {
    say(stream, fmt::format(format, std::forward<A>(arguments)...));
}

/// The same on stdout.
template <class... A>
void tell(fmt::format_string<A...> format, A&&... arguments) {
    tell(stdout, format, std::forward<A>(arguments)...);
}

/// Call before anything is opened. A closed stdin, stdout or stderr would lend its number to the next file that is
/// opened, and text would go into that. Whoever no longer reads a pipe of ours does not end the program.
void openText();

/// Call at the end: the exit code of a command whose own is `code`. If text on stdout was lost, it says so on stderr,
/// and a good code becomes kOutputError. A pipe that nobody reads any more (`| head`) is no fault, nor is a terminal
/// that was closed.
int closedText(int code);

}  // namespace vkdose
