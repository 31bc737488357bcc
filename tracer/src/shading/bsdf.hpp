// The list of all BSDFs, and a BSDF of any kind by value.
//
// The members mean what bsdf/contract.hpp says. The frame, the meaning of `wo` and `wi` and the convention of radiance
// are those of bsdf/sample.hpp.
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
#include "shading/bsdf/rough_conductor.hpp"
#include "shading/bsdf/rough_dielectric.hpp"
#include "shading/bsdf/rough_diffuse.hpp"
#include "shading/bsdf/sample.hpp"
#include "shading/bsdf/smooth_conductor.hpp"
#include "shading/bsdf/smooth_dielectric.hpp"

namespace phasetree::tracer {

/// A kind of BSDF, once its contract has been asked of it. If it does not meet that, the message names the kind and the
/// member.
template <class Kind>
struct CheckedBsdf {
    static_assert(BsdfKind<Kind>);
    using Type = Kind;
};

template <class... Kinds>
using BsdfOf = std::variant<typename CheckedBsdf<Kinds>::Type...>;

/// Every kind of BSDF.
using AnyBsdf = BsdfOf<DiffuseBsdf, RoughDiffuseBsdf, SmoothDielectricBsdf, RoughDielectricBsdf, SmoothConductorBsdf,
                       RoughConductorBsdf, CoatedDiffuseBsdf>;

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
    /// The density with which sample() of the same interface, met from the side of wi, would propose wo, as a path goes
    /// that comes along this one backwards. It leaves delta lobes out, as pdf() does.
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
    /// Whether it has a diffuse part, so that light from nearly any direction counts.
    bool is_diffuse() const {
        return std::holds_alternative<DiffuseBsdf>(kind_) || std::holds_alternative<RoughDiffuseBsdf>(kind_) ||
               std::holds_alternative<CoatedDiffuseBsdf>(kind_);
    }
    /// Whether it is metal's.
    bool is_metal() const {
        return std::holds_alternative<SmoothConductorBsdf>(kind_) || std::holds_alternative<RoughConductorBsdf>(kind_);
    }
    bool passes_through() const {
        return std::visit([](const auto& bsdf) { return bsdf.passes_through(); }, kind_);
    }

  private:
    AnyBsdf kind_;
};

}  // namespace phasetree::tracer
