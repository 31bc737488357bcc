// Normal mapping: light is scattered as if the surface had the normals given by an image, without moving geometry.
// Where the image's red, green and blue are c, each in [0, 1], the normal is that of
//     n' = x T + y B + z N,   (x, y, z) = 2 c − 1,
// in a frame of unit vectors. N is the surface's own shading normal, T points to the image's right and is made
// perpendicular to N, and B is perpendicular to both, towards the image's upper edge. Seen from behind, n' is negated.
//
// T comes from the mesh (scene/mesh_tangents.hpp) because two triangles that share an edge must have the same T there.
//
// Reference: Cohen, Olano & Manocha, Appearance-Preserving Simplification, SIGGRAPH 1998.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "image/texture_image.hpp"
#include "phasetree/io/kind.hpp"
#include "shading/texture/texture_point.hpp"

namespace phasetree::tracer {

struct NormalMap {
    static constexpr KindInfo info{"normal_map",
                                   "A normal map on a mesh, by the texture coordinates in the mesh file: red points to "
                                   "the right of the image, green up, and blue out of the surface."};

    std::filesystem::path file{};
    glm::vec2 repeat{1.0f};
    float strength = 1.0f;
    bool green_down = false;
    std::shared_ptr<const TextureImage> image{};  // set once it is prepared

    template <class V>
    static void parameters(V&& v) {
        using P = NormalMap;
        v(&P::file, Parameter{"file", "",
                              "Image of at most 4096 × 4096 pixels. Its numbers are used as stored: 0 stands for −1, "
                              "and 1 (255 of 255) for 1."});
        v(&P::repeat, repeat_parameter);
        v(&P::strength, Parameter{"strength", "", "Factor applied to red and green: 0 is smooth, and 2 twice as steep.",
                                  Limits{.low = 0, .high = 100}, true});
        v(&P::green_down, Parameter{"green_down", "",
                                    "Whether green points down in the image, as in DirectX, and not up, as in OpenGL.",
                                    limits::any, true});
    }
    void prepare() { image = load_texture_image(file, ImageMeaning::numbers); }

    /// The mapped normal at a point, of unit length, in texture space, on the side of place.normal. Returns
    /// place.normal if the point has no tangent.
    glm::vec3 normal_at(const TexturePoint& place) const;
};

}  // namespace phasetree::tracer
