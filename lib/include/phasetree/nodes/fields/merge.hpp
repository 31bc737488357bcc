#pragma once

#include <vector>

#include "phasetree/model/concepts.hpp"

namespace phasetree {

struct Merge {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"merge", "4.2", "min over k of φₖ",
                                   "Phases of an object as a plain field; it is zero on the interfaces between them."};
    Phased of{};
    PhaseSet phases{};  ///< if empty, all phases but the vacuum

    template <class V>
    static void parameters(V&& v) {
        v(&Merge::of, Parameter{"of", "", "The object."});
        v(&Merge::phases,
          Parameter{"phases", "", "The phases to merge; by default all but the vacuum.", limits::any, true});
    }
    void prepare() const {
        const PhaseSet there = phasetree::phases(of);
        if ((phases.empty() ? there.bits & ~std::uint64_t{1} : there.bits & phases.bits) == 0)
            throw ModelError("merge: the object has none of the phases to merge");
    }
    template <class D>
    typename D::Scalar evaluate(D& d, const typename D::Point& p) const {
        const Phases<typename D::Scalar> a = d.phases(of, p);
        const std::uint64_t chosen = phases.empty() ? a.materials() : a.present & phases.bits;
        const int first = std::countr_zero(chosen);
        typename D::Scalar result = a[first];
        for_each_phase(chosen & (chosen - 1), [&](int i) { result = min(result, a[i]); });
        return result;
    }
    Bounds bounds(BoundsQuery& q, float level) const {
        return phases.contains(vacuum) ? Bounds::everything() : q(of, level);
    }
};

}  // namespace phasetree
