#pragma once
// Who may ask the workbench: the browser that was given its address, and no page of another site. Other programs of
// this machine reach its port as well, and so does every page that the browser shows. So each request has to have the
// token that the address holds (in a cookie, once the page is there), has to name this very host (or a name that points
// here by a trick would do), and must not come from another origin.

#include <optional>
#include <string>

namespace vkdose::studio {

/// What of a request the gate looks at. Empty: the request has none.
struct Caller {
    std::string host;    ///< the header Host
    std::string origin;  ///< the header Origin
    std::string cookie;  ///< the header Cookie
    std::string token;   ///< of the address: /?token=...
};

class Gate {
  public:
    /// Makes a token of 128 bits by the system's random numbers.
    explicit Gate(int port);
    Gate(int port, std::string token) : port_(port), token_(std::move(token)) {}

    /// Why a request is refused, for the person who sent it. Absent if it may pass.
    std::optional<std::string> refusal(const Caller& caller) const;
    /// Whether the request brings the token in its address, so that the browser is to be given the cookie.
    static bool isFirst(const Caller& caller) { return !caller.token.empty(); }

    const std::string& token() const { return token_; }
    std::string address() const;
    /// The header Set-Cookie that lets the browser in from now on.
    std::string cookie() const;

  private:
    std::string cookieName() const;

    int port_;
    std::string token_;
};

}  // namespace vkdose::studio
