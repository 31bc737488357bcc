// Triplanar projection: an image projected on a solid along the three axes, blended where the surface is oblique.
//
// With the normal n, m = max |nᵢ| and the blend b, the projection along axis i has the weight max(|nᵢ| − (1 − b) m, 0).
// At b = 0 only the nearest axis counts, and at b = 1 each has the weight |nᵢ|. The image repeats infinitely. Along x
// its right is +y, along y and z it is +x; its top is +z, along z it is +y.
//
// Reference: Geiss, Generating Complex Procedural Terrains Using the GPU, GPU Gems 3, 2007, section 1.5 (triplanar
// projection).
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>

#include "image/texture_image.hpp"
#include "phasetree/io/kind.hpp"
#include "shading/texture/texture_point.hpp"

namespace phasetree::tracer {

struct ImageTexture {
    static constexpr KindInfo info{
        "image", "An image on all sides (triplanar mapping), projected along the axes and repeated endlessly."};

    std::filesystem::path file{};
    float size = 1.0f;       // width of the image in the scene
    glm::vec3 origin{0.0f};  // position of its lower left corner
    float blend = 0.3f;
    std::shared_ptr<const TextureImage> image{};  // set once it is prepared

    template <class V>
    static void parameters(V&& v) {
        using P = ImageTexture;
        v(&P::file, image_file_parameter);
        v(&P::size, Parameter{"size", "m", "Width of the image; the height follows from its proportions.",
                              limits::positive, true});
        v(&P::origin, Parameter{"origin", "m", "Position of the lower left corner.", limits::any, true});
        v(&P::blend,
          Parameter{
              "blend", "",
              "How widely the three projections are blended on slanted surfaces: not at all at 0, everywhere at 1.",
              limits::fraction, true});
    }
    void prepare() { image = load_texture_image(file); }

    glm::vec3 at(const TexturePoint& p) const;
};

}  // namespace phasetree::tracer
