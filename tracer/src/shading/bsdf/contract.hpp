// What a BSDF must provide: how light scatters at one point of a surface. bsdf.hpp has the list of all kinds.
#pragma once

#include <concepts>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "shading/bsdf/sample.hpp"

namespace phasetree::tracer {

/// Directions are of unit length, in the local frame of sample.hpp: z is the normal on the side of `wo`. Densities are
/// per steradian. f is in 1/sr and has a value for each colour channel.
///
/// * sample(wo, u_lobe, u): a direction `wi` with its weight f |cos θi| / pdf, as BsdfSample has it; `u_lobe` in [0, 1)
///   chooses a lobe and `u` in [0, 1)² a direction. It is nothing if the path ends here.
/// * evaluate(wo, wi): f(wo, wi) |cos θi|.
/// * pdf(wo, wi): the density with which sample() proposes `wi`.
/// * is_delta(): whether all lobes are delta functions, so that looking for lights is of no use.
/// * passes_through(): whether light goes straight on and nothing scatters, as between equal refractive indices.
///
/// Delta lobes can only be sampled: evaluate() and pdf() leave them out.
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
