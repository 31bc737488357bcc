// A hash grid of cubes for finding photons near a point. Cubes are as wide as the sphere that is searched, so that at
// most two are examined along each axis, or three where rounding makes the sphere wider.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace phasetree::tracer {

/// `position` is a callable that returns the position of a photon of type PhotonType.
template <class PhotonType, class Position>
class PhotonGrid {
  public:
    /// For searches within the radius. near() visits the photons of a cube in the given order.
    PhotonGrid(const std::vector<PhotonType>& photons, float radius, Position position = {})
        : radius_(radius), position_(position) {
        if (photons.empty()) return;
        // Counting sort, which keeps the order of photons within a bucket.
        starts_.assign(std::bit_ceil(photons.size()) + 1, 0);
        for (const PhotonType& photon : photons) ++starts_[bucket_of(cube_of(position_(photon))) + 1];
        for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
        std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
        photons_.resize(photons.size());
        for (const PhotonType& photon : photons) photons_[next[bucket_of(cube_of(position_(photon)))]++] = photon;
    }

    /// Calls use(photon, offset) for each photon within the radius of a point. The offset leads from the point to the
    /// photon's position.
    template <class Use>
    void near(const glm::vec3& point, Use&& use) const {
        if (photons_.empty()) return;
        const glm::ivec3 first = cube_of(point - radius_), last = cube_of(point + radius_);
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x) {
                    const std::size_t bucket = bucket_of({x, y, z});
                    for (std::uint32_t i = starts_[bucket]; i < starts_[bucket + 1]; ++i) {
                        const PhotonType& photon = photons_[i];
                        const glm::vec3 offset = position_(photon) - point;
                        if (glm::dot(offset, offset) > radius_ * radius_) continue;
                        // Different cubes may share a bucket; each photon counts in its own cube only.
                        if (cube_of(position_(photon)) == glm::ivec3(x, y, z)) use(photon, offset);
                    }
                }
    }

  private:
    // Positions very far away are clamped to the outermost cubes.
    glm::ivec3 cube_of(const glm::vec3& p) const {
        constexpr float outermost = 1e9f;
        return glm::ivec3(glm::clamp(glm::floor(p / (2.0f * radius_)), -outermost, outermost));
    }
    // The multipliers are those of Teschner et al.: Optimized Spatial Hashing for Collision Detection of Deformable
    // Objects, VMV 2003.
    std::size_t bucket_of(const glm::ivec3& cube) const {
        const glm::uvec3 c(cube);
        const std::uint32_t hash = c.x * 73856093u ^ c.y * 19349663u ^ c.z * 83492791u;
        return (hash ^ hash >> 15) & (starts_.size() - 2);
    }

    float radius_;
    Position position_;
    std::vector<PhotonType> photons_{};    ///< by bucket
    std::vector<std::uint32_t> starts_{};  ///< of each bucket, and the end of the last
};

}  // namespace phasetree::tracer
