// How a formula becomes terms joined by minima and maxima, and how steep these are. A bound of the slope is found by
// enclosure: over a box the gradient of a term lies between bounds (src/enclosure). Where they are far above what the
// gradient at the box's middle is, the box is divided, the steepest part first, until little is to be gained. A part so
// small that it says nothing any more, and still without bound, is a place where there is none: the formula is refused.

#include "phasetree/nodes/fields/formula.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "enclosure/enclosure.hpp"
#include "model/preparation.hpp"
#include "model/text_error.hpp"
#include "nodes/formula_text.hpp"

namespace phasetree {

namespace {

using enclosure::Enclosure, enclosure::Range;
using formula::header, formula::most_operations, formula::Op, formula::stride;
using nodes::FormulaStep, nodes::operands;
using Index = std::uint32_t;

// A step of interval arithmetic in the budget's steps.
constexpr std::uint64_t work_of_a_step = 20;
constexpr int most_boxes = 4000;                  // for the slope of one term
constexpr double close_enough = 1.02;             // of the bound to the steepest gradient that is seen
constexpr double no_bound = 1e50;                 // what is larger came from a division by zero
constexpr double steepest = 1e6;                  // of a formula that can be used
constexpr double everywhere = 1e6, nearby = 1e3;  // half the sides of the cubes for a formula without bounds

[[noreturn]] void fail(std::size_t offset, const std::string& message) {
    throw TextError(std::string(Formula::info.name), "text", offset, message);
}

struct BoxOfDoubles {
    std::array<double, 3> low, high;

    std::array<double, 3> middle() const {
        return {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2};
    }
    double half(std::size_t i) const { return (high[i] - low[i]) / 2; }
    std::array<double, 3> halves() const { return {half(0), half(1), half(2)}; }
    Vec3<Enclosure> point() const {
        const auto m = middle();
        return {Enclosure::coordinate(0, m[0], half(0)), Enclosure::coordinate(1, m[1], half(1)),
                Enclosure::coordinate(2, m[2], half(2))};
    }
    // Both halves across the longest of those sides that count.
    std::pair<BoxOfDoubles, BoxOfDoubles> parts(const std::array<bool, 3>& counts = {true, true, true}) const {
        std::size_t longest = 3;
        for (std::size_t i = 0; i < 3; ++i)
            if (counts[i] && (longest == 3 || half(i) > half(longest))) longest = i;
        longest %= 3;
        std::pair<BoxOfDoubles, BoxOfDoubles> both{*this, *this};
        both.first.high[longest] = both.second.low[longest] = middle()[longest];
        return both;
    }
    std::string place() const {
        const auto m = middle();
        const auto text = [](double v) {
            std::array<char, 32> buffer;
            std::snprintf(buffer.data(), buffer.size(), "%.3g", v + 0.0);
            return std::string(buffer.data());
        };
        return "(" + text(m[0]) + ", " + text(m[1]) + ", " + text(m[2]) + ")";
    }
};

// A term as it is evaluated, and where its steps stand in the text.
struct TermSteps {
    std::vector<float> data;
    std::vector<FormulaStep> steps;

    // Which coordinates it depends on.
    std::array<bool, 3> axes() const {
        std::array<bool, 3> all{};
        for (const FormulaStep& s : steps)
            if (s.op <= Op::z) all[static_cast<std::size_t>(s.op)] = true;
        return all;
    }
};

// What a step and those that it needs are, as a term of its own.
TermSteps term_of(const std::vector<FormulaStep>& all, Index root) {
    std::vector<char> is_needed(root + 1, 0);
    is_needed[root] = 1;
    TermSteps term;
    std::vector<Index> place(root + 1, 0);
    for (Index i = root + 1; i-- > 0;) {
        if (!is_needed[i]) continue;
        const std::array<Index, 3> of{all[i].a, all[i].b, all[i].c};
        for (int k = 0; k < operands(all[i].op); ++k) is_needed[of[static_cast<std::size_t>(k)]] = 1;
    }
    for (Index i = 0; i <= root; ++i) {
        if (!is_needed[i]) continue;
        place[i] = static_cast<Index>(term.steps.size());
        FormulaStep s = all[i];
        const int n = operands(s.op);
        s.a = n > 0 ? place[s.a] : 0;
        s.b = n > 1 ? place[s.b] : 0;
        s.c = n > 2 ? place[s.c] : 0;
        term.steps.push_back(s);
    }
    if (term.steps.size() > most_operations)
        fail(all[root].offset, "here are more than 128 operations between minima and maxima");
    term.data = {static_cast<float>(term.steps.size()), 1};
    for (const FormulaStep& s : term.steps) {
        const auto value = static_cast<float>(s.value);
        term.data.insert(term.data.end(),
                         {static_cast<float>(s.op), s.op == Op::constant ? value : static_cast<float>(s.a),
                          static_cast<float>(s.b), s.op == Op::smooth_minimum ? value : static_cast<float>(s.c)});
    }
    return term;
}

// Divides a formula into terms and what joins them.
class Division {
  public:
    explicit Division(const std::vector<FormulaStep>& steps) : steps_(steps), part_of_(steps.size(), none) {}

    std::vector<TermSteps> terms;
    std::vector<Formula::Part> parts;

    Index divide(Index i) {
        using What = Formula::Part::What;
        if (part_of_[i] != none) return part_of_[i];
        const FormulaStep& s = steps_[i];
        Formula::Part part;
        switch (s.op) {
            case Op::minimum:
                part = {What::minimum, divide(s.a), divide(s.b), 0};
                break;
            case Op::maximum:
                part = {What::maximum, divide(s.a), divide(s.b), 0};
                break;
            case Op::smooth_minimum:
                part = {What::smooth_minimum, divide(s.a), divide(s.b), static_cast<float>(s.value)};
                break;
            case Op::negate:
                part = {What::negate, divide(s.a), 0, 0};
                break;
            case Op::absolute:
                part = {What::absolute, divide(s.a), 0, 0};
                break;
            case Op::add:
                if (is_constant(s.b) && is_joined(s.a))
                    part = {What::add_constant, divide(s.a), 0, value(s.b)};
                else if (is_constant(s.a) && is_joined(s.b))
                    part = {What::add_constant, divide(s.b), 0, value(s.a)};
                else
                    part = term(i);
                break;
            case Op::subtract:
                part = is_constant(s.b) && is_joined(s.a)
                           ? Formula::Part{What::add_constant, divide(s.a), 0, -value(s.b)}
                           : term(i);
                break;
            default:
                part = term(i);
        }
        parts.push_back(part);
        return part_of_[i] = static_cast<Index>(parts.size() - 1);
    }

  private:
    static constexpr Index none = ~Index{0};

    bool is_constant(Index i) const { return steps_[i].op == Op::constant; }
    float value(Index i) const { return static_cast<float>(steps_[i].value); }
    // Whether a value is made of minima, maxima and absolute values, up to constants and signs.
    bool is_joined(Index i) const {
        const FormulaStep& s = steps_[i];
        switch (s.op) {
            case Op::minimum:
            case Op::maximum:
            case Op::smooth_minimum:
            case Op::absolute:
                return true;
            case Op::negate:
                return is_joined(s.a);
            case Op::add:
                return (is_constant(s.b) && is_joined(s.a)) || (is_constant(s.a) && is_joined(s.b));
            case Op::subtract:
                return is_constant(s.b) && is_joined(s.a);
            default:
                return false;
        }
    }
    Formula::Part term(Index i) {
        terms.push_back(term_of(steps_, i));
        return {Formula::Part::What::term, static_cast<Index>(terms.size() - 1), 0, 0};
    }

    const std::vector<FormulaStep>& steps_;
    std::vector<Index> part_of_;
};

// The values of a term in a box, and a bound of the slope of each. The box of its gradient knows what cancels; and by
// itself a length is no steeper than the vector that it is of, whose rows are nearly orthogonal for coordinates.
class TermInBox {
  public:
    void run(const TermSteps& term, const BoxOfDoubles& box) {
        values_.assign(term.steps.size(), Enclosure());
        slopes_.assign(term.steps.size(), 0);
        formula::run(term.data.data(), box.point(), values_.data());
        for (std::size_t i = 0; i < term.steps.size(); ++i)
            slopes_[i] = std::min(slope_of(term.steps[i]), std::sqrt(values_[i].squared_slope()));
    }
    double bound() const { return slopes_.back(); }
    double slope(std::size_t i) const { return slopes_[i]; }
    const Enclosure& result() const { return values_.back(); }
    const Enclosure& value(std::size_t i) const { return values_[i]; }

  private:
    double slope_of(const FormulaStep& s) const {
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
                return at(s.a) <= 1e4 ? slopes_[s.a] : Range::most;
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
                return std::exp(std::min(values_[s.a].value.high, 80.0)) * slopes_[s.a];
            case Op::length_of_two:
                return stretch({s.a, s.b, s.b}, 2);
            case Op::length_of_three:
                return stretch({s.a, s.b, s.c}, 3);
            case Op::divide:
            case Op::square_root:
                return Range::most;
        }
        return Range::most;
    }
    // By Gershgorin's theorem, for the matrix of the products of the rows' gradients.
    double stretch(const std::array<Index, 3>& of, std::size_t n) const {
        double most = 0;
        for (std::size_t i = 0; i < n; ++i) {
            double row = slopes_[of[i]] * slopes_[of[i]];
            for (std::size_t j = 0; j < n; ++j) {
                if (i == j) continue;
                Range product{};
                for (std::size_t axis = 0; axis < 3; ++axis)
                    product = product + values_[of[i]].gradient[axis] * values_[of[j]].gradient[axis];
                row += std::min(product.magnitude(), slopes_[of[i]] * slopes_[of[j]]);
            }
            most = std::max(most, row);
        }
        return std::sqrt(most);
    }

    std::vector<Enclosure> values_;
    std::vector<double> slopes_;
};

// Why a term has no bound in a box: the first step that has none although its operands have.
[[noreturn]] void refuse(const TermSteps& term, const TermInBox& in, const BoxOfDoubles& box, bool has_box) {
    for (std::size_t i = 0; i < term.steps.size(); ++i) {
        if (in.slope(i) < no_bound) continue;
        const FormulaStep& s = term.steps[i];
        const std::string near = " near " + box.place();
        switch (s.op) {
            case Op::square_root:
                fail(s.offset,
                     "what this is the root of is zero or negative" + near + ", where the slope has no bound");
            case Op::divide:
                fail(s.offset, "this divides by zero" + near + ", where the slope has no bound");
            default:
                break;
        }
        if (!has_box) break;
        if (s.op == Op::sine || s.op == Op::cosine)
            fail(s.offset, "this is the sine or cosine of more than 10000" + near);
        fail(s.offset, "the slope of this has no bound" + near);
    }
    fail(term.steps.back().offset,
         "the formula's slope has no bound far from the origin; say with \"bounds\" where it "
         "is meant: [[x, y, z], [x, y, z]]");
}

// A bound of a term's slope in a box.
double slope_in(const TermSteps& term, const BoxOfDoubles& whole, int most, bool has_box, model::Preparation& budget) {
    struct Candidate {
        double bound;
        BoxOfDoubles box;
        bool operator<(const Candidate& other) const { return bound < other.bound; }  // the steepest on top
    };
    TermInBox in;
    const std::array<bool, 3> axes = term.axes();
    double seen = 0;
    std::priority_queue<Candidate> open;
    const auto look = [&](const BoxOfDoubles& box, double around) {
        budget.pay(work_of_a_step * term.steps.size());
        in.run(term, box);
        double squared = 0;
        for (const double g : in.result().centre_gradient) squared += g * g;
        if (std::isfinite(squared)) seen = std::max(seen, std::sqrt(squared));
        open.push({std::min(around, in.bound()), box});
    };
    look(whole, Range::most);
    // As large as a box is along what the term depends on.
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
        if (is_bounded && (top.bound <= close_enough * seen || boxes >= most)) return top.bound * (1 + 1e-5);
        if (!is_bounded && (boxes >= most || size(b) < smallest)) {
            in.run(term, b);
            refuse(term, in, b, has_box);
        }
        open.pop();
        const auto [one, other] = b.parts(axes);
        look(one, top.bound);
        look(other, top.bound);
    }
}

// The range of the whole formula in a box.
Range values_in(const Division& formula, const BoxOfDoubles& box) {
    using What = Formula::Part::What;
    std::vector<Enclosure> terms;
    TermInBox in;
    for (const TermSteps& term : formula.terms) {
        in.run(term, box);
        terms.push_back(in.result().tightened(box.halves()));
    }
    std::vector<Range> value;
    for (const Formula::Part& part : formula.parts) {
        const auto of = [&](Index i) -> const Range& { return value[i]; };
        const double k = static_cast<double>(part.constant);
        switch (part.what) {
            case What::term:
                value.push_back(terms[part.a].value);
                break;
            case What::negate:
                value.push_back(-of(part.a));
                break;
            case What::absolute: {
                const Range& a = of(part.a);
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
                value.push_back(of(part.a) + Range{k, k});
                break;
            case What::smooth_minimum:
                value.push_back(
                    {std::min(of(part.a).low, of(part.b).low) - k / 6, std::min(of(part.a).high, of(part.b).high)});
                break;
        }
    }
    return value.back();
}

// A box around what of the solid is in a box: that of the parts in which the formula may be negative.
BoxOfDoubles around_solid(const Division& formula, const BoxOfDoubles& whole, std::uint64_t steps,
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
        const Range values = values_in(formula, top.box);
        // Floats may be negative where the formula is not.
        if (values.low > 1e-5 * std::min(1 + values.magnitude(), 1e4)) continue;
        if (top.depth < divisions) {
            const auto [one, other] = top.box.parts();
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

BoxOfDoubles box_of(const std::vector<glm::vec3>& corners) {
    if (corners.size() != 2) throw ModelError("formula: \"bounds\" are two corners, [[x, y, z], [x, y, z]]");
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
    Division division(steps);
    (void)division.divide(static_cast<Index>(steps.size() - 1));
    model::Preparation budget(info.name);

    double slope = 0;
    if (box.empty()) {
        for (const TermSteps& term : division.terms) {
            const double far = slope_in(term, cube(everywhere), most_boxes / 20, false, budget);
            const double near = slope_in(term, cube(nearby), most_boxes / 20, false, budget);
            if (far > 1.1 * near)
                fail(term.steps.back().offset,
                     "the formula's slope has no bound far from the origin; say with "
                     "\"bounds\" where it is meant: [[x, y, z], [x, y, z]]");
            slope = std::max(slope, far);
        }
    } else {
        const BoxOfDoubles around = around_solid(division, box_of(box), steps.size(), budget);
        for (const TermSteps& term : division.terms)
            slope = std::max(slope, slope_in(term, around, most_boxes, true, budget));
        for (int i = 0; i < 3; ++i) {
            const auto axis = static_cast<std::size_t>(i);
            bound.centre[i] = static_cast<float>(around.middle()[axis]);
            bound.half[i] = static_cast<float>(around.half(axis));
        }
    }
    if (slope > steepest) fail(0, "the formula is too steep: its slope may be " + std::to_string(slope));
    if (slope < 1e-6) slope = 1;  // it is nearly constant

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
