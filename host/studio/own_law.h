#pragma once
// A contact law of a case's own. It is a program for the graphics card, so it is compiled only for a person who has
// seen its text and wants it.

#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <string>

namespace vkdose::studio {

struct OwnLaw {
    std::string file;  ///< as the case names it
    std::string text;
};

/// The law that a case file names, through its base and its powder too. Nothing for the program's own laws, and for a
/// case that cannot be read: what is wrong with it the check tells, which compiles nothing then.
std::optional<OwnLaw> ownLawOf(const std::filesystem::path& caseFile);

/// The laws that a person has allowed, by their text: a law that changes is another one.
class AllowedLaws {
  public:
    void allow(const std::string& text);
    bool has(const std::string& text) const;

  private:
    mutable std::mutex mutex_;
    std::set<std::string> texts_;
};

}  // namespace vkdose::studio
