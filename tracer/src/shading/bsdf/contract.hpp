// Requirements on a BSDF, which describes how light scatters at one point of a surface. bsdf.hpp lists all kinds.
#pragma once

#include <concepts>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "shading/bsdf/sample.hpp"

namespace phasetree::tracer {

/// Directions have unit length and are in the local frame of sample.hpp: z is the normal on the side of `wo`. Pdfs are
/// per steradian. f is in 1/sr, with a value for each colour channel.
///
/// * sample(wo, u_lobe, u): a direction `wi` with its weight f |cos θi| / pdf (see BsdfSample); `u_lobe` in [0, 1)
///   chooses a lobe and `u` in [0, 1)² a direction. nullopt if the path ends here.
/// * evaluate(wo, wi): f(wo, wi) |cos θi|.
/// * pdf(wo, wi): the pdf with which sample() proposes `wi`.
/// * is_delta(): whether all lobes are delta functions, so that next-event estimation is useless.
/// * passes_through(): whether light continues straight on without scattering, as between equal refractive indices.
///
/// Delta lobes can only be sampled: evaluate() and pdf() exclude them.
template <class B>
concept BsdfKind = std::copyable<B> &&
    requires(const B& bsdf, const glm::vec3& wo, const glm::vec3& wi, float u_lobe, const glm::vec2& u) {
    { bsdf.sample(wo, u_lobe, u) } -> std::same_as<std::optional<BsdfSample>>;
    { bsdf.evaluate(wo, wi) } -> std::same_as<glm::vec3>;
    { bsdf.pdf(wo, wi) } -> std::same_as<float>;
    { bsdf.is_delta() } -> std::same_as<bool>;
    { bsdf.passes_through() } -> std::same_as<bool>;
};

}  // namespace phasetree::tracer
