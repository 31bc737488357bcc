#pragma once

#include <span>

#include "phasetree/nodes/copies/placed.hpp"

namespace phasetree {

namespace detail {
struct SurfacePoint {
    glm::vec3 position;
    glm::dvec3 normal;  ///< outward
};
/// Find up to `count` points on a bounded field's surface, distributed evenly by area, no two closer than `spacing`.
/// The points are where random lines cross the surface: a uniformly random line is equally likely to cross any two
/// pieces of equal area. The same seed gives the same points. Throws ModelError if the surface is unbounded or no line
/// meets it.
std::vector<SurfacePoint> scattered(const Field& surface, int count, float spacing, int seed);
/// Make placements on scattered() points. Each is rotated at random about its normal, and has a random size between
/// `smallest` and 1.
std::vector<Placement> scattered_placements(const Field& surface, int count, float spacing, float smallest, int seed);
}  // namespace detail

template <class Child>
struct Scatter : Copies<Scatter<Child>, Child> {
    static constexpr NodeInfo info{
        "scatter", "",
        "copies at random points of the surface f = 0, their z axis along ∇f; for objects, later copies replace "
        "earlier ones",
        "Copies scattered over the surface of a field, each with its z axis pointing outward, and with random "
        "rotations."};
    Field surface{};
    int count = 10;
    float spacing = 0;
    float smallest = 1;
    int seed = 1;
    std::vector<Placement> found{};  ///< derived, and stored because the search is slow

    template <class V>
    static void parameters(V&& v) {
        v(&Scatter::of, detail::copied);
        v(&Scatter::surface, Parameter{"on", "", "The field whose surface the copies stand on; it must be bounded."});
        v(&Scatter::count,
          Parameter{"count", "", "Number of copies; fewer if there is not enough space.", {.low = 1, .high = 100'000}});
        v(&Scatter::spacing,
          Parameter{"spacing", "m", "Minimum distance between the copies' origins.", limits::non_negative, true});
        v(&Scatter::smallest, Parameter{"smallest", "", "Minimum size: sizes are random between this factor and 1.",
                                        Limits{.low = 0.01f, .high = 1}, true});
        v(&Scatter::seed, Parameter{"seed", "", "Seed of the random positions.", {.low = 0, .high = 1'000'000}, true});
    }
    void prepare() { found = detail::scattered_placements(surface, count, spacing, smallest, seed); }
    /// Memory of derived data, in bytes.
    std::size_t derived_bytes() const { return std::span(found).size_bytes(); }
    std::size_t many() const { return found.size(); }
    const Placement& placement(std::size_t i) const { return found[i]; }
};

struct FieldScatter : Scatter<Field> {
    static constexpr bool is_field_node = true;
};
struct PhasedScatter : Scatter<Phased> {
    static constexpr bool is_phased_node = true;
};

}  // namespace phasetree
