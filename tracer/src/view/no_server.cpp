// Replaces server.cpp in builds without cpp-httplib.
#include "view/server.hpp"

namespace phasetree::tracer::view {

void require_server() {
    throw MissingLibraryError(
        "this phasetree was built without cpp-httplib, which serves the page: install libcpp-httplib-dev, or the "
        "library from github.com/yhirose/cpp-httplib, and build again");
}

std::string server_library() {
    return "";
}

void serve(Session&, const ServeOptions&) {
    require_server();
}

}  // namespace phasetree::tracer::view
