#include "gltf/meshopt.hpp"

#include <meshoptimizer.h>

namespace phasetree::tracer::gltf {

bool has_meshopt() {
    return true;
}

std::optional<std::string> decode_meshopt(std::string_view compressed, const MeshoptLayout& layout) {
    // 16 bytes are compressed to two bits at best, so a larger ratio is invalid. This bounds the memory.
    constexpr std::size_t largest_ratio = 64, largest_block = 8192;
    if (layout.count > (compressed.size() * largest_ratio + largest_block) / layout.stride) return std::nullopt;
    const auto* const from = reinterpret_cast<const unsigned char*>(compressed.data());
    std::string decoded(layout.count * layout.stride, '\0');
    int failed = 0;
    if (layout.mode == MeshoptMode::attributes)
        failed = meshopt_decodeVertexBuffer(decoded.data(), layout.count, layout.stride, from, compressed.size());
    else if (layout.mode == MeshoptMode::triangles)
        failed = meshopt_decodeIndexBuffer(decoded.data(), layout.count, layout.stride, from, compressed.size());
    else
        failed = meshopt_decodeIndexSequence(decoded.data(), layout.count, layout.stride, from, compressed.size());
    if (failed != 0) return std::nullopt;
    if (layout.filter == MeshoptFilter::octahedral)
        meshopt_decodeFilterOct(decoded.data(), layout.count, layout.stride);
    else if (layout.filter == MeshoptFilter::quaternion)
        meshopt_decodeFilterQuat(decoded.data(), layout.count, layout.stride);
    else if (layout.filter == MeshoptFilter::exponential)
        meshopt_decodeFilterExp(decoded.data(), layout.count, layout.stride);
    return decoded;
}

}  // namespace phasetree::tracer::gltf
