// The photons of one pass over the picture, and which of them count at a point (Jensen: Global Illumination using
// Photon Maps, EGWR 1996).
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
    /// `emitted` counts all photons that started, those too that fell nowhere. Photons are given in their order.
    PhotonMap(const TracedPhotons& photons, std::size_t emitted, float radius,
              const std::optional<Wavelengths>& wavelengths = {});

    /// Of the photons that were dispersed, and so of the paths that gather them.
    const std::optional<Wavelengths>& wavelengths() const { return wavelengths_; }

    /// N π r², by which a density of lines, p(line), becomes the expected number of photons in the disc in which
    /// photons are gathered.
    float expected() const { return expected_; }
    /// How far along its line a photon in a medium counts, if photons are gathered within this radius: h of
    /// photon_placement.hpp.
    static float half_length(float radius) { return radius; }
    float half_length() const { return half_length(radius_); }

    /// Calls use(photon) for each photon, of whatever phase, within the radius of a point of a surface. Those that lie
    /// off its plane by more than a quarter of the radius are left out: on a surface that is nearly flat within the
    /// radius none does, so they fell on another one. The estimate of the irradiance is the sum of their powers over
    /// expected(), because powers have been divided by p(line). Where a surface is strongly curved or ends, the photons
    /// of less than the disc are counted, and the estimate is too dark within the radius.
    template <class Use>
    void near(const glm::vec3& point, const glm::vec3& normal, Use&& use) const {
        near_of(on_surfaces_, point, normal, use);
    }
    /// The same of photons that met a rough interface, from either side.
    template <class Use>
    void near_at_interface(const glm::vec3& point, const glm::vec3& normal, Use&& use) const {
        near_of(on_interfaces_, point, normal, use);
    }
    /// Calls use(photon, depth) for each photon of the phase whose line passes within the radius of a point of a
    /// medium, and whose place on the line is near enough to count there (photon_placement.hpp). The depth is that of
    /// the line's nearest point, and is at least −h. The estimate of the fluence is the sum of
    /// powers · transmittance(depth) / (expected() · coverage(depth)).
    template <class Use>
    void near_in_medium(const glm::vec3& point, Phase phase, Use&& use) const {
        in_media_.near(point, [&](const MediumPhoton& medium, const glm::vec3& offset) {
            if (medium.photon.phase != phase) return;
            // How much further on its way than at its place the photon passed nearest to the point: the offset leads
            // from the point to the place, and the direction back to where the photon came from.
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
