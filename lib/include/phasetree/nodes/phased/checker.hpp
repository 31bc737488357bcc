#pragma once

#include "phasetree/model/concepts.hpp"

namespace phasetree {

/// The distance to the nearest face of a cubic grid, positive in cells of even parity and negative in the others.
/// Within a cell min(q, 1 − q) is 1-Lipschitz, and the sign changes only where it is zero.
struct CheckerCells {
    glm::vec3 origin{0};
    float size = 1;
    float inverse = 1;

    template <class T>
    T distance(const Vec3<T>& p) const {
        const Vec3<T> u = (p - origin) * inverse;
        const Vec3<T> cell{floor(u.x), floor(u.y), floor(u.z)};
        const T half = (cell.x + cell.y + cell.z) * 0.5f;
        const T odd = (half - floor(half)) * 2.f;  // 0 or 1, also in negative cells, where % would give −1
        const T face = min(to_face(u.x - cell.x), min(to_face(u.y - cell.y), to_face(u.z - cell.z)));
        return face * (1.f - odd * 2.f) * size;
    }

  private:
    /// Uses abs because the sign of zero differs between instruction sets.
    template <class T>
    static T to_face(const T& q) {
        return min(abs(q), 1.f - abs(q));
    }
};

/// The equation of the paper (Galin et al.) is for unit cubes; here distances are scaled by the cubes' size. There is
/// no vacuum.
struct Checker {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{"checker", "9.1",
                                   "φⱼ = s · a · min(q, 1 − q),  φᵢ = −φⱼ,  u = (p − o)/a,  q = u − ⌊u⌋,  "
                                   "s = +1 if ⌊ux⌋ + ⌊uy⌋ + ⌊uz⌋ is even, else −1",
                                   "Cubes of two alternating phases, filling space."};
    using Parts = TypeList<CheckerCells>;
    Phase even{1};
    Phase odd{2};
    float size = 1;
    glm::vec3 origin{0};
    CheckerCells cells{};  ///< derived

    template <class V>
    static void parameters(V&& v) {
        v(&Checker::even, Parameter{"even", "", "The phase of the cube at the origin, towards +x, +y, +z."});
        v(&Checker::odd, Parameter{"odd", "", "The phase of the neighbouring cubes."});
        v(&Checker::size, Parameter{"size", "m", "Edge length of a cube.", limits::positive});
        v(&Checker::origin, Parameter{"origin", "m", "A point where corners of cubes meet.", limits::any, true});
    }
    void prepare() {
        if (even == odd) throw ModelError("checker: both phases are the same");
        cells.size = size;
        cells.inverse = 1 / size;
        if (!std::isfinite(cells.inverse)) throw ModelError("checker: the cubes are too small");
        // The pattern has period 2a along each axis.
        for (int i = 0; i < 3; ++i)
            cells.origin[i] =
                static_cast<float>(std::fmod(static_cast<double>(origin[i]), 2 * static_cast<double>(size)));
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        const auto f = d.primitive(cells, p);
        Phases<typename D::Scalar> result;
        result.set(even.index, -f);
        result.set(odd.index, f);
        return result;
    }
    PhaseSet phases() const { return PhaseSet::of(even) | PhaseSet::of(odd); }
    Bounds bounds(BoundsQuery&, float) const { return Bounds::everything(); }
};

}  // namespace phasetree
