// Decodes primitives that are compressed by KHR_draco_mesh_compression, if the build has the Draco library. The data
// are not trusted.
//
// Reference: https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos/KHR_draco_mesh_compression
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace phasetree::tracer::gltf {

/// An attribute that is to be decoded.
struct DracoAttribute {
    std::size_t id = 0;              ///< the unique id in the compressed data
    std::size_t component_type = 0;  ///< the requested type, by glTF's number: 5120 to 5123, 5125 or 5126
    std::size_t columns = 0;         ///< 1 to 4

    auto operator<=>(const DracoAttribute&) const = default;
};

struct DracoMesh {
    std::size_t vertices = 0;
    std::vector<std::uint32_t> indices;   ///< three per triangle, each below `vertices`
    std::vector<std::string> attributes;  ///< in the requested order, as rows without gaps
};

struct DracoLimits {
    std::size_t triangles = 0, vertices = 0;
    std::size_t bytes = 0;  ///< of all attributes in the compressed data, after decoding
};

/// Whether the build has the library.
bool has_draco();

/// Throws GltfError for invalid data and data beyond the limits; the caller puts the place of the data before its
/// message.
DracoMesh decode_draco(std::string_view compressed, const std::vector<DracoAttribute>& wanted, const DracoLimits&);

}  // namespace phasetree::tracer::gltf
