#pragma once
// Shared by the mutation tests of case files and particle lists: a text cut into lines, seeded choices, and the test of
// a clear message.

#include <cstdint>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "host/core/error.h"

namespace vkdose::test {

/// One broken file. `kind` names the fault and, in the generator, what makes it certainly wrong.
struct Mutant {
    std::string kind;
    std::string text;
    std::string culprit;  ///< must stand in a message; empty: the line says enough
    int line = 0;         ///< 1-based, of the blamed line; 0: any
};

/// Choices that are the same on every machine: the engine's sequence is fixed by the standard, distributions are not.
class Choice {
  public:
    explicit Choice(std::uint32_t seed) : engine_(seed) {}
    std::size_t below(std::size_t n) { return engine_() % n; }
    template <class T>
    const T& of(const std::vector<T>& list) {
        return list[below(list.size())];
    }

  private:
    std::mt19937 engine_;
};

inline std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

inline std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

/// The text with line `at` (0-based) replaced.
inline std::string withLine(std::vector<std::string> lines, std::size_t at, const std::string& line) {
    lines[at] = line;
    return joined(lines);
}

/// Why a fault's message would not help its reader; empty when it would.
inline std::string unclear(const Diagnostic& fault) {
    const std::string text = fault.text();
    if (fault.problem.empty()) return "says no problem";
    if (fault.file.empty()) return "names no file";
    if (text.size() > 2000) return "is longer than anybody reads";
    for (const char c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) return "holds a control character";
    return "";
}

}  // namespace vkdose::test
