#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "phasetree/math/lattice_hash.hpp"
#include "phasetree/math/point_range.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// One site per cube of a lattice, displaced from the cube's centre by up to half the jitter along each axis.
/// Coordinates are in cubes. The hash repeats after 289 cubes.
///
/// The sites of the 5³ cubes centred on a point's own cube are visited. The site of the point's own cube is within √3
/// (1 + j)/2 of the point. A site of any unvisited cube is at least (5 − j)/2 away, which is more for all j ≤ 1. So the
/// nearest site is always found.
struct VoronoiSites {
    float jitter = 1;
    float seed = 0;

    static constexpr int neighbours = 125;

    /// A lower bound on the distance, in cubes, to all sites that are not visited.
    float unseen() const { return 0.5f * (5 - jitter); }
    /// An upper bound on the distance, in cubes, to the nearest site.
    float nearest() const { return 0.8660255f * (1 + jitter); }

    /// A point's cube, and its position in the cube. The pattern is constant beyond 2¹⁶ cubes, so that the hash stays
    /// exact.
    template <class T>
    struct Place {
        Vec3<T> cube, within;

        explicit Place(const Vec3<T>& p) {
            const T far(65536.f);
            const Vec3<T> q{clamp(p.x, -far, far), clamp(p.y, -far, far), clamp(p.z, -far, far)};
            cube = {floor(q.x), floor(q.y), floor(q.z)};
            within = {q.x - cube.x, q.y - cube.y, q.z - cube.z};
        }
    };
    /// Convert a hash to the site's position in its cube along one axis, measured from the lowest position that the
    /// jitter allows.
    template <class T>
    T moved(const T& hash) const {
        return hash * (jitter / 288.f);
    }
    /// The lowest position, along one axis, that the jitter allows for a site in the cube that is `step` cubes ahead.
    template <class T>
    T from_corner(const T& step) const {
        return step + 0.5f - 0.5f * jitter;
    }

    /// Call visit(offset from p to the site, hash) for the sites around p. The hash is an integer, 0 … 288.
    template <class T, class Visit>
    void for_each(const Vec3<T>& p, Visit&& visit) const {
        using lattice::hashed, lattice::hashed_on, lattice::wrapped;
        const Place<T> at(p);
        const Vec3<T>&cube = at.cube, &within = at.within;
        const T x_mod = wrapped(cube.x), y_mod = wrapped(cube.y), z_mod = wrapped(cube.z + seed);
        for (int k = -2; k <= 2; ++k) {
            const T slice = hashed_on(z_mod + static_cast<float>(k));
            for (int j = -2; j <= 2; ++j) {
                const T row = hashed_on(slice + (y_mod + static_cast<float>(j)));
                for (int i = -2; i <= 2; ++i) {
                    const T x = hashed(row + (x_mod + static_cast<float>(i)));
                    const T y = hashed(x + 1.f), z = hashed(y + 2.f), hash = hashed(z + 3.f);
                    const auto offset = [&](const T& h, int step, const T& in) {
                        return moved(h) + from_corner(static_cast<float>(step)) - in;
                    };
                    visit(Vec3<T>{offset(x, i, within.x), offset(y, j, within.y), offset(z, k, within.z)}, hash);
                }
            }
        }
    }

    /// A site: its cube, its position in the cube along each axis (see moved()) and its hash.
    struct Site {
        std::array<float, 3> cube, in_cube;
        float hash;
        std::array<double, 3> position;  ///< in cubes
        double distance;                 ///< from the centre of the search
    };
    /// Selects the sites with a hash in [low, high) whose distance from a point is at most `most`, and at most `beyond`
    /// more than that of the nearest site with such a hash. Lengths are in cubes.
    struct Search {
        std::array<double, 3> centre{};
        double most = 0, beyond = 0;
        float low = -1, high = 289;
    };
    /// Find these sites, in the order in which for_each() visits them. If the list is empty, all sites are searched,
    /// otherwise those of the list, which must contain the result.
    void find(const Search&, std::span<const float> list, std::vector<Site>& found) const;
    /// The number of floats per site in a list of sites.
    static constexpr unsigned site_floats = 7;
};

/// A list of sites instead of the whole lattice. Where no other site matters, it gives the values of VoronoiSites to
/// the last bit.
struct VoronoiSiteList {
    VoronoiSites all;
    std::span<const float> floats;  ///< VoronoiSites::site_floats per site

    template <class T, class Visit>
    void for_each(const Vec3<T>& p, Visit&& visit) const {
        const VoronoiSites::Place<T> at(p);
        for (std::size_t i = 0; i < floats.size(); i += VoronoiSites::site_floats) {
            const float* site = &floats[i];
            const auto offset = [&](int axis, const T& cube, const T& in) {
                return T(site[3 + axis]) + all.from_corner(T(site[axis]) - cube) - in;
            };
            visit(Vec3<T>{offset(0, at.cube.x, at.within.x), offset(1, at.cube.y, at.within.y),
                          offset(2, at.cube.z, at.within.z)},
                  T(site[6]));
        }
    }
};

/// The data of a Voronoi primitive that is specialised to a small box (LocalPrimitive): its five parameters, the number
/// of floats that follow, and the sites.
struct SpecialisedVoronoi {
    static constexpr std::size_t parameters = 5;

    std::vector<float> values{};

    std::span<const float> data() const { return values; }
    static std::size_t floats(const float* data) { return parameters + 1 + static_cast<std::size_t>(data[parameters]); }
    static unsigned sites(const float* data) {
        return static_cast<unsigned>(data[parameters]) / VoronoiSites::site_floats;
    }
    static std::span<const float> list(const float* data) {
        return {data + parameters + 1, static_cast<std::size_t>(data[parameters])};
    }
    static bool is_sound(std::span<const float> data) {
        if (data.size() < parameters + 1) return false;
        constexpr auto site = static_cast<float>(VoronoiSites::site_floats);
        const float count = data[parameters];
        return count >= 0 && count <= site * VoronoiSites::neighbours && count == site * std::floor(count / site) &&
               data.size() >= floats(data.data());
    }
};

namespace detail {
inline constexpr Parameter voronoi_size{"size", "m", "Edge length of the cubes, each of which has one site.",
                                        limits::positive};
inline constexpr Parameter voronoi_jitter{
    "jitter", "", "Irregularity: 0 puts the sites on a cubic lattice, 1 anywhere in their cubes.", limits::fraction,
    true};
inline constexpr Parameter voronoi_seed{"seed", "", "Seed of the pattern.", Limits{.low = 0, .high = 288}, true};
}  // namespace detail

}  // namespace phasetree
