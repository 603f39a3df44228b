#pragma once
// The SPIR-V of the passes: made with the program, or compiled at run time from the sources that the program carries.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "host/model/user_law_trial.h"
#include "host/vk/variant.h"

namespace vkdose {

/// The SPIR-V of `file` ("pass/pairs.comp") with these macros defined, and with the law in it if there is one. It is
/// compiled once in the life of the process. Throws LawError if the compiler finds faults in the law.
std::span<const std::uint32_t> compiledNow(const std::string& file, const UserLaw* law,
                                           const std::vector<std::string>& macros);

/// How the code of a pass is to be.
struct CodeWish {
    unsigned macros = 0;           ///< of its variant, as for vk::pick
    const UserLaw* law = nullptr;  ///< of the user, which the pass knows
    bool addressed = false;        ///< reaches tables by address (shared/addressed.glsl)
};

/// The code of the pass `name`. It was made with the program unless it must know a user's law or reach tables by
/// address. Throws as compiledNow.
std::span<const std::uint32_t> passCode(const std::string& name, std::span<const vk::Variant> variants,
                                        const CodeWish& wish);

}  // namespace vkdose
