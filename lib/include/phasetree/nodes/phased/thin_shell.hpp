#pragma once

#include "phasetree/model/concepts.hpp"

namespace phasetree {

struct ThinShell {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{"thin_shell", "4.1", "φᵢ = |f| − t,  φⱼ = f + t,  φ₀ = t − f",
                                   "A wall of thickness 2t about the surface of a field, and its interior."};
    Field of{};
    Phase shell{1};
    Phase inside{2};
    float half_thickness = 0.05f;

    template <class V>
    static void parameters(V&& v) {
        v(&ThinShell::of, Parameter{"of", "", "The field, whose surface is the middle of the wall."});
        v(&ThinShell::shell, Parameter{"shell", "", "The phase of the wall."});
        v(&ThinShell::inside, Parameter{"inside", "", "The phase within."});
        v(&ThinShell::half_thickness,
          Parameter{"half_thickness", "m", "Half of the wall's thickness, t.", limits::positive});
    }
    void prepare() const {
        if (shell == inside) throw ModelError("thin_shell: the wall and the interior must be different phases");
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        const auto f = d.field(of, p);
        Phases<typename D::Scalar> result;
        result.set(0, half_thickness - f);
        result.set(shell.index, abs(f) - half_thickness);
        result.set(inside.index, f + half_thickness);
        return result;
    }
    PhaseSet phases() const { return PhaseSet::of(vacuum) | PhaseSet::of(shell) | PhaseSet::of(inside); }
    Bounds bounds(BoundsQuery& q, float level) const { return q(of, level + half_thickness); }
};

}  // namespace phasetree
