// Determines a formula's terms, the bound on their slope by which all are divided, and the box that contains its solid.
#include "phasetree/nodes/fields/formula.hpp"

#include <algorithm>
#include <cmath>

#include "nodes/formula/slope.hpp"
#include "nodes/formula/solid.hpp"
#include "nodes/formula/text.hpp"

namespace phasetree {

namespace {

using nodes::BoxOfDoubles, nodes::fail_in_formula, nodes::FormulaStep, nodes::FormulaTerms, nodes::slope_in,
    nodes::TermSteps;

constexpr int max_boxes = 4000;   // examined to find the slope of a term
constexpr double steepest = 1e6;  // steeper formulas are rejected
// Without bounds, the slope is determined in a large cube and in a small one, with these half sides and fewer boxes:
// nothing needs refinement there. If it is larger in the large cube, it is assumed to grow without limit, and the
// formula is rejected. Nothing is proven beyond the large cube, 1000 km from the origin, so the author's bounds may not
// extend farther either.
constexpr double everywhere = 1e6, nearby = 1e3;

BoxOfDoubles box_of(const std::vector<glm::vec3>& corners) {
    if (corners.size() != 2) throw ModelError("formula: \"bounds\" must be two corners, [[x, y, z], [x, y, z]]");
    BoxOfDoubles box{};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto axis = static_cast<glm::length_t>(i);
        box.low[i] = static_cast<double>(corners[0][axis]);
        box.high[i] = static_cast<double>(corners[1][axis]);
        if (!(box.high[i] - box.low[i] > 1e-6 * (1 + std::abs(box.low[i]))) || std::abs(box.low[i]) > everywhere ||
            std::abs(box.high[i]) > everywhere)
            throw ModelError(
                "formula: the first corner of \"bounds\" must be below the second along each axis, and "
                "both within 1e6 m of the origin");
    }
    return box;
}

BoxOfDoubles cube(double half) {
    return {{-half, -half, -half}, {half, half, half}};
}

}  // namespace

void Formula::prepare() {
    const std::vector<FormulaStep> steps = nodes::read_formula(text);
    FormulaTerms division = nodes::divided_into_terms(steps);
    model::Preparation budget(info.name);

    double slope = 0;
    if (box.empty()) {
        for (const TermSteps& term : division.terms) {
            const double far = slope_in(term, cube(everywhere), max_boxes / 20, false, budget);
            const double near = slope_in(term, cube(nearby), max_boxes / 20, false, budget);
            if (far > 1.1 * near)
                fail_in_formula(term.steps.back().offset,
                                "the slope of the formula is unbounded far from the origin; limit it with \"bounds\": "
                                "[[x, y, z], [x, y, z]]");
            slope = std::max(slope, far);
        }
    } else {
        const BoxOfDoubles around = around_solid(division, box_of(box), steps.size(), budget);
        for (const TermSteps& term : division.terms)
            slope = std::max(slope, slope_in(term, around, max_boxes, true, budget));
        for (int i = 0; i < 3; ++i) {
            const auto axis = static_cast<std::size_t>(i);
            bound.centre[i] = static_cast<float>(around.middle()[axis]);
            bound.half[i] = static_cast<float>(around.half(axis));
        }
    }
    if (slope > steepest) fail_in_formula(0, "the formula is too steep: its slope may be " + std::to_string(slope));
    if (slope < 1e-6) slope = 1;  // the formula is nearly constant

    lipschitz = static_cast<float>(slope);
    const float scale = 1 / lipschitz;
    terms.clear();
    for (TermSteps& term : division.terms) {
        term.data[1] = scale;
        terms.push_back({std::move(term.data)});
    }
    parts = std::move(division.parts);
    for (Part& part : parts) part.constant *= scale;
}

}  // namespace phasetree
