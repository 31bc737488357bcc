// Access control of the server: clients must know the token, and browsers must also be on the server's own page.
//
// The server listens on the loopback address, but any page in the user's browser can send requests there, and an
// attacker can make a host name point there (DNS rebinding). So the Host must be ours, and so must the Origin, if the
// browser sends one. Neither is sufficient without the token, which other users of the machine do not know.
#pragma once

#include <string>
#include <string_view>

namespace phasetree::tracer::view {

/// 128 random bits from the system, in hexadecimal. Throws std::system_error.
std::string random_token();

class Access {
  public:
    Access(int port, std::string token) : port_(port), token_(std::move(token)) {}

    /// "http://127.0.0.1:PORT/TOKEN/"
    std::string url() const;
    /// "/TOKEN/"
    std::string path() const { return "/" + token_ + "/"; }
    /// Whether a request may be answered. `origin` is empty if there is none.
    bool allows(std::string_view host, std::string_view origin, std::string_view path) const;
    /// The part of an allowed path after the token: "picture" for "/TOKEN/picture".
    std::string_view within(std::string_view path) const { return path.substr(token_.size() + 2); }

  private:
    bool is_ours(std::string_view host) const;

    int port_;
    std::string token_;
};

}  // namespace phasetree::tracer::view
