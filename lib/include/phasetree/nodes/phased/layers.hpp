#pragma once

#include <span>
#include <vector>

#include "phasetree/nodes/phased/combine.hpp"

namespace phasetree {

/// Parallel slabs of thickness 2h at a period P along a unit direction: |m| − h, where m is the distance along the
/// direction to the middle of the nearest slab. Exact.
struct PeriodicSlab {
    glm::vec3 direction{0, 0, 1};
    float middle = 0;
    float half = 0.25f;
    float period = 1;
    float inverse = 1;

    template <class T>
    T distance(const Vec3<T>& p) const {
        const T u = (dot(p, direction) - middle) * inverse;
        return abs(u - floor(u + 0.5f)) * period - half;
    }
};

/// The paper (Galin et al.) has two phases of equal thickness; this node allows any number of phases and thicknesses. A
/// phase that is listed several times is the union of its slabs.
struct Layers {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{"layers", "9.1",
                                   "φₖ = |m| − tₖ/2,  m = u − P⌊u/P + 1/2⌋,  u = p·n − cₖ,  P = Σ t,  "
                                   "cₖ the middle of layer k",
                                   "Parallel layers of several phases, repeated endlessly, filling space."};
    using Parts = TypeList<PeriodicSlab>;
    std::vector<Phase> of_phases{};
    std::vector<float> thicknesses{};
    glm::vec3 direction{0, 0, 1};
    float offset = 0;
    std::vector<PeriodicSlab> slabs{};  ///< one per listed phase, derived

    template <class V>
    static void parameters(V&& v) {
        v(&Layers::of_phases, Parameter{"phases", "", "The phases of one period in order, at least two."});
        v(&Layers::thicknesses, Parameter{"thicknesses", "m", "Thicknesses of the layers; one number applies to all.",
                                          limits::positive, false, true});
        v(&Layers::direction,
          Parameter{"direction", "", "Direction in which the layers follow each other; any length but zero.",
                    limits::any, true});
        v(&Layers::offset,
          Parameter{"offset", "m", "Position along this direction, from the origin, where the first layer begins.",
                    limits::any, true});
    }
    void prepare() {
        if (of_phases.size() < 2) throw ModelError("layers: at least two phases are required");
        if (thicknesses.size() != 1 && thicknesses.size() != of_phases.size())
            throw ModelError("layers: \"thicknesses\" needs one entry per phase, or one for all");
        const glm::dvec3 n(direction);
        if (!(glm::length(n) > 0)) throw ModelError("layers: \"direction\" must not be zero");
        double period = 0;
        for (std::size_t i = 0; i < of_phases.size(); ++i) period += thickness(i);
        slabs.clear();
        double begin = std::fmod(static_cast<double>(offset), period);
        for (std::size_t i = 0; i < of_phases.size(); ++i) {
            PeriodicSlab s;
            s.direction = glm::vec3(glm::normalize(n));
            s.middle = static_cast<float>(begin + 0.5 * thickness(i));
            s.half = static_cast<float>(0.5 * thickness(i));
            s.period = static_cast<float>(period);
            s.inverse = static_cast<float>(1 / period);
            if (!std::isfinite(s.period) || !std::isfinite(s.inverse) || !(s.inverse > 0))
                throw ModelError("layers: the thicknesses are too small or too large");
            slabs.push_back(s);
            begin += thickness(i);
        }
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        Phases<typename D::Scalar> result;
        for (std::size_t i = 0; i < slabs.size(); ++i) {
            const int k = of_phases[i].index;
            if (slabs.size() == 2 && i == 1 && !result.has(k)) {
                result.set(k, -result[of_phases[0].index]);  // with two phases, one is the complement of the other
            } else {
                detail::add_part(result, k, d.primitive(slabs[i], p));
            }
        }
        return result;
    }
    PhaseSet phases() const { return PhaseSet::of(of_phases); }
    /// Memory of derived data, in bytes.
    std::size_t derived_bytes() const { return std::span(slabs).size_bytes(); }
    Bounds bounds(BoundsQuery&, float) const { return Bounds::everything(); }

  private:
    double thickness(std::size_t i) const { return thicknesses[thicknesses.size() == 1 ? 0 : i]; }
};

}  // namespace phasetree
