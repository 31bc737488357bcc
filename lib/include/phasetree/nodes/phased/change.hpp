#pragma once

#include "phasetree/nodes/phased/combine.hpp"

namespace phasetree {

/// A is the object `of`, i the phase `from`, k the phase `to`, and f the field of `shape`. The equation of φₖ contains
/// aᵢ, the component of A before the change. The one in the paper (Galin et al.) contains φᵢ instead, from which the
/// shape has already been removed.
struct Change {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{"change", "5.2", "φᵢ = max(aᵢ, −f),  φₖ = min(aₖ, max(aᵢ, f)),  φ₀ = a₀",
                                   "Turns one phase into another inside a shape, or everywhere if no shape is given."};
    Phased of{};
    Phase from{1};
    Phase to{2};
    Field shape{};

    template <class V>
    static void parameters(V&& v) {
        v(&Change::of, Parameter{"of", "", "The object."});
        v(&Change::from, Parameter{"from", "", "The phase to change."});
        v(&Change::to, Parameter{"to", "", "The phase that it becomes."});
        v(&Change::shape,
          Parameter{"shape", "", "The field inside which to change it; by default everywhere.", limits::any, true});
    }
    void prepare() const {
        if (from == to) throw ModelError("change: a phase cannot be changed into itself");
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        auto a = d.phases(of, p);
        if (!a.has(from.index)) return a;
        auto moved = a[from.index];
        if (shape) {
            const auto f = d.field(shape, p);
            a.set(from.index, max(moved, -f));
            moved = max(moved, f);
        } else {
            a.remove(from.index);
        }
        a.set(to.index, a.has(to.index) ? min(a[to.index], moved) : moved);
        return a;
    }
    PhaseSet phases() const {
        PhaseSet there = phasetree::phases(of);
        if (!there.contains(from)) return there;
        if (!shape) there.bits &= ~PhaseSet::of(from).bits;
        return there | PhaseSet::of(to);
    }
    Bounds bounds(BoundsQuery& q, float level) const { return q(of, level); }
};

}  // namespace phasetree
