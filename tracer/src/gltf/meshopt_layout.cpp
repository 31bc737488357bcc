#include "gltf/meshopt.hpp"

namespace phasetree::tracer::gltf {

bool MeshoptLayout::is_allowed() const {
    if (mode != MeshoptMode::attributes) {
        const bool is_whole = mode == MeshoptMode::indices || count % 3 == 0;
        return (stride == 2 || stride == 4) && is_whole && filter == MeshoptFilter::none;
    }
    if (stride == 0 || stride % 4 != 0 || stride > 256) return false;
    switch (filter) {
        case MeshoptFilter::octahedral:
            return stride == 4 || stride == 8;
        case MeshoptFilter::quaternion:
            return stride == 8;
        case MeshoptFilter::none:
        case MeshoptFilter::exponential:
            return true;
    }
    return false;
}

}  // namespace phasetree::tracer::gltf
