// Serves the page of a session on the loopback address.
#pragma once

#include <functional>
#include <string>

#include "view/session.hpp"

namespace phasetree::tracer::view {

/// Whether this build can serve pages: it had the library for it.
bool can_serve();
/// That library and its version, "cpp-httplib 0.11.4"; empty if this build cannot serve pages.
std::string server_library();

struct ServeOptions {
    int port = 0;  ///< 0: any that is free
    /// Whether pages of other servers of this machine, such as a notebook's, may show the page within them.
    bool may_be_framed = false;
    std::function<bool()> is_over;
    std::function<void(const std::string& url)> serving;  ///< is told where, once requests are answered
};

/// Answers requests until it is over; then the session is stopped. Throws std::runtime_error where the port cannot be
/// had.
void serve(Session& session, const ServeOptions& options);

}  // namespace phasetree::tracer::view
