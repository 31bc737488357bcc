#include "nodes/formula/solid.hpp"

#include <algorithm>

#include "nodes/formula/slope.hpp"
#include "nodes/formula/term_in_box.hpp"

namespace phasetree::nodes {

using enclosure::Enclosure, enclosure::Interval;
using Index = FormulaIndex;

namespace {

// The range of the whole formula in a box.
Interval values_in(const FormulaTerms& formula, const BoxOfDoubles& box) {
    using What = Formula::Part::What;
    std::vector<Enclosure> terms;
    TermInBox in;
    for (const TermSteps& term : formula.terms) {
        in.run(term, box);
        terms.push_back(in.result().tightened(box.halves()));
    }
    std::vector<Interval> value;
    for (const Formula::Part& part : formula.parts) {
        const auto of = [&](Index i) -> const Interval& { return value[i]; };
        const double k = static_cast<double>(part.constant);
        switch (part.what) {
            case What::term:
                value.push_back(terms[part.a].value);
                break;
            case What::negate:
                value.push_back(-of(part.a));
                break;
            case What::absolute: {
                const Interval& a = of(part.a);
                const double least = a.low > 0 ? a.low : a.high < 0 ? -a.high : 0;
                value.push_back({least, a.magnitude()});
                break;
            }
            case What::minimum:
                value.push_back({std::min(of(part.a).low, of(part.b).low), std::min(of(part.a).high, of(part.b).high)});
                break;
            case What::maximum:
                value.push_back({std::max(of(part.a).low, of(part.b).low), std::max(of(part.a).high, of(part.b).high)});
                break;
            case What::add_constant:
                value.push_back(of(part.a) + Interval{k, k});
                break;
            case What::smooth_minimum:
                value.push_back(
                    {std::min(of(part.a).low, of(part.b).low) - k / 6, std::min(of(part.a).high, of(part.b).high)});
                break;
        }
    }
    return value.back();
}

}  // namespace

BoxOfDoubles around_solid(const FormulaTerms& formula, const BoxOfDoubles& whole, std::uint64_t steps,
                          model::Preparation& budget) {
    constexpr int divisions = 9;
    struct Open {
        BoxOfDoubles box;
        int depth;
    };
    std::vector<Open> open{{whole, 0}};
    BoxOfDoubles around{whole.high, whole.low};
    while (!open.empty()) {
        const Open top = open.back();
        open.pop_back();
        budget.pay(work_of_a_step * steps);
        const Interval values = values_in(formula, top.box);
        // The formula in floats may be negative where the exact one is not.
        if (values.low > 1e-5 * std::min(1 + values.magnitude(), 1e4)) continue;
        if (top.depth < divisions) {
            const auto [one, other] = top.box.split();
            open.push_back({one, top.depth + 1});
            open.push_back({other, top.depth + 1});
            continue;
        }
        for (std::size_t i = 0; i < 3; ++i) {
            around.low[i] = std::min(around.low[i], top.box.low[i]);
            around.high[i] = std::max(around.high[i], top.box.high[i]);
        }
    }
    return around.low[0] <= around.high[0] ? around : whole;
}

}  // namespace phasetree::nodes
