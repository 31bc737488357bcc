// A photon's way from a light through interfaces of clear phases.
#pragma once

#include <optional>

#include "caustics/emission.hpp"
#include "caustics/photon.hpp"

namespace phasetree::tracer {

/// Follows a photon as paths are followed (path.hpp), in the other direction: reflected or refracted by smooth
/// interfaces by Fresnel's odds, scattered by rough ones, and dimmed by the media. It is added to `traced` where it
/// falls on a surface, and with a place in each scattering medium on its way there (photon_placement.hpp); but only
/// after it has met an interface, only on surfaces and in media that photons light, and only if nothing is between
/// where it started and the light. What is between may be the boundary of two phases of the same index: such light is
/// left to the other techniques. The photon is of the given wavelengths: if those are spectral it was emitted with
/// them, else it is from the first interface that disperses; without any it throws std::bad_optional_access there.
/// Photons will be gathered within the radius.
void trace_photon(const World& world, const Scene& scene, const EmittedPhoton& emitted, float radius, Sampler& sampler,
                  PathCounters& counters, TracedPhotons& traced, const std::optional<Wavelengths>& wavelengths = {});

}  // namespace phasetree::tracer
