#include "caustics/photon_map.hpp"

#include <bit>
#include <utility>

#include "sampling/warps.hpp"

namespace phasetree::tracer {

PhotonMap::PhotonMap(std::vector<Photon> photons, std::size_t emitted, float radius,
                     const std::optional<Wavelength>& wavelength)
    : wavelength_(wavelength), radius_(radius), expected_(static_cast<float>(emitted) * pi * radius * radius) {
    if (photons.empty()) return;
    // A counting sort, which keeps the order of photons within a bucket.
    starts_.assign(std::bit_ceil(photons.size()) + 1, 0);
    for (const Photon& photon : photons) ++starts_[bucket_of(cube_of(photon.position)) + 1];
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
    photons_.resize(photons.size());
    for (const Photon& photon : photons) photons_[next[bucket_of(cube_of(photon.position))]++] = photon;
}

// The multipliers are those of Teschner et al.: Optimized Spatial Hashing for Collision Detection of Deformable
// Objects, VMV 2003.
std::size_t PhotonMap::bucket_of(const glm::ivec3& cube) const {
    const glm::uvec3 c(cube);
    const std::uint32_t hash = c.x * 73856093u ^ c.y * 19349663u ^ c.z * 83492791u;
    return (hash ^ hash >> 15) & (starts_.size() - 2);
}

}  // namespace phasetree::tracer
