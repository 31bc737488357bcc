// A frosted pane without thickness. It reflects as GGX microfacets do, each of which reflects R(cos θ) of the light
// (shading/thin_pane.hpp); and it transmits T(cos θ) into the same lobe mirrored at the pane:
//     f = R D G₂ / (4 |o.z| |i.z|) for i.z > 0,   T D G₂ / (4 |o.z| |i'.z|) with i' = (i.x, i.y, −i.z) for i.z < 0.
// Multiple scattering restores the energy that single scattering loses (bsdf/lost_energy.hpp), reflected and
// transmitted in the proportions of uniform light.
//
// Approximation: as in glTF's model of thin walls and OpenPBR's, transmitted light is blurred as much as reflected
// light. The two rough faces of a real pane blur it less: if α is small, (n − 1)/√2 times as much, which is 0.35 for
// n = 1.5.
//
// Reference: https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos/KHR_materials_transmission
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "sampling/ggx.hpp"
#include "shading/bsdf/lost_energy.hpp"
#include "shading/bsdf/sample.hpp"
#include "shading/thin_pane.hpp"

namespace phasetree::tracer {

class RoughThinGlassBsdf {
  public:
    /// `roughness` is the α of GGX. The losses are those of a lossless metal of that roughness; their tables must
    /// outlive the BSDF.
    RoughThinGlassBsdf(const ThinPane& pane, float roughness, const LossTables::At& losses);

    std::optional<BsdfSample> sample(const glm::vec3& wo, float u_lobe, const glm::vec2& u) const;
    glm::vec3 evaluate(const glm::vec3& wo, const glm::vec3& wi) const;
    float pdf(const glm::vec3& wo, const glm::vec3& wi) const;
    float reverse_pdf(const glm::vec3& wo, const glm::vec3& wi) const;
    bool is_delta() const { return false; }
    bool passes_through() const { return false; }

  private:
    /// f |cos θi|, and the pdf with which it is sampled.
    struct Scattered {
        glm::vec3 value;
        float pdf;
    };
    /// `mirrored` is wi, mirrored to the side of wo if it is transmitted.
    Scattered scattered(const glm::vec3& wo, const glm::vec3& mirrored, bool is_transmitted) const;

    ThinPane pane_;
    Ggx ggx_;
    LossTables::At losses_;
    ThinPane::Shares of_multiple_;
};

}  // namespace phasetree::tracer
