// The list of all BSDFs, and a BSDF of any kind by value.
//
// bsdf/contract.hpp documents the members. The frame, `wo` and `wi`, and the convention for radiance are those of
// bsdf/sample.hpp.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "shading/bsdf/coated_diffuse.hpp"
#include "shading/bsdf/contract.hpp"
#include "shading/bsdf/diffuse.hpp"
#include "shading/bsdf/principled.hpp"
#include "shading/bsdf/rough_conductor.hpp"
#include "shading/bsdf/rough_dielectric.hpp"
#include "shading/bsdf/rough_diffuse.hpp"
#include "shading/bsdf/rough_thin_glass.hpp"
#include "shading/bsdf/sample.hpp"
#include "shading/bsdf/smooth_conductor.hpp"
#include "shading/bsdf/smooth_dielectric.hpp"
#include "shading/bsdf/smooth_thin_glass.hpp"
#include "shading/bsdf/thin_diffuse.hpp"

namespace phasetree::tracer {

template <BsdfKind... Kinds>
using BsdfOf = std::variant<Kinds...>;

/// Every kind of BSDF.
using AnyBsdf = BsdfOf<DiffuseBsdf, RoughDiffuseBsdf, SmoothDielectricBsdf, RoughDielectricBsdf, SmoothConductorBsdf,
                       RoughConductorBsdf, CoatedDiffuseBsdf, PrincipledBsdf, SmoothThinGlassBsdf, RoughThinGlassBsdf,
                       ThinDiffuseBsdf>;

class Bsdf {
  public:
    template <class Kind>
    requires(!std::is_same_v<Kind, Bsdf>) Bsdf(Kind kind) : kind_(std::move(kind)) {}

    std::optional<BsdfSample> sample(const glm::vec3& wo, float u_lobe, const glm::vec2& u) const {
        return std::visit([&](const auto& bsdf) { return bsdf.sample(wo, u_lobe, u); }, kind_);
    }
    glm::vec3 evaluate(const glm::vec3& wo, const glm::vec3& wi) const {
        return std::visit([&](const auto& bsdf) { return bsdf.evaluate(wo, wi); }, kind_);
    }
    float pdf(const glm::vec3& wo, const glm::vec3& wi) const {
        return std::visit([&](const auto& bsdf) { return bsdf.pdf(wo, wi); }, kind_);
    }
    /// The pdf with which sample() of the same interface, met from the side of wi, proposes wo: that of a path which
    /// follows this one backwards. Excludes delta lobes, like pdf().
    float reverse_pdf(const glm::vec3& wo, const glm::vec3& wi) const {
        return std::visit(
            [&](const auto& bsdf) {
                if constexpr (requires { bsdf.reverse_pdf(wo, wi); })
                    return bsdf.reverse_pdf(wo, wi);
                else
                    return wi.z > 0.0f ? bsdf.pdf(wi, wo) : 0.0f;
            },
            kind_);
    }
    bool is_delta() const {
        return std::visit([](const auto& bsdf) { return bsdf.is_delta(); }, kind_);
    }
    /// Whether it has a diffuse lobe, so that light from nearly any direction contributes.
    bool is_diffuse() const {
        if (const auto* principled = std::get_if<PrincipledBsdf>(&kind_)) return principled->is_diffuse();
        return std::holds_alternative<DiffuseBsdf>(kind_) || std::holds_alternative<RoughDiffuseBsdf>(kind_) ||
               std::holds_alternative<CoatedDiffuseBsdf>(kind_) || std::holds_alternative<ThinDiffuseBsdf>(kind_);
    }
    /// Whether it is a metal.
    bool is_metal() const {
        if (const auto* principled = std::get_if<PrincipledBsdf>(&kind_)) return principled->is_metal();
        return std::holds_alternative<SmoothConductorBsdf>(kind_) || std::holds_alternative<RoughConductorBsdf>(kind_);
    }
    /// The pane, if it is a smooth one, which transmits light straight on; else null.
    const ThinPane* pane() const {
        const auto* const smooth = std::get_if<SmoothThinGlassBsdf>(&kind_);
        return smooth ? &smooth->pane() : nullptr;
    }
    bool passes_through() const {
        return std::visit([](const auto& bsdf) { return bsdf.passes_through(); }, kind_);
    }

  private:
    AnyBsdf kind_;
};

}  // namespace phasetree::tracer
