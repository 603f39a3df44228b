#include "host/report/source_hash.h"

#include <openssl/sha.h>

#include <array>

#include "host/report/deflate.h"

namespace vkdose::report {

std::string sourceHash(std::string_view text) {
    std::array<char, SHA256_DIGEST_LENGTH> digest{};
    SHA256(reinterpret_cast<const unsigned char*>(text.data()), text.size(),
           reinterpret_cast<unsigned char*>(digest.data()));
    return "'sha256-" + base64({digest.data(), digest.size()}) + "'";
}

}  // namespace vkdose::report
