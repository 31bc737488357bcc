#include "cells/prune.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "phasetree/nodes/copies/endless_grid.hpp"

/// Two kinds of pruning, in one backward sweep over the program.
///
/// *By value* (Barbier et al. 2025): in min(a, b), if b − a at the centre exceeds what both can change by within the
/// ball, b never wins and goes; likewise for max and smooth_min.
///
/// *By threshold*: of an output only the sign matters. sign(max(a, b) − τ) is that of b − τ if a stays below τ
/// throughout; if one of the two stays above, that decides and the other goes. Negation, offsets and scaling only move
/// τ. So each value is demanded either as a value, or relative to one threshold; one that is demanded in several ways
/// is demanded as a value. A replaced operand has the same sign relative to τ and is itself Lipschitz, so its distance
/// from τ still bounds the distance to where the sign changes.
namespace phasetree {

namespace {

struct Demand {
    enum Kind : unsigned char { none, threshold, value } kind = none;
    float tau = 0;
};

/// A slope above this has a jump in it.
constexpr float half_a_jump = 0x1p20f;

class Pruner {
  public:
    Pruner(const WorkingProgram& program, std::span<const float> constants, std::span<const float> value, float radius,
           float rounding)
        : program_(program),
          constants_(constants),
          value_(value),
          radius_(radius),
          rounding_(rounding),
          still_(local_slopes()),
          slope_(still_.empty() ? std::span<const float>(program.lipschitz) : still_),
          demand_(program.code.size()),
          instead_(program.code.size()),
          op_(program.code.size()) {}

    std::optional<WorkingProgram> run() {
        std::vector<ProgramOutput> outputs;
        for (const ProgramOutput& o : program_.outputs) {
            const float low = o.negate ? -high(o.value) : this->low(o.value);
            const float high = o.negate ? -this->low(o.value) : this->high(o.value);
            if (high < 0) return std::nullopt;  // this phase everywhere
            if (low <= 0) outputs.push_back(o);
        }
        if (outputs.size() < 2) return std::nullopt;  // one phase everywhere

        for (const ProgramOutput& o : outputs) ask(o.value, {Demand::threshold, 0});
        for (auto i = static_cast<std::uint32_t>(program_.code.size()); i-- > 1;)
            if (demand_[i].kind != Demand::none) resolve(i);
        WorkingProgram result = compact(outputs);
        // Where two phases meet, one component tells both. The one that costs less.
        if (result.outputs.size() == 2) result = one_of_two(result);
        return result;
    }

    /// Only what the outputs reach of a program that is otherwise unchanged.
    WorkingProgram reachable() {
        for (const ProgramOutput& o : program_.outputs) ask(o.value, {Demand::value, 0});
        for (auto i = static_cast<std::uint32_t>(program_.code.size()); i-- > 1;) {
            if (demand_[i].kind == Demand::none) continue;
            instead_[i] = i;
            op_[i] = program_.code[i].op;
            if (operands(op_[i]) > 0) ask(program_.code[i].a, {Demand::value, 0});
            if (operands(op_[i]) > 1) ask(program_.code[i].b, {Demand::value, 0});
        }
        return compact(program_.outputs);
    }

  private:
    float slack(std::uint32_t i) const { return slope_[i] * radius_ + rounding_; }
    float low(std::uint32_t i) const { return value_[i] - slack(i); }
    float high(std::uint32_t i) const { return value_[i] + slack(i); }

    void ask(std::uint32_t i, Demand d) {
        Demand& known = demand_[i];
        if (known.kind == Demand::none)
            known = d;
        else if (known.kind != d.kind || (d.kind == Demand::threshold && known.tau != d.tau))
            known = {Demand::value, 0};
    }

    void replace(std::uint32_t i, std::uint32_t by) {
        instead_[i] = by;
        ask(by, demand_[i]);
    }

    void resolve(std::uint32_t i) {
        const Instruction& in = program_.code[i];
        const Demand d = demand_[i];
        const bool relative = d.kind == Demand::threshold;
        const auto constant = [&] { return constants_[in.data]; };
        instead_[i] = i;
        op_[i] = in.op;
        switch (in.op) {
            case Op::minimum:
                if (value_[in.b] - value_[in.a] > slack(in.a) + slack(in.b)) return replace(i, in.a);
                if (value_[in.a] - value_[in.b] > slack(in.a) + slack(in.b)) return replace(i, in.b);
                if (relative) {
                    if (low(in.a) > d.tau) return replace(i, in.b);
                    if (low(in.b) > d.tau) return replace(i, in.a);
                    if (high(in.a) < d.tau) return replace(i, in.a);
                    if (high(in.b) < d.tau) return replace(i, in.b);
                }
                ask(in.a, d);
                ask(in.b, d);
                return;
            case Op::maximum:
                return resolve_maximum(i, d);
            case Op::smooth_minimum: {
                const float r = constant();
                if (value_[in.b] - value_[in.a] > slack(in.a) + slack(in.b) + r) return replace(i, in.a);
                if (value_[in.a] - value_[in.b] > slack(in.a) + slack(in.b) + r) return replace(i, in.b);
                if (relative) {
                    // Beyond τ + r, what a takes off b is less than b's own distance from τ.
                    if (low(in.a) > d.tau + r) return replace(i, in.b);
                    if (low(in.b) > d.tau + r) return replace(i, in.a);
                    if (high(in.a) < d.tau) return replace(i, in.a);
                    if (high(in.b) < d.tau) return replace(i, in.b);
                }
                ask(in.a, {Demand::value, 0});
                ask(in.b, {Demand::value, 0});
                return;
            }
            case Op::guarded: {
                const float half = 0.5f * constant();
                if (low(in.a) > half || (relative && d.tau == 0 && low(in.a) > 0)) return replace(i, in.a);
                // Without a jump the plain intersection has the same sign.
                if (relative && d.tau == 0 && slope_[in.b] <= 2 * slope_[in.a]) {
                    op_[i] = Op::maximum;
                    return resolve_maximum(i, d);
                }
                ask(in.a, {Demand::value, 0});
                ask(in.b, {Demand::value, 0});
                return;
            }
            case Op::add:
                // A skeleton out of reach adds nothing.
                if (is_zero(in.a)) return replace(i, in.b);
                if (is_zero(in.b)) return replace(i, in.a);
                ask(in.a, {Demand::value, 0});
                ask(in.b, {Demand::value, 0});
                return;
            case Op::corner: {
                // Where one is negative and the smaller, the corner is the other.
                if (high(in.a) < 0 && value_[in.b] - value_[in.a] > slack(in.a) + slack(in.b)) return replace(i, in.b);
                if (high(in.b) < 0 && value_[in.a] - value_[in.b] > slack(in.a) + slack(in.b)) return replace(i, in.a);
                if (relative) {
                    const float below = std::min(d.tau, 0.f);
                    if (high(in.a) < below) return replace(i, in.b);
                    if (high(in.b) < below) return replace(i, in.a);
                    if (low(in.a) > d.tau) return replace(i, in.a);
                    if (low(in.b) > d.tau) return replace(i, in.b);
                }
                // Up to 0 it is the maximum, and so relative to a τ ≤ 0 it has the sign that the maximum has.
                const Demand each = relative && d.tau <= 0 ? d : Demand{Demand::value, 0};
                ask(in.a, each);
                ask(in.b, each);
                return;
            }
            case Op::absolute:
                if (low(in.a) > 0) return replace(i, in.a);
                if (high(in.a) < 0) {
                    op_[i] = Op::negate;
                    return ask(in.a, relative ? Demand{Demand::threshold, -d.tau} : d);
                }
                return ask(in.a, {Demand::value, 0});
            case Op::negate:
                return ask(in.a, relative ? Demand{Demand::threshold, -d.tau} : d);
            case Op::add_constant:
                return ask(in.a, relative ? Demand{Demand::threshold, d.tau - constant()} : d);
            case Op::constant_minus:
                return ask(in.a, relative ? Demand{Demand::threshold, constant() - d.tau} : d);
            case Op::multiply_constant:
                if (relative && constant() != 0) return ask(in.a, {Demand::threshold, d.tau / constant()});
                return ask(in.a, {Demand::value, 0});
            default:
                if (operands(in.op) > 0) ask(in.a, {Demand::value, 0});
                if (operands(in.op) > 1) ask(in.b, {Demand::value, 0});
        }
    }

    void resolve_maximum(std::uint32_t i, const Demand& d) {
        const Instruction& in = program_.code[i];
        if (value_[in.a] - value_[in.b] > slack(in.a) + slack(in.b)) return replace(i, in.a);
        if (value_[in.b] - value_[in.a] > slack(in.a) + slack(in.b)) return replace(i, in.b);
        if (d.kind == Demand::threshold) {
            if (high(in.a) < d.tau) return replace(i, in.b);
            if (high(in.b) < d.tau) return replace(i, in.a);
            if (low(in.a) > d.tau) return replace(i, in.a);
            if (low(in.b) > d.tau) return replace(i, in.b);
        }
        ask(in.a, d);
        ask(in.b, d);
    }

    /// Whether a value is exactly zero throughout the ball.
    bool is_zero(std::uint32_t i) const {
        const Instruction& in = program_.code[i];
        if (in.op == Op::multiply_constant) return is_zero(in.a);
        return in.op == Op::falloff && low(in.a) > constants_[in.data];
    }

    WorkingProgram compact(std::span<const ProgramOutput> outputs) const {
        WorkingProgram result;
        const std::size_t n = program_.code.size();
        std::vector<std::uint32_t> renumbered(n, 0);
        result.code.push_back(program_.code[0]);
        result.lipschitz.push_back(program_.lipschitz[0]);
        for (std::uint32_t i = 1; i < n; ++i) {
            if (demand_[i].kind == Demand::none) continue;
            if (instead_[i] != i) {
                renumbered[i] = renumbered[instead_[i]];
                continue;
            }
            renumbered[i] = static_cast<std::uint32_t>(result.code.size());
            Instruction in = program_.code[i];
            in.op = op_[i];
            in.a = renumbered[in.a];
            in.b = renumbered[in.b];
            result.code.push_back(in);
            result.lipschitz.push_back(slope_[i]);
        }
        for (const ProgramOutput& o : outputs) result.outputs.push_back({o.phase, renumbered[o.value], o.negate});
        return result;
    }

    static WorkingProgram one_of_two(const WorkingProgram& both) {
        const auto only = [&](std::size_t k) {
            WorkingProgram one = both;
            const ProgramOutput& kept = both.outputs[k];
            one.outputs[1 - k].value = kept.value;
            one.outputs[1 - k].negate = !kept.negate;
            return Pruner(one, {}, {}, 0, 0).reachable();
        };
        if (both.outputs[0].value == both.outputs[1].value) return both;
        WorkingProgram first = only(0), second = only(1);
        return second.code.size() < first.code.size() ? second : first;
    }

    /// Slopes within the ball. A fold of space jumps, which is recorded as a slope of FoldMap::jump; in a ball that
    /// touches none of its jumps that factor goes from all that follows. The guard above the fold tells: its bound is
    /// more than half of `far` wherever the fold jumps. Nothing if nothing jumps.
    std::vector<float> local_slopes() const {
        if (std::ranges::none_of(program_.lipschitz, [](float l) { return l > half_a_jump; })) return {};
        std::vector<float> slope = program_.lipschitz;
        const auto size = static_cast<std::uint32_t>(program_.code.size());
        std::vector<char> is_still(size, 0);  // folds without a jump in the ball
        for (std::uint32_t i = 1; i < size; ++i) {
            const Instruction& guard = program_.code[i];
            if (guard.op != Op::guarded || value_.empty()) continue;
            // The bound's own slope is that of its point.
            const float high = value_[guard.a] + slope[guard.a] * radius_ + rounding_;
            if (!(high < 0.5f * constants_[guard.data])) continue;
            for (std::uint32_t k = 1; k < i; ++k)
                if (is_fold(program_.code[k].op) && program_.code[k].a == program_.code[guard.a].a) is_still[k] = 1;
        }
        std::vector<char> jumps(size, 0);
        for (std::uint32_t i = 1; i < size; ++i) {
            const Instruction& in = program_.code[i];
            if (slope[i] <= half_a_jump) continue;
            const int n = operands(in.op);
            jumps[i] = (n > 0 && jumps[in.a]) || (n > 1 && jumps[in.b]) || (is_fold(in.op) && !is_still[i]);
            while (!jumps[i] && slope[i] > half_a_jump) slope[i] /= FoldMap::jump;
        }
        return slope;
    }

    const WorkingProgram& program_;
    std::span<const float> constants_;
    std::span<const float> value_;
    float radius_, rounding_;
    std::vector<float> still_;  ///< slopes, if any differs from the program's
    std::span<const float> slope_;
    std::vector<Demand> demand_;
    std::vector<std::uint32_t> instead_;
    std::vector<Op> op_;
};

}  // namespace

float finest_jump(const WorkingProgram& program, std::span<const float> constants) {
    float finest = Bounds::infinity;
    for (std::size_t i = 0; i < program.code.size(); ++i) {
        if (!is_fold(program.code[i].op) || program.lipschitz[i] <= half_a_jump) continue;
        FoldMap fold;
        std::memcpy(static_cast<void*>(&fold), constants.data() + program.code[i].data, sizeof fold);
        for (int axis = 0; axis < 3; ++axis)
            if (fold.spacing[axis] > 0) finest = std::min(finest, fold.spacing[axis]);
    }
    return finest;
}

std::optional<WorkingProgram> prune(const WorkingProgram& program, std::span<const float> constants,
                                    std::span<const float> value, float radius, float rounding) {
    return Pruner(program, constants, value, radius, rounding).run();
}

}  // namespace phasetree
