// What a medium must provide: the interior of a clear phase, through which rays travel.
//
// Of a ray's way through a medium an integrator asks one of three questions. A photon wants to know what is left of
// light that goes straight on: the transmittance. A shadow ray wants to know as well what the medium itself sends along
// the way: its passage. A path wants to know where it is scattered, if at all: its flight. All are estimates where
// there is no closed form; their means are exact.
#pragma once

#include <concepts>
#include <glm/vec3.hpp>
#include <optional>

#include "media/coefficients.hpp"
#include "media/henyey_greenstein.hpp"
#include "sampling/sobol.hpp"
#include "spectrum/wavelengths.hpp"

namespace phasetree::tracer {

/// A straight way through a medium. Its length, in the scene's unit, may be infinite.
struct Way {
    glm::vec3 origin;
    glm::vec3 direction;  ///< of unit length in the scene (TracedGeometry::way_through_medium())
    float length;
    const Wavelengths* wavelengths = nullptr;  ///< of the light; none if its numbers are red, green and blue
};

/// What becomes of a path on its way. Each of its three numbers, here called channels, has a weight, which multiplies
/// the path's throughput.
struct Flight {
    glm::vec3 weight{1.0f};
    std::optional<float> scattered_at{};  ///< the distance at which it is scattered; none if it gets to the way's end
    glm::vec3 emitted{0.0f};              ///< radiance that the medium adds on the way, by the throughput at its start
};

/// What arrives at a way's start, where nothing is scattered.
struct Passage {
    glm::vec3 left{1.0f};     ///< the part of the radiance that comes in at the way's end
    glm::vec3 emitted{0.0f};  ///< radiance that the medium adds
};

/// * transmittance(way, sampler): an estimate, for each colour channel, of the part of the radiance that is left after
///   the way. It is 1 for a way of length 0, and in [0, 1] for all.
template <class M>
concept MediumKind = std::copyable<M> && requires(const M& medium, const Way& way, Sampler& sampler) {
    { medium.transmittance(way, sampler) } -> std::same_as<glm::vec3>;
};

/// A medium that scatters or shines also has
/// * fly(way, throughput, sampler): a flight. Channels are sampled in proportion to the path's throughput (greater than
///   0 in one channel at least), and a flight's weights never make the sum of the throughput's channels greater.
/// * pass(way, sampler): a passage. The part that is left is a transmittance.
/// * coefficients(): what it is made of, where it is densest.
/// * phase_function(): how light is scattered, the same everywhere in the medium.
template <class M>
concept ScatteringMediumKind = MediumKind<M> &&
    requires(const M& medium, const Way& way, const glm::vec3& throughput, Sampler& sampler) {
    { medium.fly(way, throughput, sampler) } -> std::same_as<Flight>;
    { medium.pass(way, sampler) } -> std::same_as<Passage>;
    { medium.coefficients() } -> std::same_as<const ScatteringCoefficients&>;
    { medium.phase_function() } -> std::same_as<const HenyeyGreenstein&>;
};

}  // namespace phasetree::tracer
