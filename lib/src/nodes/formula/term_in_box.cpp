#include "nodes/formula/term_in_box.hpp"

#include <algorithm>
#include <cmath>

namespace phasetree::nodes {

using enclosure::Enclosure, enclosure::Interval;
using formula::Op;
using Index = FormulaIndex;

void TermInBox::run(const TermSteps& term, const BoxOfDoubles& box) {
    values_.assign(term.steps.size(), Enclosure());
    slopes_.assign(term.steps.size(), 0);
    formula::run(term.data.data(), box.point(), values_.data());
    for (std::size_t i = 0; i < term.steps.size(); ++i)
        slopes_[i] = std::min(slope_of(term.steps[i]), std::sqrt(values_[i].squared_slope()));
}

double TermInBox::slope_of(const FormulaStep& s) const {
    const auto at = [&](Index i) { return values_[i].value.magnitude(); };
    switch (s.op) {
        case Op::x:
        case Op::y:
        case Op::z:
            return 1;
        case Op::constant:
            return 0;
        case Op::negate:
        case Op::absolute:
            return slopes_[s.a];
        case Op::sine:
        case Op::cosine:
            return at(s.a) <= 1e4 ? slopes_[s.a] : Interval::most;  // sine_of() is not valid beyond
        case Op::add:
        case Op::subtract:
            return slopes_[s.a] + slopes_[s.b];
        case Op::multiply:
            return at(s.a) * slopes_[s.b] + at(s.b) * slopes_[s.a];
        case Op::square:
            return 2 * at(s.a) * slopes_[s.a];
        case Op::minimum:
        case Op::maximum:
        case Op::smooth_minimum:
            return std::max(slopes_[s.a], slopes_[s.b]);
        case Op::exponential:
            return std::exp(std::min(values_[s.a].value.high, 80.0)) * slopes_[s.a];  // exponential() is constant
                                                                                      // beyond
        case Op::length_of_two:
            return slope_of_length({s.a, s.b, s.b}, 2);
        case Op::length_of_three:
            return slope_of_length({s.a, s.b, s.c}, 3);
        case Op::divide:
        case Op::square_root:
            return Interval::most;
    }
    return Interval::most;
}

// An upper bound on the slope of the length of a vector of n values. The length is at most as steep as the largest
// stretch of the matrix J of the values' gradients. The square of that stretch is the largest eigenvalue of J Jᵀ. By
// Gershgorin's theorem, this is at most the largest sum of magnitudes in a row.
double TermInBox::slope_of_length(const std::array<Index, 3>& of, std::size_t n) const {
    double most = 0;
    for (std::size_t i = 0; i < n; ++i) {
        double row = slopes_[of[i]] * slopes_[of[i]];
        for (std::size_t j = 0; j < n; ++j) {
            if (i == j) continue;
            Interval product{};
            for (std::size_t axis = 0; axis < 3; ++axis)
                product = product + values_[of[i]].gradient[axis] * values_[of[j]].gradient[axis];
            row += std::min(product.magnitude(), slopes_[of[i]] * slopes_[of[j]]);
        }
        most = std::max(most, row);
    }
    return std::sqrt(most);
}

}  // namespace phasetree::nodes
