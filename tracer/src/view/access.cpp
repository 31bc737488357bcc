#include "view/access.hpp"

#include <fmt/format.h>
#include <sys/random.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace phasetree::tracer::view {

std::string random_token() {
    std::array<unsigned char, 16> bytes{};
    // Requests this small are never filled partially.
    if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
        throw std::system_error(errno, std::generic_category(), "the system provides no random numbers");
    std::string token;
    for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
    return token;
}

std::string Access::url() const {
    return fmt::format("http://127.0.0.1:{}/{}/", port_, token_);
}

bool Access::is_ours(std::string_view host) const {
    return host == fmt::format("127.0.0.1:{}", port_) || host == fmt::format("localhost:{}", port_);
}

bool Access::allows(std::string_view host, std::string_view origin, std::string_view path) const {
    constexpr std::string_view scheme = "http://";
    if (!is_ours(host)) return false;
    if (!origin.empty() && !(origin.starts_with(scheme) && is_ours(origin.substr(scheme.size())))) return false;
    const std::size_t length = token_.size();
    if (path.size() < length + 2 || path[0] != '/' || path[length + 1] != '/') return false;
    // Compare all characters, however early one differs, so that the time reveals nothing about the token.
    unsigned difference = 0;
    for (std::size_t i = 0; i < length; ++i)
        difference |=
            static_cast<unsigned>(static_cast<unsigned char>(path[i + 1]) ^ static_cast<unsigned char>(token_[i]));
    return difference == 0;
}

}  // namespace phasetree::tracer::view
