// A photon's way from a light through smooth interfaces of clear phases.
#pragma once

#include <optional>

#include "caustics/emission.hpp"
#include "caustics/photon.hpp"

namespace phasetree::tracer {

/// Follows a photon as shadow rays are followed (path.hpp), in the other direction: reflected or refracted by Fresnel's
/// odds, and dimmed by the media. Nothing if it meets no interface before it falls on something, if what it falls on
/// cannot be lit by a photon, or if the way back to the light is blocked. Dispersion leaves light of the wavelength,
/// which must be there if anything in the world disperses.
std::optional<Photon> trace_photon(const World& world, const Scene& scene, const EmittedPhoton& emitted,
                                   Sampler& sampler, PathCounters& counters,
                                   const std::optional<Wavelength>& wavelength = {});

/// Whether photons that fall on a surface light it: it scatters, and is no boundary of two clear media.
bool is_lit_by_photons(const Surface& surface, const Bsdf& bsdf);

}  // namespace phasetree::tracer
