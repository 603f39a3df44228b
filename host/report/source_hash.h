#pragma once
// What a page's Content-Security-Policy knows its own scripts and styles by.

#include <string>
#include <string_view>

namespace vkdose::report {

/// "'sha256-...'": the source expression for an inline script or style of this very text.
std::string sourceHash(std::string_view text);

}  // namespace vkdose::report
