#include "phasetree/nodes/phased/voronoi.hpp"

#include <algorithm>
#include <cmath>

#include "phasetree/math/portable.hpp"
#include "phasetree/nodes/fields/voronoi_cells.hpp"

namespace phasetree {

namespace {

// The error of positions, in cubes: positions here are doubles, but values are computed with floats.
double margin(const std::array<double, 3>& p) {
    return 1e-3 + 1e-5 * (std::abs(p[0]) + std::abs(p[1]) + std::abs(p[2]));
}
// Larger boxes would have long lists. Farther from the origin, the pattern is different: it ends at 65536.
constexpr double largest_radius = 1, farthest = 60000;
constexpr std::size_t most_sites = 100;

// A box measured in cubes of the lattice.
PointRange in_cubes(PointRange r, float size) {
    for (int i = 0; i < 3; ++i) {
        r.centre[i] /= static_cast<double>(size);
        r.half_extents[i] /= static_cast<double>(size);
    }
    return r;
}
double radius(const PointRange& r) {
    return portable::hypot(r.half_extents[0], r.half_extents[1], r.half_extents[2]);
}
bool is_small(const PointRange& r) {
    return radius(r) < largest_radius &&
           std::abs(r.centre[0]) + std::abs(r.centre[1]) + std::abs(r.centre[2]) < farthest;
}

// The list of sites in floats written by append(); empty if there are none.
std::span<const float> sites_of(std::span<const float> of) {
    return of.empty() ? of : SpecialisedVoronoi::list(of.data());
}
// Appends the data of a SpecialisedVoronoi. Returns false, appending nothing, if there are too many sites.
bool append(std::span<const VoronoiSites::Site> sites, std::array<float, SpecialisedVoronoi::parameters> parameters,
            std::vector<float>& floats) {
    if (sites.size() > most_sites) return false;
    floats.insert(floats.end(), parameters.begin(), parameters.end());
    floats.push_back(static_cast<float>(sites.size() * VoronoiSites::site_floats));
    for (const VoronoiSites::Site& s : sites) {
        floats.insert(floats.end(), s.cube.begin(), s.cube.end());
        floats.insert(floats.end(), s.in_cube.begin(), s.in_cube.end());
        floats.push_back(s.hash);
    }
    return true;
}

}  // namespace

void VoronoiSites::find(const Search& search, std::span<const float> list, std::vector<Site>& found) const {
    using lattice::hashed, lattice::hashed_on, lattice::wrapped;
    const std::array<double, 3>& centre = search.centre;
    const double corner = static_cast<double>(from_corner(0.f)), highest = static_cast<double>(jitter) + corner;
    double farthest = search.most;
    found.clear();
    const auto add = [&](Site s) {
        if (s.hash < search.low || s.hash >= search.high) return;
        double squared = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            s.position[axis] = static_cast<double>(s.cube[axis]) + static_cast<double>(s.in_cube[axis]) + corner;
            squared += (s.position[axis] - centre[axis]) * (s.position[axis] - centre[axis]);
        }
        s.distance = std::sqrt(squared);
        if (s.distance > farthest) return;
        farthest = std::min(farthest, s.distance + search.beyond);
        found.push_back(s);
    };
    if (!list.empty()) {
        for (; !list.empty(); list = list.subspan(site_floats))
            add({{list[0], list[1], list[2]}, {list[3], list[4], list[5]}, list[6], {}, 0});
    } else {
        std::array<float, 3> own;
        for (std::size_t axis = 0; axis < 3; ++axis) own[axis] = static_cast<float>(std::floor(centre[axis]));
        const int steps = static_cast<int>(std::ceil(search.most));
        // A lower bound on the squared distance, along an axis, to the sites of a layer of cubes.
        const auto away = [&](std::size_t axis, int step) {
            const double low = static_cast<double>(own[axis]) + step + corner - centre[axis];
            const double high = static_cast<double>(own[axis]) + step + highest - centre[axis];
            const double least = std::max({low, -high, 0.0});
            return least * least;
        };
        for (int k = -steps; k <= steps; ++k) {
            const double z2 = away(2, k);
            if (z2 > farthest * farthest) continue;
            const float z = own[2] + static_cast<float>(k), slice = hashed_on(wrapped(z + seed));
            for (int j = -steps; j <= steps; ++j) {
                const double yz2 = z2 + away(1, j);
                if (yz2 > farthest * farthest) continue;
                const float y = own[1] + static_cast<float>(j), row = hashed_on(slice + wrapped(y));
                for (int i = -steps; i <= steps; ++i) {
                    if (yz2 + away(0, i) > farthest * farthest) continue;
                    const float x = own[0] + static_cast<float>(i);
                    const float a = hashed(row + wrapped(x)), b = hashed(a + 1.f), c = hashed(b + 2.f);
                    add({{x, y, z}, {moved(a), moved(b), moved(c)}, hashed(c + 3.f), {}, 0});
                }
            }
        }
    }
    std::erase_if(found, [&](const Site& s) { return s.distance > farthest; });
}

bool VoronoiCells::specialise(const PointRange& range, std::span<const float> of, std::vector<float>& floats) const {
    const PointRange box = in_cubes(range, size);
    if (!is_small(box)) return false;
    const VoronoiSites sites{jitter, seed};
    const double extra = 2 * (radius(box) + margin(box.centre)), far = static_cast<double>(seen());
    // The distance to the bisector of two sites is at least half the difference of the distances to both.
    std::vector<VoronoiSites::Site> found;
    sites.find({.centre = box.centre,
                .most = static_cast<double>(sites.nearest()) + extra + 2 * far,
                .beyond = extra + 2 * far},
               sites_of(of), found);
    const auto nearest = std::ranges::min_element(found, {}, &VoronoiSites::Site::distance);
    const auto may_be_nearest = [&](const VoronoiSites::Site& s) { return s.distance <= nearest->distance + extra; };
    if (std::ranges::count_if(found, may_be_nearest) == 1) {
        // Only one site can be nearest in the box, so its bisectors are planes, whose distance from the box is exact.
        const VoronoiSites::Site s = *nearest;
        std::erase_if(found, [&](const VoronoiSites::Site& t) {
            std::array<double, 3> between;
            for (std::size_t i = 0; i < 3; ++i) between[i] = t.position[i] - s.position[i];
            const double apart = portable::hypot(between[0], between[1], between[2]);
            if (apart == 0) return false;
            double bisector = 0.5 * (t.distance - s.distance) * (t.distance + s.distance) / apart;
            for (std::size_t i = 0; i < 3; ++i) bisector -= std::abs(between[i]) / apart * box.half_extents[i];
            return bisector - margin(box.centre) > far;
        });
    }
    return append(found, {size, gap, rounding, jitter, seed}, floats);
}

bool Voronoi::Nearest::specialise(const PointRange& range, std::span<const float> of,
                                  std::vector<float>& floats) const {
    const PointRange box = in_cubes(range, size);
    if (!is_small(box)) return false;
    const VoronoiSites sites{jitter, seed};
    const double extra = radius(box) + margin(box.centre);
    std::vector<VoronoiSites::Site> found;
    sites.find({.centre = box.centre,
                .most = static_cast<double>(sites.unseen()) + extra,
                .beyond = 2 * extra,
                .low = first_hash(),
                .high = end_hash()},
               sites_of(of), found);
    return append(found, {size, jitter, seed, kinds, kind}, floats);
}

}  // namespace phasetree
