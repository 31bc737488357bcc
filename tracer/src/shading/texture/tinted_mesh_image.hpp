// The base colour of a glTF mesh: a factor, times an image by the mesh's texture coordinates, times the colours of its
// vertices. Only meshes from glTF files have it; scene files cannot use it.
//
// glTF's colour c is the colour seen under a clear coat. Under a coat that reflects the part F of diffuse light back
// inside, the base is seen as c = ρ (1 − F) / (1 − ρ F) (bsdf/coated_diffuse.hpp), so ρ = c / (1 − F + c F).
#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "image/texture_image.hpp"
#include "shading/texture/image_coordinates.hpp"
#include "shading/texture/texture_point.hpp"

namespace phasetree::tracer {

struct TintedMeshImage {
    glm::vec3 factor{1.0f};
    bool by_vertices = false;                     ///< whether the colours of the vertices count
    std::shared_ptr<const TextureImage> image{};  ///< none is white
    ImageCoordinates coordinates{};               ///< of the image

    float internal_reflectance = 0;  ///< F; 0 without a coat

    glm::vec3 at(const TexturePoint& p) const {
        glm::vec3 color = factor;
        if (image) color *= image->at(coordinates.at(p));
        if (by_vertices && p.mesh) color *= p.mesh->color;
        color = glm::clamp(color, glm::vec3(0.0f), glm::vec3(1.0f));
        return color / (1.0f - internal_reflectance + internal_reflectance * color);
    }
};

}  // namespace phasetree::tracer
