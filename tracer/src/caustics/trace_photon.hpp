// A photon's way from a light through smooth interfaces of clear phases.
#pragma once

#include <optional>

#include "caustics/emission.hpp"
#include "caustics/photon.hpp"

namespace phasetree::tracer {

/// Follows a photon as shadow rays are followed (path.hpp), in the other direction: reflected or refracted by Fresnel's
/// odds, and dimmed by the media. It is added to `traced` where it falls on a surface, and with a place in each
/// scattering medium on its way there (photon_placement.hpp); but not before it has met an interface, not where photons
/// light nothing, and not at all if the way back to the light is blocked. Dispersion leaves light of the wavelength,
/// which must be there if anything in the world disperses. Photons will be gathered within the radius.
void trace_photon(const World& world, const Scene& scene, const EmittedPhoton& emitted, float radius, Sampler& sampler,
                  PathCounters& counters, TracedPhotons& traced, const std::optional<Wavelength>& wavelength = {});

/// Whether photons that fall on a surface light it: it scatters, and is no boundary of two clear media.
bool is_lit_by_photons(const Surface& surface, const Bsdf& bsdf);

}  // namespace phasetree::tracer
