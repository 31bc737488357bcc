// Decodes buffer views that are compressed by EXT_meshopt_compression, if the build has the meshoptimizer library. The
// data are not trusted.
//
// Reference: https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Vendor/EXT_meshopt_compression
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace phasetree::tracer::gltf {

enum class MeshoptMode { attributes, triangles, indices };
enum class MeshoptFilter { none, octahedral, quaternion, exponential };

struct MeshoptLayout {
    std::size_t count = 0;   ///< of rows
    std::size_t stride = 0;  ///< bytes per row
    MeshoptMode mode{};
    MeshoptFilter filter{};

    /// Whether the extension allows this combination.
    bool is_allowed() const;
};

/// Whether the build has the library.
bool has_meshopt();

/// The `count` × `stride` decoded bytes; nullopt if the compressed bytes are invalid, or without the library. The
/// layout must be allowed.
std::optional<std::string> decode_meshopt(std::string_view compressed, const MeshoptLayout&);

}  // namespace phasetree::tracer::gltf
