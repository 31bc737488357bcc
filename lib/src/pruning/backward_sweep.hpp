#pragma once

#include "pruning/operation_rules.hpp"
#include "pruning/prune.hpp"
#include "rewriting/live_set.hpp"
#include "rewriting/rewrite.hpp"

namespace phasetree::pruning {

using rewriting::LiveSet, rewriting::Rewriter, rewriting::SignedValue;

/// The sweep of prune.hpp over one program: applies the OperationRules from the last instruction to the first, and
/// rewrites what is left. `Ranges` is as for the rules.
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
          arenas_(arenas),
          rules_(program, ranges, context.constants, drops_far_bounds, arenas.scratch),
          live_(arenas.scratch.allocate<std::uint32_t>(program.code.size())) {}

    std::optional<WorkingProgram> run() {
        const std::optional<std::span<const ProgramOutput>> possible = possible_outputs();
        if (!possible || !has_interface(*possible)) return std::nullopt;
        const std::span<const ProgramOutput> outputs = *possible;

        rules_.start(outputs);
        for (auto i = static_cast<std::uint32_t>(program_.code.size()); i-- > 1;)
            if (!rules_.required(i).is_empty()) {
                live_[live_count_++] = i;
                rules_.resolve(i);
            }
        if (is_unchanged(outputs)) return program_;
        const WorkingProgram rest = rewritten(outputs);
        if (!has_interface(rest.outputs)) return std::nullopt;
        if (rest.outputs.size() == 2 && rest.outputs[0].value != rest.outputs[1].value) return by_one_component(rest);
        return LiveSet(rest, rest.outputs, arenas_.scratch).program(arenas_);
    }

    /// After run(): the largest values that matter of local primitives. The result outlives the sweep.
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
            if (std::ranges::count_if(live, is_like) == 1) found[count++] = {in.data, rules_.required(i).high()};
        }
        return found.first(count);
    }

  private:
    /// The outputs whose component may be negative somewhere; nullopt if one is negative everywhere.
    std::optional<std::span<const ProgramOutput>> possible_outputs() const {
        const std::span<ProgramOutput> possible = arenas_.scratch.allocate<ProgramOutput>(program_.outputs.size());
        std::size_t count = 0;
        for (const ProgramOutput& o : program_.outputs) {
            const float low = o.negate ? -ranges_.high(o.value) : ranges_.low(o.value);
            const float high = o.negate ? -ranges_.low(o.value) : ranges_.high(o.value);
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
    /// Whether the sweep has changed nothing: all instructions and outputs are kept, with the program's own Lipschitz
    /// bounds. A program of two phases counts as unchanged only if both outputs already use the same value; otherwise,
    /// by_one_component() may shorten it.
    bool is_unchanged(std::span<const ProgramOutput> outputs) const {
        return !rules_.is_changed() && outputs.size() == program_.outputs.size() &&
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
            if (rules_.replacement(i) != i) {
                written[i] = written[rules_.replacement(i)];
                continue;
            }
            const Instruction& in = code[i];
            const Op op = rules_.op(i);
            // A changed operation, which is a negation or a maximum, is as steep as its steepest operand.
            const float bound = op == in.op        ? slope[i]
                                : operands(op) > 1 ? std::max(slope[in.a], slope[in.b])
                                                   : slope[in.a];
            written[i] = rewriter.write({op, in.a, in.b, in.data}, written[in.a], written[in.b], bound,
                                        rules_.required(i).is_sign());
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

    const WorkingProgram& program_;
    std::span<const float> constants_;
    const Ranges& ranges_;
    PhaseSet opaque_;
    const Arenas& arenas_;
    OperationRules<Ranges> rules_;
    std::span<std::uint32_t> live_;  ///< the required values, from the last one on
    std::size_t live_count_ = 0;
};

}  // namespace phasetree::pruning
