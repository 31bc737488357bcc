#include "nodes/formula/steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/text_error.hpp"

namespace phasetree::nodes {

using formula::Op;

namespace {

constexpr std::size_t most_steps = 2'000;
// A root of a sum of more squares than this stays a root.
constexpr std::size_t most_squares = 16;

}  // namespace

void fail_in_formula(std::size_t offset, const std::string& message) {
    throw TextError(std::string(Formula::info.name), "text", offset, message);
}

int operands(Op op) {
    switch (op) {
        case Op::x:
        case Op::y:
        case Op::z:
        case Op::constant:
            return 0;
        case Op::add:
        case Op::subtract:
        case Op::multiply:
        case Op::divide:
        case Op::length_of_two:
        case Op::minimum:
        case Op::maximum:
        case Op::smooth_minimum:
            return 2;
        case Op::length_of_three:
            return 3;
        default:
            return 1;
    }
}

FormulaIndex FormulaSteps::constant(double v) {
    if (!(std::abs(v) < 1e30)) fail_in_formula(offset_, "a value is too large, or not a number");
    return emit({.op = Op::constant, .value = v});
}

FormulaIndex FormulaSteps::add(Index a, Index b) {
    if (are_constant(a, b)) return constant(value(a) + value(b));
    if (is(a, 0)) return b;
    if (is(b, 0)) return a;
    return emit({.op = Op::add, .a = a, .b = b});
}

FormulaIndex FormulaSteps::subtract(Index a, Index b) {
    if (are_constant(a, b)) return constant(value(a) - value(b));
    if (a == b) return constant(0);
    if (is(a, 0)) return negate(b);
    if (is(b, 0)) return a;
    return emit({.op = Op::subtract, .a = a, .b = b});
}

FormulaIndex FormulaSteps::negate(Index a) {
    if (is_constant(a)) return constant(-value(a));
    if (steps_[a].op == Op::negate) return steps_[a].a;
    return emit({.op = Op::negate, .a = a});
}

FormulaIndex FormulaSteps::multiply(Index a, Index b) {
    if (are_constant(a, b)) return constant(value(a) * value(b));
    if (is_constant(b)) std::swap(a, b);
    if (is(a, 0)) return a;
    if (is(a, 1)) return b;
    if (is(a, -1)) return negate(b);
    if (a == b) return emit({.op = Op::square, .a = a});
    return emit({.op = Op::multiply, .a = a, .b = b});
}

FormulaIndex FormulaSteps::divide(Index a, Index b) {
    if (is(b, 0)) fail_in_formula(offset_, "this divides by zero");
    if (is_constant(b)) return multiply(constant(1 / value(b)), a);
    return emit({.op = Op::divide, .a = a, .b = b});
}

FormulaIndex FormulaSteps::power(Index a, double n) {
    if (n == 0.5) return square_root(a);
    if (n != std::floor(n) || std::abs(n) > 64)
        fail_in_formula(offset_, "an exponent must be a whole number from -64 to 64, or 0.5");
    if (n < 0) return divide(constant(1), power(a, -n));
    if (n == 0) return constant(1);
    const Index half = power(a, std::floor(n / 2));
    const Index even = n < 2 ? constant(1) : multiply(half, half);
    return std::fmod(n, 2) == 0 ? even : multiply(even, a);
}

FormulaIndex FormulaSteps::power_of(Index a, Index exponent) {
    if (!is_constant(exponent)) fail_in_formula(offset_, "an exponent must be a number");
    return power(a, value(exponent));
}

FormulaIndex FormulaSteps::square_root(Index a) {
    if (is_constant(a)) {
        if (value(a) < 0) fail_in_formula(offset_, "the argument of this root is negative");
        return constant(std::sqrt(value(a)));
    }
    std::vector<Index> sides;
    if (!collect_squares(a, sides)) return emit({.op = Op::square_root, .a = a});
    Index length = sides[0];
    for (std::size_t i = 1; i < sides.size(); i += 2)
        length = i + 1 < sides.size() ? length_of(length, sides[i], sides[i + 1]) : length_of(length, sides[i]);
    return sides.size() == 1 ? absolute(length) : length;
}

FormulaIndex FormulaSteps::absolute(Index a) {
    if (is_constant(a)) return constant(std::abs(value(a)));
    return emit({.op = Op::absolute, .a = a});
}

FormulaIndex FormulaSteps::minimum(Index a, Index b) {
    if (are_constant(a, b)) return constant(std::min(value(a), value(b)));
    return a == b ? a : emit({.op = Op::minimum, .a = a, .b = b});
}

FormulaIndex FormulaSteps::maximum(Index a, Index b) {
    if (are_constant(a, b)) return constant(std::max(value(a), value(b)));
    return a == b ? a : emit({.op = Op::maximum, .a = a, .b = b});
}

FormulaIndex FormulaSteps::smooth_minimum(Index a, Index b, Index radius) {
    if (!is_constant(radius) || !(value(radius) > 1e-6))
        fail_in_formula(offset_, "the radius of a smooth minimum or maximum must be a positive number");
    return emit({.op = Op::smooth_minimum, .a = a, .b = b, .value = value(radius)});
}

FormulaIndex FormulaSteps::emit(FormulaStep s) {
    s.offset = offset_;
    const Key key{s.op, s.a, s.b, s.c, s.value};
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
    if (steps_.size() == most_steps) fail_in_formula(offset_, "the formula has more than 2000 operations");
    const auto index = static_cast<Index>(steps_.size());
    steps_.push_back(s);
    known_.emplace(key, index);
    return index;
}

// Whether a value is a sum of squares; appends the squared values to `sides`. It may append steps, and may leave
// `sides` incomplete if it returns false. A step that is used twice counts twice, so a few steps could make a huge
// number of squares; this is the reason for the limit.
bool FormulaSteps::collect_squares(Index i, std::vector<Index>& sides, int depth) {
    const FormulaStep s = steps_[i];
    if (depth > deepest_formula || sides.size() >= most_squares) return false;
    if (s.op == Op::add) return collect_squares(s.a, sides, depth + 1) && collect_squares(s.b, sides, depth + 1);
    if (s.op == Op::square) {
        sides.push_back(s.a);
    } else if (s.op == Op::constant && s.value >= 0) {
        sides.push_back(constant(std::sqrt(s.value)));
    } else if (s.op == Op::multiply && is_constant(s.a) && value(s.a) >= 0 && steps_[s.b].op == Op::square) {
        sides.push_back(multiply(constant(std::sqrt(value(s.a))), steps_[s.b].a));
    } else {
        return false;
    }
    return true;
}

std::vector<FormulaStep> FormulaSteps::needed_for(Index result) const {
    return needed_steps(steps_, result);
}

std::vector<FormulaStep> needed_steps(const std::vector<FormulaStep>& all, FormulaIndex root) {
    std::vector<char> is_needed(root + 1, 0);
    is_needed[root] = 1;
    for (FormulaIndex i = root + 1; i-- > 0;) {
        if (!is_needed[i]) continue;
        const std::array<FormulaIndex, 3> of{all[i].a, all[i].b, all[i].c};
        for (int k = 0; k < operands(all[i].op); ++k) is_needed[of[static_cast<std::size_t>(k)]] = 1;
    }
    std::vector<FormulaIndex> new_index(root + 1, 0);
    std::vector<FormulaStep> needed;
    for (FormulaIndex i = 0; i <= root; ++i) {
        if (!is_needed[i]) continue;
        new_index[i] = static_cast<FormulaIndex>(needed.size());
        FormulaStep s = all[i];
        // Unused operands are set to 0.
        const int n = operands(s.op);
        s.a = n > 0 ? new_index[s.a] : 0;
        s.b = n > 1 ? new_index[s.b] : 0;
        s.c = n > 2 ? new_index[s.c] : 0;
        needed.push_back(s);
    }
    return needed;
}

}  // namespace phasetree::nodes
