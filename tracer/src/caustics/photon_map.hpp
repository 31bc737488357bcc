// The photons of one pass over the picture, and which of them lie near a point (Jensen: Global Illumination using
// Photon Maps, EGWR 1996). They lie in a grid of cubes of twice the radius, sorted by cube, so that at most eight cubes
// are searched.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "caustics/photon.hpp"
#include "spectrum/wavelength.hpp"

namespace phasetree::tracer {

class PhotonMap {
  public:
    /// `emitted` counts all photons that started, those too that fell nowhere. The order of the photons is that in
    /// which near() gives those of a cube.
    PhotonMap(std::vector<Photon> photons, std::size_t emitted, float radius,
              const std::optional<Wavelength>& wavelength = {});

    /// Of the photons that were dispersed, and so of the paths that gather them.
    const std::optional<Wavelength>& wavelength() const { return wavelength_; }

    /// How many photons a unit of density of lines brings to the disc in which near() searches: N π r².
    float expected() const { return expected_; }

    /// Calls use(photon) for each photon of the phase within the radius of a point of a surface. Those that lie off its
    /// plane by more than a quarter of the radius are left out, because they fell on another surface. The estimate of
    /// the irradiance is the sum of their powers over expected().
    template <class Use>
    void near(const glm::vec3& point, const glm::vec3& normal, Phase phase, Use&& use) const {
        if (photons_.empty()) return;
        const glm::ivec3 first = cube_of(point - radius_), last = cube_of(point + radius_);
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x) {
                    const std::size_t bucket = bucket_of({x, y, z});
                    for (std::uint32_t i = starts_[bucket]; i < starts_[bucket + 1]; ++i) {
                        const Photon& photon = photons_[i];
                        const glm::vec3 offset = photon.position - point;
                        if (glm::dot(offset, offset) > radius_ * radius_ || photon.phase != phase) continue;
                        if (std::abs(glm::dot(offset, normal)) > 0.25f * radius_) continue;
                        // Different cubes may share a bucket; each photon counts in its own cube alone.
                        if (cube_of(photon.position) == glm::ivec3(x, y, z)) use(photon);
                    }
                }
    }

  private:
    glm::ivec3 cube_of(const glm::vec3& p) const { return glm::ivec3(glm::floor(p / (2.0f * radius_))); }
    std::size_t bucket_of(const glm::ivec3& cube) const;

    std::optional<Wavelength> wavelength_;
    float radius_;
    float expected_;
    std::vector<Photon> photons_;        ///< by bucket
    std::vector<std::uint32_t> starts_;  ///< of each bucket, and the end of the last
};

}  // namespace phasetree::tracer
