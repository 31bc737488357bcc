// Requirements on a medium: the interior of a clear phase, through which rays travel.
//
// An integrator needs one of three quantities for a ray segment in a medium. A photon needs the transmittance. A shadow
// ray needs the transmittance and the emission along the segment: its passage. A path needs the point where it is
// scattered, if any: its flight. All are estimates where there is no closed form, and all are unbiased.
#pragma once

#include <concepts>
#include <glm/vec3.hpp>
#include <optional>

#include "media/coefficients.hpp"
#include "media/phase_function.hpp"
#include "sampling/sobol.hpp"
#include "spectrum/wavelengths.hpp"

namespace phasetree::tracer {

/// A straight segment through a medium. Its length, in the scene's unit, may be infinite.
struct Way {
    glm::vec3 origin;
    glm::vec3 direction;  ///< unit length in the scene (TracedGeometry::way_through_medium())
    float length;
    const Wavelengths* wavelengths = nullptr;  ///< of the light; null if its components are red, green and blue
};

/// The result of sampling a path along a segment. Each of the three components, here called channels, has a weight that
/// multiplies the path's throughput.
struct Flight {
    glm::vec3 weight{1.0f};
    std::optional<float> scattered_at{};  ///< distance of scattering; nullopt if the path reaches the end of the
                                          ///< segment
    glm::vec3 emitted{0.0f};              ///< radiance emitted by the medium, relative to the throughput at the start
};

/// The light that arrives at the start of a segment without scattering.
struct Passage {
    glm::vec3 left{1.0f};     ///< transmittance for radiance that enters at the end
    glm::vec3 emitted{0.0f};  ///< radiance emitted by the medium
};

/// * transmittance(way, sampler): an estimate of the transmittance of the segment for each colour channel. It is 1 for
///   a segment of length 0, and always in [0, 1].
template <class M>
concept MediumKind = std::copyable<M> && requires(const M& medium, const Way& way, Sampler& sampler) {
    { medium.transmittance(way, sampler) } -> std::same_as<glm::vec3>;
};

/// A medium that scatters or emits also has
/// * fly(way, throughput, sampler): a flight. Channels are sampled in proportion to the path's throughput, which must
///   be positive in at least one channel. The weights of a flight never increase the sum of the throughput's channels.
/// * pass(way, sampler): a passage. Its `left` is a transmittance.
/// * coefficients(): the coefficients where the medium is densest.
/// * phase_function(): the phase function, the same everywhere in the medium.
template <class M>
concept ScatteringMediumKind = MediumKind<M> &&
    requires(const M& medium, const Way& way, const glm::vec3& throughput, Sampler& sampler) {
    { medium.fly(way, throughput, sampler) } -> std::same_as<Flight>;
    { medium.pass(way, sampler) } -> std::same_as<Passage>;
    { medium.coefficients() } -> std::same_as<const ScatteringCoefficients&>;
    { medium.phase_function() } -> std::same_as<const PhaseFunction&>;
};

}  // namespace phasetree::tracer
