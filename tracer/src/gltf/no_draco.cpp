// Stands in for draco.cpp in builds without the library.
#include "gltf/document.hpp"
#include "gltf/draco.hpp"

namespace phasetree::tracer::gltf {

bool has_draco() {
    return false;
}

DracoMesh decode_draco(std::string_view, const std::vector<DracoAttribute>&, const DracoLimits&) {
    throw GltfError(
        "is compressed by Draco, which this build does not read; export without Draco compression, or install "
        "libdraco-dev and build again");
}

}  // namespace phasetree::tracer::gltf
