// An image on a mesh, by the mesh's own texture coordinates: (0, 0) is the image's lower left corner and (1, 1) its
// upper right one. The image repeats beyond.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "image/texture_image.hpp"
#include "phasetree/io/kind.hpp"
#include "shading/texture/texture_point.hpp"

namespace phasetree::tracer {

struct MeshImageTexture {
    static constexpr KindInfo info{"mesh_image", "An image on a mesh, by the texture coordinates in the mesh file."};

    std::filesystem::path file{};
    glm::vec2 repeat{1.0f};
    std::shared_ptr<const TextureImage> image{};  // set once it is prepared

    template <class V>
    static void parameters(V&& v) {
        using P = MeshImageTexture;
        v(&P::file, image_file_parameter);
        v(&P::repeat, repeat_parameter);
    }
    void prepare() { image = load_texture_image(file); }

    // The reader of scenes rejects meshes without coordinates.
    glm::vec3 at(const TexturePoint& p) const { return image->at((p.mesh ? p.mesh->uv : glm::vec2(0.0f)) * repeat); }
};

}  // namespace phasetree::tracer
