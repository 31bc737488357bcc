// Who may talk to the server: who knows the token, and, of browsers, only the page that it gave them itself.
//
// The address is the loopback one, but any page in the user's browser can send requests there, and a name of a
// stranger's can be made to point there (DNS rebinding). So the Host must be ours, and the Origin, where a browser
// names one, too; and neither is enough without the token, which other users of the machine do not know.
#pragma once

#include <string>
#include <string_view>

namespace phasetree::tracer::view {

/// 128 random bits of the system's, in hexadecimal digits. Throws std::system_error.
std::string random_token();

class Access {
  public:
    Access(int port, std::string token) : port_(port), token_(std::move(token)) {}

    /// "http://127.0.0.1:PORT/TOKEN/"
    std::string url() const;
    /// "/TOKEN/"
    std::string path() const { return "/" + token_ + "/"; }
    /// Whether a request may be answered. `origin` is empty where there is none.
    bool allows(std::string_view host, std::string_view origin, std::string_view path) const;
    /// Of a path that is allowed, what follows the token: "picture" of "/TOKEN/picture".
    std::string_view within(std::string_view path) const { return path.substr(token_.size() + 2); }

  private:
    bool is_ours(std::string_view host) const;

    int port_;
    std::string token_;
};

}  // namespace phasetree::tracer::view
