#include "host/studio/gate.h"

#include <fmt/format.h>

#include <random>

namespace vkdose::studio {

namespace {

std::string randomToken() {
    std::random_device random;  // the system's, on every platform that is built for
    std::string token;
    for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", random());
    return token;
}

/// Compares all of both, so that the time that it takes tells nothing.
bool same(const std::string& a, const std::string& b) {
    unsigned differs = a.size() != b.size();
    for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) differs |= static_cast<unsigned>(a[i] ^ b[i]);
    return differs == 0;
}

/// The value of a cookie out of "a=1; b=2".
std::string cookieIn(const std::string& header, const std::string& name) {
    for (std::size_t at = 0; at < header.size();) {
        const std::size_t end = std::min(header.find(';', at), header.size());
        const std::size_t first = header.find_first_not_of(' ', at);
        const std::string part = first < end ? header.substr(first, end - first) : "";
        if (part.starts_with(name + "=")) return part.substr(name.size() + 1);
        at = end + 1;
    }
    return "";
}

}  // namespace

Gate::Gate(int port) : Gate(port, randomToken()) {}

std::string Gate::cookieName() const {
    return fmt::format("vkdose-{}", port_);  // cookies do not know ports, and two workbenches may be open
}

std::string Gate::address() const {
    return fmt::format("http://127.0.0.1:{}/?token={}", port_, token_);
}

std::string Gate::cookie() const {
    return fmt::format("{}={}; Path=/; HttpOnly; SameSite=Strict", cookieName(), token_);
}

std::optional<std::string> Gate::refusal(const Caller& caller) const {
    const std::string here = fmt::format("127.0.0.1:{}", port_), name = fmt::format("localhost:{}", port_);
    if (caller.host != here && caller.host != name) return "the request names another host than this machine";
    if (!caller.origin.empty() && caller.origin != "http://" + here && caller.origin != "http://" + name)
        return "the request comes from a page of another site";
    const bool known = same(caller.token, token_) || same(cookieIn(caller.cookie, cookieName()), token_);
    if (!known) return "the token of the workbench is missing; open the address that `vkdose studio` printed";
    return std::nullopt;
}

}  // namespace vkdose::studio
