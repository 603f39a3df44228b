#pragma once
// The passes of a user's law, compiled at run time from the sources that the program carries.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/model/user_law_trial.h"
#include "host/vk/variant.h"

namespace vkdose {

/// The SPIR-V of `file` ("pass/pairs.comp") with the law in it, and with these macros defined. It is compiled once in
/// the life of the process. Throws LawError if the compiler finds faults in the law.
std::span<const std::uint32_t> userShader(const std::string& file, const UserLaw& law,
                                          const std::vector<std::string>& macros);

/// The same in the variant of the pass that vk::pick would choose.
std::span<const std::uint32_t> userShader(const std::string& file, const UserLaw& law,
                                          std::span<const vk::Variant> variants, unsigned wanted);

}  // namespace vkdose
