#pragma once
// One key of a TOML text changed, and nothing else of it: comments, blanks and the order of lines stay.

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace vkdose::studio {

/// A value that a text states.
struct Stated {
    std::string key;   ///< its path: "contact.wall.friction", "body[1].motion.kind"
    int line = 0;      ///< where it begins, from 1
    std::string text;  ///< as TOML on one line
};

/// All of them, in the order of the text. Throws CaseError if the text is not TOML.
std::vector<Stated> statedIn(const std::string& text);

/// The text with this key at this value (TOML), or without the key. What comes out is parsed: it states the same values
/// as before but for this one. Nothing if there is no such text by the means that are tried, of a key in an inline
/// table say. Throws CaseError if the text or the value is not TOML.
std::optional<std::string> edited(const std::string& text, const std::string& key,
                                  const std::optional<std::string>& value);

}  // namespace vkdose::studio
