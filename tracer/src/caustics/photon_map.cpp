#include "caustics/photon_map.hpp"

#include <numbers>

#include "sampling/warps.hpp"

namespace phasetree::tracer {

PhotonMap::PhotonMap(const TracedPhotons& photons, std::size_t emitted, float radius,
                     const std::optional<Wavelengths>& wavelengths)
    : wavelengths_(wavelengths),
      radius_(radius),
      expected_(static_cast<float>(emitted) * pi * radius * radius),
      on_surfaces_(photons.on_surfaces, radius),
      on_interfaces_(photons.on_interfaces, radius),
      // Photons within r across a line and h along it are within √(r² + h²).
      in_media_(photons.in_media, radius * std::numbers::sqrt2_v<float> * (1 + 1e-5f)) {}

}  // namespace phasetree::tracer
