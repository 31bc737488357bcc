// Traces a photon from a light through interfaces of clear phases.
#pragma once

#include <optional>

#include "caustics/emission.hpp"
#include "caustics/photon.hpp"

namespace phasetree::tracer {

/// Traces a photon as paths are traced (path.hpp), in the other direction: smooth interfaces reflect or refract it with
/// the probabilities of Fresnel's equations, rough ones scatter it, and media attenuate it. The photon is added to
/// `traced` where it lands on a surface, and with a point in each scattering medium on its way there
/// (photon_placement.hpp). It is added only after it has met an interface, only on surfaces and in media that gather
/// photons, and only if nothing occludes the light from where it started. An occluder may be the boundary of two phases
/// with the same index; such light is left to the other techniques.
///
/// The photon has the given wavelengths. If they are spectral, it was emitted with them; otherwise it has them from the
/// first interface that disperses. Without wavelengths, such an interface throws std::bad_optional_access. Photons will
/// be gathered within the radius.
void trace_photon(const World& world, const Scene& scene, const EmittedPhoton& emitted, float radius, Sampler& sampler,
                  PathCounters& counters, TracedPhotons& traced, const std::optional<Wavelengths>& wavelengths = {});

}  // namespace phasetree::tracer
