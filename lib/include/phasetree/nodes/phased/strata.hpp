#pragma once

#include <span>
#include <vector>

#include "phasetree/nodes/fields/plane.hpp"
#include "phasetree/nodes/phased/combine.hpp"

namespace phasetree {

/// A phase that is listed several times is the union of its layers.
struct Strata {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{
        "strata", "9.1", "φₖ = max(hₖ₋₁ − u, u − hₖ),  u = p·n − o,  hₖ = t₁ + … + tₖ",
        "Parallel layers of several phases, filling space: the first and the last are unbounded."};
    std::vector<Phase> of_phases{};
    std::vector<float> thicknesses{};
    glm::vec3 direction{0, 0, 1};
    float offset = 0;
    std::vector<float> heights{};  ///< hₖ from the top of the first layer on, derived
    Plane base{};                  ///< u, derived

    template <class V>
    static void parameters(V&& v) {
        v(&Strata::of_phases, Parameter{"phases", "", "The phases in order, at least two."});
        v(&Strata::thicknesses,
          Parameter{"thicknesses", "m", "Thicknesses of all layers but the last; one number applies to all.",
                    limits::positive, false, true});
        v(&Strata::direction,
          Parameter{"direction", "", "Direction in which the layers follow each other; any length but zero.",
                    limits::any, true});
        v(&Strata::offset,
          Parameter{"offset", "m",
                    "Position along this direction, from the origin, from which the first layer is measured.",
                    limits::any, true});
    }
    void prepare() {
        if (of_phases.size() < 2) throw ModelError("strata: at least two phases are required");
        if (thicknesses.size() != 1 && thicknesses.size() + 1 != of_phases.size())
            throw ModelError("strata: \"thicknesses\" needs one entry per phase but the last, or one for all");
        if (direction == glm::vec3(0)) throw ModelError("strata: \"direction\" must not be zero");
        base = Plane{.normal = direction, .offset = offset};
        base.prepare();
        heights.clear();
        double height = 0;
        for (std::size_t i = 0; i + 1 < of_phases.size(); ++i) {
            height += thicknesses[thicknesses.size() == 1 ? 0 : i];
            heights.push_back(static_cast<float>(height));
        }
        if (!std::isfinite(heights.back())) throw ModelError("strata: the thicknesses are too large");
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        const auto u = d.primitive(base, p);
        Phases<typename D::Scalar> result;
        for (std::size_t i = 0; i < of_phases.size(); ++i) {
            const auto f = i == 0                ? u - heights.front()
                           : i == heights.size() ? heights.back() - u
                                                 : max(heights[i - 1] - u, u - heights[i]);
            detail::add_part(result, of_phases[i].index, f);
        }
        return result;
    }
    PhaseSet phases() const { return PhaseSet::of(of_phases); }
    /// Memory of derived data, in bytes.
    std::size_t derived_bytes() const { return std::span(heights).size_bytes(); }
    Bounds bounds(BoundsQuery&, float) const { return Bounds::everything(); }
};

}  // namespace phasetree
