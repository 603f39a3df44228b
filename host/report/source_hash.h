#pragma once
// Hashes by which a page's Content-Security-Policy knows the page's own scripts and styles.

#include <string>
#include <string_view>

namespace vkdose::report {

/// "'sha256-...'": the source expression for an inline script or style of this very text.
std::string sourceHash(std::string_view text);

}  // namespace vkdose::report
