// The photons of one pass over the picture, and queries for those that count at a point (Jensen: Global Illumination
// using Photon Maps, EGWR 1996).
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include "caustics/photon.hpp"
#include "caustics/photon_grid.hpp"
#include "spectrum/wavelengths.hpp"

namespace phasetree::tracer {

class PhotonMap {
  public:
    /// `emitted` counts all emitted photons, including those that landed nowhere. Photons are given in their order.
    PhotonMap(const TracedPhotons& photons, std::size_t emitted, float radius,
              const std::optional<Wavelengths>& wavelengths = {});

    /// The wavelengths of dispersed photons, and so of the paths that gather them.
    const std::optional<Wavelengths>& wavelengths() const { return wavelengths_; }

    /// N π r², which converts a density of lines, p(line), to the expected number of photons in the gathering disc.
    float expected() const { return expected_; }
    /// The distance along its line over which a photon in a medium counts, for this gathering radius: h in
    /// photon_placement.hpp.
    static float half_length(float radius) { return radius; }
    float half_length() const { return half_length(radius_); }

    /// Calls use(photon) for each photon, in any phase, within the radius of a surface point. Photons farther from the
    /// tangent plane than a quarter of the radius are skipped: a surface that is nearly flat within the radius has
    /// none, so they landed on another one. The estimate of the irradiance is the sum of the photons' powers over
    /// expected(), because powers are already divided by p(line). Where a surface is strongly curved or ends, it covers
    /// less than the disc, and the estimate is too dark within the radius.
    template <class Use>
    void near(const glm::vec3& point, const glm::vec3& normal, Use&& use) const {
        near_of(on_surfaces_, point, normal, use);
    }
    /// As above, for photons that met a rough interface, from either side.
    template <class Use>
    void near_at_interface(const glm::vec3& point, const glm::vec3& normal, Use&& use) const {
        near_of(on_interfaces_, point, normal, use);
    }
    /// Calls use(photon, depth) for each photon in the phase whose line passes within the radius of a point in a
    /// medium, and whose own point on the line is near enough to count there (photon_placement.hpp). The depth is that
    /// of the closest point of the line, and is at least −h. The estimate of the fluence is the sum of
    ///     powers · transmittance(depth) / (expected() · coverage(depth)).
    template <class Use>
    void near_in_medium(const glm::vec3& point, Phase phase, Use&& use) const {
        in_media_.near(point, [&](const MediumPhoton& medium, const glm::vec3& offset) {
            if (medium.photon.phase != phase) return;
            // The distance from the photon's stored point to the closest point of its line, positive farther along its
            // way. The offset leads from the query point to the stored point, and the direction back to where the
            // photon came from.
            const float further = glm::dot(offset, medium.photon.direction);
            const float across = glm::dot(offset, offset) - further * further;
            const float depth = medium.depth + further;
            if (across <= radius_ * radius_ && std::abs(further) <= half_length()) use(medium.photon, depth);
        });
    }

  private:
    struct OfSurface {
        const glm::vec3& operator()(const Photon& photon) const { return photon.position; }
    };
    struct OfMedium {
        const glm::vec3& operator()(const MediumPhoton& photon) const { return photon.photon.position; }
    };

    using SurfacePhotons = PhotonGrid<Photon, OfSurface>;

    template <class Use>
    void near_of(const SurfacePhotons& photons, const glm::vec3& point, const glm::vec3& normal, Use&& use) const {
        photons.near(point, [&](const Photon& photon, const glm::vec3& offset) {
            if (std::abs(glm::dot(offset, normal)) <= 0.25f * radius_) use(photon);
        });
    }

    std::optional<Wavelengths> wavelengths_;
    float radius_;
    float expected_;
    SurfacePhotons on_surfaces_, on_interfaces_;
    PhotonGrid<MediumPhoton, OfMedium> in_media_;
};

}  // namespace phasetree::tracer
