#pragma once
// What the answers of the workbench share: what they are made of, and how one is refused.

#include <httplib.h>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace vkdose::studio {

using Json = nlohmann::ordered_json;

inline constexpr std::size_t kMostText = 4 << 20;   ///< bytes of a request in JSON, and of a case
inline constexpr std::size_t kMostMesh = 32 << 20;  ///< bytes of a mesh

/// A request that cannot be done: its status, and why in words for the page.
struct Refused : std::runtime_error {
    Refused(int code, const std::string& why) : std::runtime_error(why), status(code) {}
    int status;
};

/// The JSON object that a request brings.
Json bodyOf(const httplib::Request& request);
/// One of its members.
std::string textOf(const Json& body, const char* name);

/// Answers with this text as it is. It is not packed, though browsers offer to unpack: on one machine that takes longer
/// than sending it, and takes its time from the run.
void answerWith(httplib::Response& response, std::string text, const std::string& type);

}  // namespace vkdose::studio
