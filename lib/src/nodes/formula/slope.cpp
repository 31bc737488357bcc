#include "nodes/formula/slope.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "nodes/formula/term_in_box.hpp"

namespace phasetree::nodes {

using enclosure::Interval;
using formula::Op;

namespace {

constexpr double close_enough = 1.02;  // stop when the bound is at most this many times the steepest gradient found
constexpr double no_bound = 1e50;      // larger bounds count as none: Interval::most is larger

// Reports why a term has no bound in a box: the first step without a bound whose operands have bounds.
[[noreturn]] void refuse(const TermSteps& term, const TermInBox& in, const BoxOfDoubles& box, bool has_bounds) {
    for (std::size_t i = 0; i < term.steps.size(); ++i) {
        if (in.slope(i) < no_bound) continue;
        const FormulaStep& s = term.steps[i];
        const std::string near = " near " + box.middle_text();
        switch (s.op) {
            case Op::square_root:
                fail_in_formula(s.offset, "the argument of this root is zero or negative" + near +
                                              ", where the slope is unbounded");
            case Op::divide:
                fail_in_formula(s.offset, "this divides by zero" + near + ", where the slope is unbounded");
            default:
                break;
        }
        if (!has_bounds) break;
        if (s.op == Op::sine || s.op == Op::cosine)
            fail_in_formula(s.offset, "the argument of this sine or cosine exceeds 10000" + near);
        fail_in_formula(s.offset, "the slope of this term is unbounded" + near);
    }
    fail_in_formula(
        term.steps.back().offset,
        "the slope of the formula is unbounded far from the origin; limit it with \"bounds\": [[x, y, z], [x, y, z]]");
}

}  // namespace

double slope_in(const TermSteps& term, const BoxOfDoubles& whole, int max_boxes, bool has_bounds,
                model::Preparation& budget) {
    struct Candidate {
        double bound;
        BoxOfDoubles box;
        bool operator<(const Candidate& other) const { return bound < other.bound; }  // the steepest on top
    };
    TermInBox in;
    const std::array<bool, 3> axes = term.axes();
    double seen = 0;
    std::priority_queue<Candidate> open;
    const auto look = [&](const BoxOfDoubles& box, double bound_around) {
        budget.pay(work_of_a_step * term.steps.size());
        in.run(term, box);
        double squared = 0;
        for (const double g : in.result().centre_gradient) squared += g * g;
        if (std::isfinite(squared)) seen = std::max(seen, std::sqrt(squared));
        open.push({std::min(bound_around, in.bound()), box});
    };
    look(whole, Interval::most);
    // Half of the longest side of a box, among the axes on which the term depends.
    const auto size = [&](const BoxOfDoubles& box) {
        double longest = 0;
        for (std::size_t i = 0; i < 3; ++i)
            if (axes[i]) longest = std::max(longest, box.half(i));
        return longest;
    };
    const double smallest = 1e-5 * size(whole);
    for (int boxes = 1;; boxes += 2) {
        const Candidate top = open.top();
        const auto& b = top.box;
        const bool is_bounded = top.bound < no_bound;
        if (is_bounded && (top.bound <= close_enough * seen || boxes >= max_boxes)) return top.bound * (1 + 1e-5);
        if (!is_bounded && (boxes >= max_boxes || size(b) < smallest)) {
            in.run(term, b);
            refuse(term, in, b, has_bounds);
        }
        open.pop();
        const auto [one, other] = b.split(axes);
        look(one, top.bound);
        look(other, top.bound);
    }
}

}  // namespace phasetree::nodes
