// The list of all media, and a medium of any kind by value.
#pragma once

#include <optional>
#include <variant>

#include "media/absorbing.hpp"
#include "media/contract.hpp"
#include "media/homogeneous.hpp"
#include "media/varying.hpp"

namespace phasetree::tracer {

/// A kind of medium, once its contract has been asked of it. If it does not meet that, the message names the kind and
/// the member.
template <class Kind>
struct CheckedMedium {
    static_assert(MediumKind<Kind>);
    using Type = Kind;
};

template <class... Kinds>
using MediumOf = std::variant<typename CheckedMedium<Kinds>::Type...>;

/// Every kind of medium. The first is the default, and lets everything pass as long as nothing else is said.
using Medium = MediumOf<AbsorbingMedium, HomogeneousMedium, VaryingMedium>;

/// MediumKind's transmittance of a medium of any kind.
inline glm::vec3 transmittance(const Medium& medium, const Way& way, Sampler& sampler) {
    return std::visit([&](const auto& kind) { return kind.transmittance(way, sampler); }, medium);
}

/// MediumKind's passage of a medium of any kind; one that only absorbs shines not.
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

/// What it shines by itself where it is densest, in radiance per unit of length, in red, green and blue.
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
/// The luminance of what it shines by itself at a place, in the space of Way, over that of emission(); more
/// than 1 where it is hotter than the medium's reference.
inline float share_of_emission(const Medium& medium, const glm::vec3& place) {
    const auto* varying = std::get_if<VaryingMedium>(&medium);
    if (!varying) return 1.0f;
    PointBatch places{};
    places.x[0] = place.x;
    places.y[0] = place.y;
    places.z[0] = place.z;
    return varying->brightness_at(places)[0];
}
/// The spectrum of that; null if it is not known.
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
/// Its σt where it is densest, of red, green and blue.
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
inline bool shines(const Medium& medium) {
    return emission(medium) != glm::vec3(0.0f);
}

/// The flight of a path through a medium of any kind; through one that only absorbs nothing is random.
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

/// How a medium scatters light; none for a kind that never does.
inline const HenyeyGreenstein* phase_function(const Medium& medium) {
    return std::visit(
        []<class Kind>(const Kind& kind) -> const HenyeyGreenstein* {
            if constexpr (ScatteringMediumKind<Kind>)
                return &kind.phase_function();
            else
                return nullptr;
        },
        medium);
}

}  // namespace phasetree::tracer
