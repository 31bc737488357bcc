#pragma once

#include "pruning/prune.hpp"
#include "pruning/required_interval.hpp"
#include "rewriting/live_set.hpp"
#include "rewriting/rewrite.hpp"

namespace phasetree::pruning {

using program::operands, program::ProgramOutput;
using rewriting::LiveSet, rewriting::Rewriter, rewriting::SignedValue;

/// The sweep of prune.hpp over one program, from the last instruction to the first. For each instruction, it decides
/// from the ranges of the operands and from the required interval what the instruction becomes, and what that requires
/// of the operands. `Ranges` provides the values' ranges: low(i), high(i), is_above(a, b, least) and slope[i].
template <class Ranges>
class BackwardSweep {
  public:
    /// Only memory from `arenas.results` outlives the sweep.
    BackwardSweep(const WorkingProgram& program, const Ranges& ranges, const ProgramContext& context,
                  const Arenas& arenas, bool drops_far_bounds)
        : program_(program),
          constants_(context.constants),
          ranges_(ranges),
          opaque_(context.opaque),
          drops_far_bounds_(drops_far_bounds),
          arenas_(arenas),
          required_(arenas.scratch.allocate<RequiredInterval>(program.code.size())),
          replacement_(arenas.scratch.allocate<std::uint32_t>(program.code.size())),
          op_(arenas.scratch.allocate<Op>(program.code.size())),
          live_(arenas.scratch.allocate<std::uint32_t>(program.code.size())) {}

    std::optional<WorkingProgram> run() {
        const std::optional<std::span<const ProgramOutput>> possible = possible_outputs();
        if (!possible || !has_interface(*possible)) return std::nullopt;
        const std::span<const ProgramOutput> outputs = *possible;

        std::ranges::fill(required_, RequiredInterval{});
        for (const ProgramOutput& o : outputs) require(o.value, RequiredInterval::threshold(0));
        for (auto i = static_cast<std::uint32_t>(program_.code.size()); i-- > 1;)
            if (!required_[i].is_empty()) {
                live_[live_count_++] = i;
                replacement_[i] = i;
                op_[i] = program_.code[i].op;
                resolve(i);
            }
        if (is_unchanged(outputs)) return program_;
        const WorkingProgram rest = rewritten(outputs);
        if (!has_interface(rest.outputs)) return std::nullopt;
        if (rest.outputs.size() == 2 && rest.outputs[0].value != rest.outputs[1].value) return by_one_component(rest);
        return LiveSet(rest, rest.outputs, arenas_.scratch).program(arenas_);
    }

    /// After run(): the upper limits up to which the values of local primitives are required. The result outlives the
    /// sweep.
    std::span<const RequiredOfLocal> required_of_locals() const {
        const std::span<const std::uint32_t> live = live_.first(live_count_);
        const auto is_local = [&](std::uint32_t i) { return program::traits(program_.code[i].op).is_local; };
        const std::span<RequiredOfLocal> found =
            arenas_.results.allocate<RequiredOfLocal>(static_cast<std::size_t>(std::ranges::count_if(live, is_local)));
        std::size_t count = 0;
        for (const std::uint32_t i : live) {
            if (!is_local(i)) continue;
            const Instruction& in = program_.code[i];
            const auto is_like = [&](std::uint32_t j) {
                return program_.code[j].op == in.op && program_.code[j].data == in.data;
            };
            if (std::ranges::count_if(live, is_like) == 1) found[count++] = {in.data, required_[i].high()};
        }
        return found.first(count);
    }

  private:
    /// The outputs whose component may be negative somewhere; nullopt if one is negative everywhere.
    std::optional<std::span<const ProgramOutput>> possible_outputs() const {
        const std::span<ProgramOutput> possible = arenas_.scratch.allocate<ProgramOutput>(program_.outputs.size());
        std::size_t count = 0;
        for (const ProgramOutput& o : program_.outputs) {
            const float low = o.negate ? -high(o.value) : this->low(o.value);
            const float high = o.negate ? -this->low(o.value) : this->high(o.value);
            if (high < 0) return std::nullopt;
            if (low <= 0) possible[count++] = o;
        }
        return possible.first(count);
    }
    /// Whether rays can meet an interface: there are at least two phases, and not all of them are opaque.
    bool has_interface(std::span<const ProgramOutput> outputs) const {
        return outputs.size() > 1 &&
               !std::ranges::all_of(outputs, [&](const ProgramOutput& o) { return opaque_.contains(o.phase); });
    }
    /// Whether the sweep has changed nothing: all instructions and outputs are left, and their slopes are the program's
    /// own. If there are two phases, they must also share one value already; otherwise, by_one_component() may shorten
    /// the program.
    bool is_unchanged(std::span<const ProgramOutput> outputs) const {
        return !is_changed_ && outputs.size() == program_.outputs.size() &&
               (outputs.size() != 2 || outputs[0].value == outputs[1].value) &&
               ranges_.slope.data() == program_.lipschitz.data() &&
               live_count_ + 1 == program_.code.size();  // the input is always kept
    }

    /// The live instructions, rewritten by a Rewriter, with the outputs whose component may be negative. A component
    /// that is an absolute value is never negative, so its output is dropped.
    WorkingProgram rewritten(std::span<const ProgramOutput> outputs) {
        Arena& scratch = arenas_.scratch;
        Rewriter rewriter(constants_, live_count_, scratch);
        const std::span<SignedValue> written = scratch.allocate<SignedValue>(program_.code.size());
        written[0] = {};
        const std::span<const Instruction> code = program_.code;
        const std::span<const float> slope = ranges_.slope;
        for (std::size_t k = live_count_; k-- > 0;) {
            const std::uint32_t i = live_[k];
            if (replacement_[i] != i) {
                written[i] = written[replacement_[i]];
                continue;
            }
            const Instruction& in = code[i];
            // A changed operation, which is a negation or a maximum, is as steep as its steepest operand.
            const float bound = op_[i] == in.op        ? slope[i]
                                : operands(op_[i]) > 1 ? std::max(slope[in.a], slope[in.b])
                                                       : slope[in.a];
            written[i] = rewriter.write({op_[i], in.a, in.b, in.data}, written[in.a], written[in.b], bound,
                                        required_[i].is_sign());
        }
        const std::span<ProgramOutput> rest = scratch.allocate<ProgramOutput>(outputs.size());
        std::size_t count = 0;
        for (const ProgramOutput& o : outputs) {
            const SignedValue& v = written[o.value];
            const bool is_negative = v.is_negative() != o.negate;
            if (is_negative || rewriter.code()[v.id()].op != Op::absolute)
                rest[count++] = {o.phase, v.id(), is_negative};
        }
        return {rewriter.code(), rewriter.lipschitz(), rest.first(count)};
    }

    /// A program of two phases, reduced to one of its two components, whose sign determines the phase: the component
    /// that takes fewer instructions.
    WorkingProgram by_one_component(const WorkingProgram& both) const {
        ProgramOutput outputs[2][2];
        for (const std::size_t k : {0, 1}) {
            const ProgramOutput& kept = both.outputs[k];
            outputs[k][k] = kept;
            outputs[k][1 - k] = {both.outputs[1 - k].phase, kept.value, !kept.negate};
        }
        const LiveSet first(both, outputs[0], arenas_.scratch), second(both, outputs[1], arenas_.scratch);
        return (second.size() < first.size() ? second : first).program(arenas_);
    }

    float low(std::uint32_t i) const { return ranges_.low(i); }
    float high(std::uint32_t i) const { return ranges_.high(i); }
    bool is_above(std::uint32_t a, std::uint32_t b, float least = 0) const { return ranges_.is_above(a, b, least); }
    float constant(const Instruction& in) const { return constants_[in.data]; }

    /// Adds an interval to the requirements of a value.
    void require(std::uint32_t i, RequiredInterval r) { required_[i] = required_[i].hull(r); }
    /// Replaces a value by an earlier one.
    void replace(std::uint32_t i, std::uint32_t by) {
        replacement_[i] = by;
        is_changed_ = true;
        require(by, required_[i]);
    }
    /// Replaces an instruction's operation.
    void change(std::uint32_t i, Op op) {
        op_[i] = op;
        is_changed_ = true;
    }

    // The rules in operation_rules.hpp. Each decides what an instruction becomes and requires its operands.
    void resolve(std::uint32_t i);
    void resolve_minimum(std::uint32_t i);
    void resolve_maximum(std::uint32_t i);
    void resolve_smooth_minimum(std::uint32_t i);
    void resolve_guarded(std::uint32_t i);
    void resolve_sum(std::uint32_t i);
    void resolve_difference(std::uint32_t i);
    void resolve_corner(std::uint32_t i);
    void resolve_nearer(std::uint32_t i);
    void resolve_absolute(std::uint32_t i);
    void resolve_product(std::uint32_t i);
    struct Choice {
        bool is_a, is_b;                          ///< whether an operand may replace the extremum
        RequiredInterval required_a, required_b;  ///< what is required of the operands if neither replaces it
    };
    void resolve_extremum(std::uint32_t i, const Choice&);
    bool is_leaf(std::uint32_t i) const;
    bool is_zero(std::uint32_t i) const;

    const WorkingProgram& program_;
    std::span<const float> constants_;
    const Ranges& ranges_;
    PhaseSet opaque_;
    bool drops_far_bounds_;
    const Arenas& arenas_;
    std::span<RequiredInterval> required_;
    std::span<std::uint32_t> replacement_;  ///< for each live value: itself or an earlier one
    std::span<Op> op_;                      ///< for each live value: its operation, possibly changed
    std::span<std::uint32_t> live_;         ///< the required values, from the last one on
    std::size_t live_count_ = 0;
    bool is_changed_ = false;
};

}  // namespace phasetree::pruning
