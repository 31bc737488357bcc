#pragma once

#include "phasetree/nodes/phased/combine.hpp"

namespace phasetree {

/// Equivalent to nested `layered` nodes, but a₀ is evaluated once, and so is the sum a₀ + T of each boundary between
/// layers.
struct LayeredSequence {
    static constexpr bool is_phased_node = true;
    static constexpr NodeInfo info{"layered_sequence", "4.5",
                                   "φₖ = max(−a₀ − Tₖ, a₀ + Tₖ₋₁),  Tₖ = t₁ + … + tₖ,  φ₀ = a₀ + Tₙ",
                                   "Embeds an object in layers, the innermost first."};
    Phased of{};
    std::vector<Phase> layers{};
    std::vector<float> thicknesses{};

    template <class V>
    static void parameters(V&& v) {
        v(&LayeredSequence::of, Parameter{"of", "", "The object."});
        v(&LayeredSequence::layers, Parameter{"phases", "", "The phase of each layer, from the inside out."});
        v(&LayeredSequence::thicknesses,
          Parameter{"thicknesses", "m", "The thickness of each layer, from the inside out.", limits::positive});
    }
    void prepare() const {
        if (layers.size() != thicknesses.size())
            throw ModelError("layered_sequence: " + std::to_string(layers.size()) + " phases, but " +
                             std::to_string(thicknesses.size()) + " thicknesses");
    }
    template <class D>
    Phases<typename D::Scalar> evaluate(D& d, const typename D::Point& p) const {
        auto a = d.phases(of, p);
        if (!a.has(0)) return a;  // no vacuum: the object fills space, so there is nothing to coat
        const auto start = a[0];
        auto inner = start;
        float total = 0;
        for (std::size_t n = 0; n < layers.size(); ++n) {
            total += thicknesses[n];
            const auto outer = start + total;
            const auto layer = max(-outer, inner);
            const int k = layers[n].index;
            a.set(k, a.has(k) ? min(a[k], layer) : layer);
            inner = outer;
        }
        a.set(0, inner);
        return a;
    }
    PhaseSet phases() const {
        const PhaseSet there = phasetree::phases(of);
        return there.contains(vacuum) ? there | PhaseSet::of(layers) : there;
    }
    Bounds bounds(BoundsQuery& q, float level) const {
        float total = 0;
        for (const float t : thicknesses) total += t;
        return q(of, level + total);
    }
};

}  // namespace phasetree
