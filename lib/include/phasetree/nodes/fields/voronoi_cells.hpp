#pragma once

#include "phasetree/nodes/fields/voronoi_sites.hpp"

namespace phasetree {

/// The cells of a Voronoi pattern, each shrunk by half the gap and with rounded edges: the blocks of a rock wall, the
/// stones of a pavement. If site s is the nearest, the distance to the bisector of s and t is bₜ = (|p − t|² − |p −
/// s|²)/(2|t − s|). v is the minimum over t, or the rounded minimum
///     v = (Σ (bₜ + c)⁻⁸)^(−1/8) − c.
/// The rounded minimum is at most the minimum, does not depend on the order of the sites, and is 1-Lipschitz: its
/// derivatives with respect to bₜ are (v + c)⁹/(bₜ + c)⁹, which are positive and sum to at most 1. On a cell's faces v
/// ≤ 0, so g/2 − max(v, 0) is continuous from cell to cell.
///
/// If the nearest site is at distance d, and a site that is not visited (voronoi_sites.hpp) at distance d′, their
/// bisector is at least (d′ − d)/2 away. All bₜ are clamped to the least such bound, so nothing jumps when the point
/// moves on and other sites are visited.
///
/// In a small box few sites matter: those that may be the nearest, and those whose bisector is not clamped.
struct VoronoiCells {
    static constexpr bool is_long = true;               ///< a LongPrimitive
    static constexpr unsigned half_instructions = 800;  ///< for all sites
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"voronoi_cells", "4.3, 9.1",
                                   "g/2 − max(v, 0),  v = (Σ over t ≠ s of (bₜ + c)⁻⁸)^(−1/8) − c,  "
                                   "bₜ = (|p − t|² − |p − s|²)/(2|t − s|),  s the nearest site",
                                   "Blocks with gaps between them, filling space: the cells of an irregular lattice of "
                                   "sites."};
    float size = 1;
    float gap = 0.05f;
    float rounding = 0;
    float jitter = 0.9f;
    float seed = 0;

    template <class V>
    static void parameters(V&& v) {
        v(&VoronoiCells::size, detail::voronoi_size);
        v(&VoronoiCells::gap, Parameter{"gap", "m", "Width of the gap between blocks.", limits::positive});
        v(&VoronoiCells::rounding,
          Parameter{"rounding", "m", "Rounding c of the edges; 0 for sharp ones.", limits::non_negative, true});
        v(&VoronoiCells::jitter, detail::voronoi_jitter);
        v(&VoronoiCells::seed, detail::voronoi_seed);
    }
    void prepare() {
        detail::require_usable(info.name, {size});
        seed = std::floor(seed);
        if (!(gap < 1.8f * seen() * size))
            throw ModelError("voronoi_cells: the gap must be less than " + std::to_string(1.8f * seen() * size) +
                             " at this size and jitter");
        if (!(gap > 1e-5f * size)) throw ModelError("voronoi_cells: the gap is too small");
        if (!(rounding <= size)) throw ModelError("voronoi_cells: the rounding must not be more than the size");
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        return distance(p, VoronoiSites{jitter, seed});
    }
    template <class T, class Sites>
    T distance(const Vec3<T>& p, const Sites& sites) const {
        const float scale = 1 / size;
        std::array<Vec3<T>, VoronoiSites::neighbours> to;
        std::size_t count = 0;
        Vec3<T> nearest{T(0.f), T(0.f), T(0.f)};
        T least(1e9f);
        sites.for_each(p * scale, [&](const Vec3<T>& offset, const T&) {
            const T squared = dot(offset, offset);
            const auto nearer = less(squared, least);
            nearest = {select(nearer, offset.x, nearest.x), select(nearer, offset.y, nearest.y),
                       select(nearer, offset.z, nearest.z)};
            least = min(squared, least);
            to[count++] = offset;
        });
        const float c = rounding * scale;
        const T far(seen());
        const auto eighth = [&](const T& distance) {
            const T x = max(distance + c, T(1e-4f)), x2 = x * x, x4 = x2 * x2;
            return T(1.f) / (x4 * x4);
        };
        // Every site whose bisector is clamped counts the same, so it does not matter which of them are visited.
        T v = far, sum(0.f), others(static_cast<float>(VoronoiSites::neighbours));
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3<T> between = to[i] - nearest;
            const T apart = dot(between, between);
            const T bisector = dot(between, to[i] + nearest) * 0.5f / sqrt(max(apart, T(1e-12f)));
            // The nearest site has no bisector with itself.
            const T counted = select(less(apart, T(1e-10f)), far, min(bisector, far));
            if (rounding > 0) {
                const auto is_near = less(counted, far);
                sum = sum + select(is_near, eighth(counted), T(0.f));
                others = others - select(is_near, T(1.f), T(0.f));
            } else {
                v = min(v, counted);
            }
        }
        if (rounding > 0) v = T(1.f) / sqrt(sqrt(sqrt(sum + others * eighth(far)))) - c;
        return gap * 0.5f - max(v, T(0.f)) * size;
    }
    /// The same primitive, with only the sites that matter in one small box as its data.
    struct Specialised : SpecialisedVoronoi {
        static constexpr EnclosedBy enclosed_by = EnclosedBy::value_at_centre;
        static unsigned half_instructions(const float* data) { return 10 + 5 * sites(data); }
        template <class T>
        static T distance(const float* data, const Vec3<T>& p);
    };
    using Parts = TypeList<Specialised>;
    float period() const { return size; }
    /// See LocalPrimitive. The sites are those that may be the nearest, or whose bisector is not clamped.
    bool specialise(const PointRange&, std::span<const float> of, std::vector<float>& floats) const;

    Bounds bounds(BoundsQuery&, float) const { return Bounds::everything(); }

    /// A lower bound on the distance, in cubes, to the bisector of any site that is not visited.
    float seen() const {
        const VoronoiSites sites{jitter, seed};
        return 0.5f * (sites.unseen() - sites.nearest()) * 0.999f;
    }
};

template <class T>
T VoronoiCells::Specialised::distance(const float* data, const Vec3<T>& p) {
    VoronoiCells node;
    node.size = data[0], node.gap = data[1], node.rounding = data[2], node.jitter = data[3], node.seed = data[4];
    return node.distance(p, VoronoiSiteList{{node.jitter, node.seed}, list(data)});
}

}  // namespace phasetree
