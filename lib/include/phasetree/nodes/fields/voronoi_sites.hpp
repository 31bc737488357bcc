#pragma once

#include <array>

#include "phasetree/nodes/fields/lattice_hash.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// One site for each cube of a lattice, moved from the cube's middle by up to half the jitter along each axis. Points
/// are measured in cubes. The hash repeats after 289 cubes.
///
/// The sites of the 5³ cubes about a point's own are looked at. Its own cube's site is within √3 (1 + j)/2 of it; a
/// site of any other cube is at least (5 − j)/2 away, which is more, for all j ≤ 1. So the nearest site is always
/// found.
struct VoronoiSites {
    float jitter = 1;
    float seed = 0;

    static constexpr int neighbours = 125;

    /// How far sites that are not looked at are, at the least, in cubes.
    float unseen() const { return 0.5f * (5 - jitter); }
    /// How far the nearest site is, at the most.
    float nearest() const { return 0.8660255f * (1 + jitter); }

    /// Calls visit(offset from p to the site, hash) for the sites about p; the hash is whole, 0 … 288.
    template <class T, class Visit>
    void for_each(const Vec3<T>& p, Visit&& visit) const {
        using lattice::hashed, lattice::sum, lattice::wrapped;
        // The pattern is constant beyond 2¹⁶ cubes, so that the hash stays exact.
        const T far(65536.f);
        const Vec3<T> q{clamp(p.x, -far, far), clamp(p.y, -far, far), clamp(p.z, -far, far)};
        const Vec3<T> cell{floor(q.x), floor(q.y), floor(q.z)};
        const Vec3<T> in_cell{q.x - cell.x, q.y - cell.y, q.z - cell.z};
        for (int k = -2; k <= 2; ++k) {
            const T slice = hashed(wrapped(cell.z + (static_cast<float>(k) + seed)));
            for (int j = -2; j <= 2; ++j) {
                const T row = hashed(sum(slice, wrapped(cell.y + static_cast<float>(j))));
                for (int i = -2; i <= 2; ++i) {
                    const T x = hashed(sum(row, wrapped(cell.x + static_cast<float>(i))));
                    const T y = hashed(x + 1.f), z = hashed(y + 2.f), hash = hashed(z + 3.f);
                    const auto moved = [&](const T& h, int step) {
                        return h * (jitter / 288.f) + (static_cast<float>(step) + 0.5f - 0.5f * jitter);
                    };
                    visit(Vec3<T>{moved(x, i) - in_cell.x, moved(y, j) - in_cell.y, moved(z, k) - in_cell.z}, hash);
                }
            }
        }
    }
};

namespace detail {
inline constexpr Parameter voronoi_size{"size", "m", "Of the cubes that have a site each.", limits::positive};
inline constexpr Parameter voronoi_jitter{
    "jitter", "", "How irregular: 0 for sites on a cubic lattice, 1 for any place in their cubes.", limits::fraction,
    true};
inline constexpr Parameter voronoi_seed{"seed", "", "Another number, another pattern.", Limits{.low = 0, .high = 288},
                                        true};
}  // namespace detail

}  // namespace phasetree
