// How light scatters at one point of a surface: any of the BSDFs of bsdf/, by value.
//
// The frame, the meaning of `wo` and `wi` and the convention of radiance are those of bsdf/sample.hpp. `evaluate`
// returns f |cos θi|. Delta lobes can only be sampled: `evaluate` and `pdf` leave them out.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <utility>
#include <variant>

#include "shading/bsdf/coated_diffuse.hpp"
#include "shading/bsdf/diffuse.hpp"
#include "shading/bsdf/rough_conductor.hpp"
#include "shading/bsdf/rough_dielectric.hpp"
#include "shading/bsdf/sample.hpp"
#include "shading/bsdf/smooth_conductor.hpp"
#include "shading/bsdf/smooth_dielectric.hpp"

namespace phasetree::tracer {

class Bsdf {
    using Kind = std::variant<DiffuseBsdf, SmoothDielectricBsdf, RoughDielectricBsdf, SmoothConductorBsdf,
                              RoughConductorBsdf, CoatedDiffuseBsdf>;

  public:
    Bsdf(Kind kind) : kind_(std::move(kind)) {}

    // Chooses a lobe by `u_lobe` and a direction by `u`; nothing if the path ends here.
    std::optional<BsdfSample> sample(const glm::vec3& wo, float u_lobe, const glm::vec2& u) const {
        return std::visit([&](const auto& bsdf) { return bsdf.sample(wo, u_lobe, u); }, kind_);
    }
    glm::vec3 evaluate(const glm::vec3& wo, const glm::vec3& wi) const {
        return std::visit([&](const auto& bsdf) { return bsdf.evaluate(wo, wi); }, kind_);
    }
    // Per solid angle, of the lobes that are not delta.
    float pdf(const glm::vec3& wo, const glm::vec3& wi) const {
        return std::visit([&](const auto& bsdf) { return bsdf.pdf(wo, wi); }, kind_);
    }
    // Delta lobes only: no use looking for lights.
    bool is_delta() const {
        return std::visit([](const auto& bsdf) { return bsdf.is_delta(); }, kind_);
    }
    // Equal indices on both sides: the ray goes straight on and nothing scatters.
    bool passes_through() const {
        return std::visit([](const auto& bsdf) { return bsdf.passes_through(); }, kind_);
    }

  private:
    Kind kind_;
};

}  // namespace phasetree::tracer
