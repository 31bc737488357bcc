#pragma once

/// Patterns that fill space: Voronoi cells, endless copies, terrains of an image.

#include "support/random_tree.hpp"
#include "support/set_algebra/components.hpp"
#include "support/set_algebra/primitives.hpp"

namespace phasetree::tests::oracle {

struct Site {
    dvec3 at;
    long long hash;
};
inline long long scrambled(long long n) {
    const long long m = ((n % 289) + 289) % 289;
    return (34 * m + 5) * m % 289;
}
/// The sites of (2 reach + 1)³ cubes about the point, the nearest one first; in cubes.
inline std::vector<Site> sites(const dvec3& p, double jitter, double seed, int reach = 2) {
    std::vector<Site> all;
    const dvec3 cell = glm::floor(p);
    double least = absent;
    for (int k = -reach; k <= reach; ++k) {
        const long long slice = scrambled(std::llround(cell.z + k + seed));
        for (int j = -reach; j <= reach; ++j) {
            const long long row = scrambled(slice + std::llround(cell.y + j));
            for (int i = -reach; i <= reach; ++i) {
                const dvec3 c = cell + dvec3(i, j, k);
                const long long x = scrambled(row + std::llround(c.x)), y = scrambled(x + 1), z = scrambled(y + 2);
                const dvec3 moved =
                    dvec3(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)) / 288.0 - 0.5;
                all.push_back({c + 0.5 + moved * jitter, scrambled(z + 3)});
                const dvec3 away = all.back().at - p;
                if (const double squared = glm::dot(away, away); squared < least) {
                    least = squared;
                    std::swap(all.front(), all.back());
                }
            }
        }
    }
    return all;
}
template <class N>
std::vector<Site> sites_of(const N& n, const dvec3& p) {
    return sites(p / static_cast<double>(n.size), n.jitter, n.seed);
}
inline Phase phase_of(const Voronoi& n, const Site& s) {
    const auto kinds = static_cast<long long>(n.of_phases.size());
    return n.of_phases[static_cast<std::size_t>((2 * s.hash + 1) * kinds / 578)];
}
inline Phase region(const Voronoi& n, const dvec3& p) {
    return phase_of(n, sites_of(n, p).front());
}
inline Components components(const Voronoi& n, const dvec3& p) {
    const dvec3 q = p / static_cast<double>(n.size);
    Components nearest, r;
    for (const Phase k : n.of_phases) nearest[k.index] = (5 - static_cast<double>(n.jitter)) / 2;
    for (const Site& s : sites_of(n, p)) {
        double& d = nearest[phase_of(n, s).index];
        d = std::min(d, glm::length(s.at - q));
    }
    for (std::size_t i = 0; i < Components::size; ++i) {
        if (!(nearest[i] < absent)) continue;
        double others = absent;
        for (std::size_t j = 0; j < Components::size; ++j)
            if (j != i) others = std::min(others, nearest[j]);
        r[i] = (nearest[i] - others) / 2 * n.size;
    }
    return r;
}
inline double signed_value(const VoronoiCells& n, const dvec3& p) {
    const dvec3 q = p / static_cast<double>(n.size);
    const std::vector<Site> all = sites_of(n, p);
    const double j = n.jitter, seen = 0.999 * ((5 - j) / 2 - std::sqrt(3) * (1 + j) / 2) / 2,
                 c = n.rounding / static_cast<double>(n.size);
    const dvec3 s = all.front().at;
    double least = seen, sum = 0;
    int counted = 0;
    for (const Site& t : all) {
        if (glm::length(t.at - s) < 1e-5) continue;
        const double bisector = glm::dot(t.at - s, (t.at + s) / 2.0 - q) / glm::length(t.at - s);
        if (bisector >= seen) continue;
        least = std::min(least, bisector);
        sum += 1 / square(square(square(std::max(bisector + c, 1e-4))));
        ++counted;
    }
    // The rest of the 125 are far.
    if (n.rounding > 0) least = std::pow(sum + (125 - counted) * std::pow(seen + c, -8), -1.0 / 8) - c;
    return n.gap / 2.0 - std::max(least, 0.0) * n.size;
}
inline bool member(const VoronoiCells& n, const dvec3& p) {
    return signed_value(n, p) < 0;
}

/// The height by the B-spline's basis functions.
inline double height_at(const HeightMap& n, const dvec3& p) {
    const HeightGrid& grid = *n.file.content;
    const double u = std::clamp<double>((p.x / n.size_x + 0.5) * grid.width, 0, grid.width);
    const double v = std::clamp<double>((0.5 - p.y / n.size_y) * grid.height, 0, grid.height);
    const auto basis = [](double d) {
        const double a = std::abs(d);
        return a < 0.5 ? 0.75 - a * a : a < 1.5 ? (1.5 - a) * (1.5 - a) / 2 : 0;
    };
    double h = 0;
    for (int y = -2; y < grid.height + 2; ++y)
        for (int x = -2; x < grid.width + 2; ++x)
            h += basis(u - x - 0.5) * basis(v - y - 0.5) *
                 grid.values[static_cast<std::size_t>(std::clamp(y, 0, grid.height - 1) * grid.width +
                                                      std::clamp(x, 0, grid.width - 1))];
    return h * n.height;
}
inline bool member(const HeightMap& n, const dvec3& p) {
    return p.z < height_at(n, p);
}
inline double signed_value(const HeightMap& n, const dvec3& p) {
    const auto [low, high] = std::minmax_element(n.file.content->values.begin(), n.file.content->values.end());
    return std::min(std::max((p.z - height_at(n, p)) * n.table[4], p.z - *high * n.height), p.z - *low * n.height);
}

template <class N>
concept IsEndless = requires(const N& n) {
    n.boxes.fold;
};
template <IsEndless N>
dvec3 in_first_cell(const N& n, const dvec3& p) {
    const dvec3 c(n.boxes.fold.centre), s(n.spacing);
    dvec3 q = p;
    for (int i = 0; i < 3; ++i)
        if (s[i] > 0) q[i] = p[i] - s[i] * std::floor((p[i] - c[i]) / s[i] + 0.5);
    return q;
}
template <IsEndless N>
double between_boxes(const N& n, const dvec3& p, double f) {
    const double b = box(in_first_cell(n, p) - dvec3(n.boxes.fold.centre), dvec3(n.boxes.half));
    return std::max(b, std::min(f, 2.0 * n.clearance - b));
}
template <IsEndless N>
bool member(const N& n, const dvec3& p) {
    return inside(n.of, in_first_cell(n, p));
}
template <IsEndless N>
double signed_value(const N& n, const dvec3& p) {
    return between_boxes(n, p, value(n.of, in_first_cell(n, p)));
}
template <IsEndless N>
Phase region(const N& n, const dvec3& p) {
    return label(n.of, in_first_cell(n, p));
}
template <IsEndless N>
Components components(const N& n, const dvec3& p) {
    Components a = values(n.of, in_first_cell(n, p));
    for (std::size_t i = 0; i < Components::size; ++i)
        if (a[i] < absent) a[i] = i == 0 ? -between_boxes(n, p, -a[i]) : between_boxes(n, p, a[i]);
    return a;
}

}  // namespace phasetree::tests::oracle

namespace phasetree::tests {

inline HeightGrid random_content(Random& rng, std::type_identity<HeightGrid>) {
    HeightGrid grid{2 + rng.below(4), 2 + rng.below(4), {}};
    for (int i = 0; i < grid.width * grid.height; ++i) grid.values.push_back(rng.uniform(0, 1));
    return grid;
}

}  // namespace phasetree::tests
