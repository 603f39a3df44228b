#pragma once
// The shader code that a user's law becomes.

#include <functional>
#include <string>
#include <vector>

#include "host/law/law_tokens.h"
#include "host/law/user_law.h"

namespace vkdose {

/// Whether the law defines a function of that name.
using IsFunction = std::function<bool(const std::string& name)>;

/// What stands in place of law/user_text.glsl (UserLaw::shader). `bare` is the text without comments, `tokens` are its
/// tokens.
std::string lawShader(const UserLaw& law, const std::string& bare, const std::vector<LawToken>& tokens,
                      const IsFunction& isFunction);

}  // namespace vkdose
