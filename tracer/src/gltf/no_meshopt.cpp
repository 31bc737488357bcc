// Replaces meshopt.cpp in builds without the library.
#include "gltf/meshopt.hpp"

namespace phasetree::tracer::gltf {

bool has_meshopt() {
    return false;
}

std::optional<std::string> decode_meshopt(std::string_view, const MeshoptLayout&) {
    return std::nullopt;
}

}  // namespace phasetree::tracer::gltf
