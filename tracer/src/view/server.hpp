// Serves a session's page on the loopback address.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

#include "studio/edited_document.hpp"
#include "view/session.hpp"

namespace phasetree::tracer::view {

/// This build lacks a library. The message says how to add it.
class MissingLibraryError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Throws MissingLibraryError if this build does not include the server library.
void require_server();
/// The name and version of the server library, as in "cpp-httplib 0.11.4"; empty if this build cannot serve pages.
std::string server_library();

struct ServeOptions {
    /// The scene's file, which the page may edit; null if the scene is in no file.
    studio::EditedDocument* document = nullptr;
    int port = 0;  ///< 0 selects any free port
    /// Whether pages of other servers on this machine, such as a notebook's, may embed the page.
    bool may_be_framed = false;
    std::function<bool()> is_over;                        ///< polled every 20 ms; returns true to stop the server
    std::function<void(const std::string& url)> serving;  ///< receives the address once requests are answered
};

/// Answers requests until is_over() returns true, then stops the session. Throws std::runtime_error if the port is
/// unavailable.
void serve(Session& session, const ServeOptions& options);

}  // namespace phasetree::tracer::view
