#pragma once

#include <vector>

#include "phasetree/nodes/fields/voronoi_sites.hpp"
#include "phasetree/nodes/phased/combine.hpp"

namespace phasetree {

/// The cells of a Voronoi pattern in several phases, which fill space. Dₖ is the distance to the nearest site of phase
/// k. It is 1-Lipschitz, and continuous because it is clamped where unvisited sites could matter. φₖ is half the
/// difference between Dₖ and the distance to the nearest site of any other phase. It is 1-Lipschitz, and φᵢ + φⱼ = (Dᵢ
/// − min Dₘ + Dⱼ − min Dₘ)/2 ≥ 0 because each minimum is at most the other's D. There is no vacuum.
struct Voronoi {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{
        "voronoi", "4.3, 9.1", "φₖ = (Dₖ − min over m ≠ k of Dₘ)/2,  Dₖ = distance to the nearest site of phase k",
        "Blocks of several phases, filling space: the cells of an irregular lattice of sites, each with one of the "
        "phases. With the same size, jitter and seed, the cells are those of voronoi_cells."};
    /// The distance to the nearest site of one entry of `phases`: entry `kind` of `kinds`. (Two entries may be the same
    /// phase.)
    struct Nearest {
        static constexpr bool is_long = true;               ///< a LongPrimitive
        static constexpr unsigned half_instructions = 800;  ///< for all sites
        float size = 1;
        float jitter = 1;
        float seed = 0;
        float kinds = 2;
        float kind = 0;

        template <class T>
        T distance(const Vec3<T>& p) const {
            return distance(p, VoronoiSites{jitter, seed});
        }
        template <class T, class Sites>
        T distance(const Vec3<T>& p, const Sites& sites) const {
            // The bound is slightly smaller, so that no unvisited site counts because of rounding.
            const float unseen = VoronoiSites{jitter, seed}.unseen() * (1 - 1e-6f);
            T least(unseen * unseen);
            const T low(first_hash()), high(end_hash());
            sites.for_each(p * (1 / size), [&](const Vec3<T>& offset, const T& hash) {
                const T squared = select(less(hash, low), least, select(less(hash, high), dot(offset, offset), least));
                least = min(squared, least);
            });
            return sqrt(least) * size;
        }
        float first_hash() const { return 289 * kind / kinds - 0.5f; }
        float end_hash() const { return 289 * (kind + 1) / kinds - 0.5f; }

        /// The same primitive, with only the sites of its kind that may be the nearest in one small box as its data.
        struct Specialised : SpecialisedVoronoi {
            static constexpr EnclosedBy enclosed_by = EnclosedBy::value_at_centre;
            static unsigned half_instructions(const float* data) { return 6 + 2 * sites(data); }
            template <class T>
            static T distance(const float* data, const Vec3<T>& p) {
                const Nearest node{data[0], data[1], data[2], data[3], data[4]};
                return node.distance(p, VoronoiSiteList{{node.jitter, node.seed}, list(data)});
            }
        };
        float period() const { return size; }
        bool specialise(const PointRange&, std::span<const float> of, std::vector<float>& floats) const;
    };
    using Parts = TypeList<Nearest, Nearest::Specialised>;

    std::vector<Phase> of_phases{};
    float size = 1;
    float jitter = 0.9f;
    float seed = 0;

    template <class V>
    static void parameters(V&& v) {
        v(&Voronoi::of_phases,
          Parameter{"phases", "",
                    "The phases, at least two. All are equally likely; list one twice to make it more likely."});
        v(&Voronoi::size, detail::voronoi_size);
        v(&Voronoi::jitter, detail::voronoi_jitter);
        v(&Voronoi::seed, detail::voronoi_seed);
    }
    void prepare() {
        detail::require_usable(info.name, {size});
        seed = std::floor(seed);
        if (phases().size() < 2) throw ModelError("voronoi: at least two different phases are required");
        if (of_phases.size() > 16) throw ModelError("voronoi: at most 16 phases are allowed");
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        const auto kinds = static_cast<float>(of_phases.size());
        Phases<typename D::Scalar> sites;
        for (std::size_t k = 0; k < of_phases.size(); ++k) {
            const int phase = of_phases[k].index;
            const auto distance = d.primitive(Nearest{size, jitter, seed, kinds, static_cast<float>(k)}, p);
            detail::add_part(sites, phase, distance);
        }
        Phases<typename D::Scalar> result;
        detail::minimum_of_others(sites, sites.present, sites.present,
                                  [&](int i, const auto& others) { result.set(i, (sites[i] - *others) * 0.5f); });
        return result;
    }
    PhaseSet phases() const { return PhaseSet::of(of_phases); }
    Bounds bounds(BoundsQuery&, float) const { return Bounds::everything(); }
};

}  // namespace phasetree
