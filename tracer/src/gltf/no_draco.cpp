// Replaces draco.cpp in builds without the library.
#include "gltf/document.hpp"
#include "gltf/draco.hpp"

namespace phasetree::tracer::gltf {

bool has_draco() {
    return false;
}

DracoMesh decode_draco(std::string_view, const std::vector<DracoAttribute>&, const DracoLimits&) {
    throw GltfError(
        "is compressed with Draco, which this build cannot read; export it without Draco compression, or install "
        "libdraco-dev and rebuild");
}

}  // namespace phasetree::tracer::gltf
