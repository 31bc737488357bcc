// Replaces server.cpp in builds without cpp-httplib.
#include "view/server.hpp"

#include <stdexcept>

namespace phasetree::tracer::view {

bool can_serve() {
    return false;
}

std::string server_library() {
    return "";
}

void serve(Session&, const ServeOptions&) {
    throw std::logic_error("this build cannot serve pages");
}

}  // namespace phasetree::tracer::view
