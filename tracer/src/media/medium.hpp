// The list of all media, and a medium of any kind by value.
#pragma once

#include <optional>
#include <variant>

#include "media/absorbing.hpp"
#include "media/contract.hpp"
#include "media/homogeneous.hpp"
#include "media/varying.hpp"

namespace phasetree::tracer {

template <MediumKind... Kinds>
using MediumOf = std::variant<Kinds...>;

/// Every kind of medium. The first is the default, and transparent by default.
using Medium = MediumOf<AbsorbingMedium, HomogeneousMedium, VaryingMedium>;

/// MediumKind's transmittance for a medium of any kind.
inline glm::vec3 transmittance(const Medium& medium, const Way& way, Sampler& sampler) {
    return std::visit([&](const auto& kind) { return kind.transmittance(way, sampler); }, medium);
}

/// MediumKind's passage for a medium of any kind. Purely absorbing media do not emit.
inline Passage pass(const Medium& medium, const Way& way, Sampler& sampler) {
    return std::visit(
        [&]<class Kind>(const Kind& kind) {
            if constexpr (ScatteringMediumKind<Kind>)
                return kind.pass(way, sampler);
            else
                return Passage{.left = kind.transmittance(way, sampler)};
        },
        medium);
}

/// The emission where the medium is densest: radiance per unit length in red, green and blue.
inline glm::vec3 emission(const Medium& medium) {
    return std::visit(
        []<class Kind>(const Kind& kind) {
            if constexpr (ScatteringMediumKind<Kind>)
                return kind.coefficients().emission;
            else
                return glm::vec3(0.0f);
        },
        medium);
}
/// The luminance of the emission at a point, in the space of Way, divided by that of emission(). It exceeds 1 where the
/// medium is hotter than its reference temperature.
inline float share_of_emission(const Medium& medium, const glm::vec3& place) {
    const auto* varying = std::get_if<VaryingMedium>(&medium);
    if (!varying) return 1.0f;
    PointBatch places{};
    places.x[0] = place.x;
    places.y[0] = place.y;
    places.z[0] = place.z;
    return varying->brightness_at(places)[0];
}
/// The spectrum of the emission; null if unknown.
inline SharedLightSpectrum emission_spectrum(const Medium& medium) {
    return std::visit(
        []<class Kind>(const Kind& kind) -> SharedLightSpectrum {
            if constexpr (ScatteringMediumKind<Kind>)
                return kind.coefficients().emission_spectrum;
            else
                return nullptr;
        },
        medium);
}
/// σt where the medium is densest, for red, green and blue.
inline glm::vec3 extinction(const Medium& medium) {
    return std::visit(
        []<class Kind>(const Kind& kind) {
            if constexpr (ScatteringMediumKind<Kind>)
                return kind.coefficients().extinction();
            else
                return kind.absorption.rgb();
        },
        medium);
}
inline bool is_emissive(const Medium& medium) {
    return emission(medium) != glm::vec3(0.0f);
}

/// The flight of a path through a medium of any kind; deterministic if the medium only absorbs.
inline Flight fly(const Medium& medium, const Way& way, const glm::vec3& throughput, Sampler& sampler) {
    return std::visit(
        [&]<class Kind>(const Kind& kind) {
            if constexpr (ScatteringMediumKind<Kind>)
                return kind.fly(way, throughput, sampler);
            else
                return Flight{.weight = kind.transmittance(way, sampler)};
        },
        medium);
}

/// The phase function of a medium; null for a kind that never scatters.
inline const PhaseFunction* phase_function(const Medium& medium) {
    return std::visit(
        []<class Kind>(const Kind& kind) -> const PhaseFunction* {
            if constexpr (ScatteringMediumKind<Kind>)
                return &kind.phase_function();
            else
                return nullptr;
        },
        medium);
}

}  // namespace phasetree::tracer
