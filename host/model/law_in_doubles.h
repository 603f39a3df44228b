#pragma once
// A user's law in double precision, at the points of its trial: what a device is compared with, or stands in for.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/law/law_program.h"
#include "host/model/user_law_trial.h"

namespace vkdose {

class LawInDoubles {
  public:
    /// Throws LawRefused where the text is not in the language.
    explicit LawInDoubles(const UserLaw& law) : program_(law) {}

    /// The points of a loading, as a device answers them (shaders/law/trial.comp).
    std::vector<LawPoint> tried(const LawLoading& loading);

    /// Asks the law the same as a device that answered these points of a loading. A law that takes long is compared at
    /// its first loadings only. `pair` is the name of the materials.
    void compare(const std::string& pair, const LawLoading& loading, std::span<const LawPoint> points);
    /// Where the answers differed most, if they did.
    const std::optional<LawRounding>& worst() const { return worst_; }

  private:
    LawProgram program_;
    std::optional<LawRounding> worst_;
};

}  // namespace vkdose
