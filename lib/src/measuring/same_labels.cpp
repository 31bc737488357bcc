// Both objects are divided into the same boxes, at first coarsely. In most boxes, pruning deletes what differs between
// them. So few boxes are left, and only where labels differ or are in doubt.
#include "measuring/same_labels.hpp"

#include <algorithm>
#include <bit>
#include <unordered_map>

#include "measuring/divide.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "program/record_pair.hpp"
#include "pruning/prune.hpp"
#include "rewriting/rewrite.hpp"

namespace phasetree::measuring {

using building::CellBudget, building::WorkerPool;
using program::operands, program::ProgramOutput, program::RecordedPair;
using rewriting::ArenaScope, rewriting::rewrite;

namespace {

// The depths of the divisions, one after the other. Earlier ones take little time, and decide most pairs.
constexpr std::array depths{3, 5, 7, 9};

bool is_commutative(Op op) {
    return op == Op::minimum || op == Op::maximum || op == Op::add || op == Op::corner;
}

// Gives the instructions of two programs numbers, so that equal numbers mean equal values.
class ValueNumbers {
  public:
    explicit ValueNumbers(std::span<const float> constants) : constants_(constants) {}

    std::vector<std::uint32_t> of(const WorkingProgram& program) {
        std::vector<std::uint32_t> numbers(program.code.size(), 0);
        for (std::size_t i = 1; i < numbers.size(); ++i) {
            const Instruction& in = program.code[i];
            Key key{in.op, operands(in.op) > 0 ? numbers[in.a] : 0, operands(in.op) > 1 ? numbers[in.b] : 0, 0};
            if (is_commutative(in.op) && key.b < key.a) std::swap(key.a, key.b);
            if (program::has_constant(in.op)) {
                if (in.op == Op::add_constant && constants_[in.data] == 0) {
                    numbers[i] = key.a;
                    continue;
                }
                key.data = std::bit_cast<std::uint32_t>(constants_[in.data]);
            } else if (in.op >= Op::first_primitive) {
                key.data = in.data;  // equal constants share an offset, because each is recorded once
            }
            numbers[i] = known_.emplace(key, static_cast<std::uint32_t>(known_.size() + 1)).first->second;
        }
        return numbers;
    }

  private:
    struct Key {
        Op op;
        std::uint32_t a, b, data;
        bool operator==(const Key&) const = default;
    };
    struct Hash {
        std::size_t operator()(const Key& k) const {
            return ((static_cast<std::size_t>(k.op) * 0x9e3779b97f4a7c15u + k.a) * 0xbf58476d1ce4e5b9u + k.b) *
                       0x94d049bb133111ebu +
                   k.data;
        }
    };
    std::span<const float> constants_;
    std::unordered_map<Key, std::uint32_t, Hash> known_;
};

bool are_equal(const WorkingProgram& a, const WorkingProgram& b, std::span<const float> constants) {
    const auto differ = [](const ProgramOutput& x, const ProgramOutput& y) { return x.phase != y.phase; };
    if (!std::ranges::equal(a.outputs, b.outputs, std::not_fn(differ))) return false;
    ValueNumbers numbers(constants);
    const std::vector<std::uint32_t> of_a = numbers.of(a), of_b = numbers.of(b);
    for (std::size_t k = 0; k < a.outputs.size(); ++k)
        if (of_a[a.outputs[k].value] != of_b[b.outputs[k].value] || a.outputs[k].negate != b.outputs[k].negate)
            return false;
    return true;
}

struct OutOfBoxes {};

class Comparison {
  public:
    Comparison(const Phased& first, const Phased& second, const TraceableObject& traceable, std::size_t max_boxes,
               const std::function<bool()>& is_stopped)
        : is_stopped_(is_stopped),
          most_boxes_(max_boxes),
          pair_(program::record_pair(first, second)),
          whole_(rewrite(pair_.program, arena_)),
          context_{ProgramContext(whole_, pair_.program.constants, PhaseSet(), 0.5f * traceable.resolution),
                   {},
                   traceable.resolution},
          evaluators_{Evaluator(record(first)), Evaluator(record(second))},
          budget_(std::numeric_limits<std::size_t>::max()),
          pool_(budget_, pair_.program.constants),
          worker_{pool_} {
        Bounds box = traceable.bounds;
        const Bounds other = bounds(second);
        is_all_in_box_ = other.empty() || other.finite();
        if (is_all_in_box_)
            box = unite(box, other);
        else
            box = box.inflated(0.5f * box.diagonal());
        box_ = box.inflated(8 * traceable.resolution + 1e-3f * box.diagonal());
        // A much larger box has larger rounding errors than the context says.
        is_all_in_box_ = is_all_in_box_ && box_.diagonal() < 8 * traceable.bounds.diagonal();
    }

    SameLabels run() {
        const WorkingProgram a{whole_.code, whole_.lipschitz, whole_.outputs.first(pair_.outputs_of_first)};
        const WorkingProgram b{whole_.code, whole_.lipschitz, whole_.outputs.subspan(pair_.outputs_of_first)};
        if (are_equal(a, b, context_.program.constants)) return {Verdict::proved, {}};
        try {
            for (const int depth : depths) {
                bool is_open = false;
                divide({box_, a}, {box_, b}, depth, is_open);
                if (change_) return {Verdict::refuted, change_};
                if (!is_open) return {is_all_in_box_ ? Verdict::proved : Verdict::undecided, {}};
            }
        } catch (const OutOfBoxes&) {
            if (change_) return {Verdict::refuted, change_};
        }
        return {};
    }

  private:
    bool are_programs_equal(const WorkingProgram& a, const WorkingProgram& b) {
        if (are_equal(a, b, context_.program.constants)) return true;
        if (!context_.program.has_far_bounds) return false;
        const ArenaScope scratch(worker_.scratch);
        const auto near = [&](const WorkingProgram& p) {
            const auto without = pruning::without_far_bounds(p, context_.program, worker_.arenas());
            return without ? *without : p;
        };
        return are_equal(near(a), near(b), context_.program.constants);
    }
    // A point among those sampled in a box where both labels are certain and differ.
    void look_for_change(const Bounds& box) {
        const std::array<glm::vec3, batch_size> points = sampled_points(box);
        BatchOfFloats x, y, z;
        for (std::size_t i = 0; i < batch_size; ++i) {
            x[i] = points[i].x;
            y[i] = points[i].y;
            z[i] = points[i].z;
        }
        std::array<Samples, 2> samples;
        for (std::size_t k = 0; k < 2; ++k) evaluators_[k].sample(x, y, z, samples[k], Evaluator::thread_workspace());
        const float margin = 4 * context_.program.value_error;
        for (std::size_t i = 0; i < batch_size; ++i) {
            if (samples[0].label[i] == samples[1].label[i]) continue;
            if (!(samples[0].distance[i] > margin && samples[1].distance[i] > margin)) continue;
            const auto phase = [&](std::size_t k) { return Phase{static_cast<std::uint8_t>(samples[k].label[i])}; };
            change_ = LabelChange{points[i], phase(0), phase(1)};
            return;
        }
    }
    // Examines the parts of a box. Sets `is_open` if there are parts at the greatest depth that are not done.
    void divide(const Node& a, const Node& b, int depth, bool& is_open) {
        const ArenaScope programs(worker_.programs), scratch(worker_.scratch);
        const Division of_a(a, context_, worker_), of_b(b, context_, worker_);
        boxes_ += of_a.count();
        if (boxes_ > most_boxes_ || is_stopped_()) throw OutOfBoxes();
        for (std::size_t i = 0; i < of_a.count(); ++i) {
            const ExaminedBox in_a = of_a.examine(i), in_b = of_b.examine(i);
            const bool is_done = in_a.only && in_b.only ? *in_a.only == *in_b.only
                                                        : !in_a.only && !in_b.only &&
                                                              are_programs_equal(in_a.node.program, in_b.node.program);
            if (is_done) continue;
            look_for_change(in_a.node.box);
            if (change_) return;
            if (depth == 1 || !(in_a.can_be_divided || in_b.can_be_divided))
                is_open = true;
            else
                divide(in_a.node, in_b.node, depth - 1, is_open);
            if (change_) return;
        }
    }

    const std::function<bool()>& is_stopped_;
    std::size_t most_boxes_, boxes_ = 0;
    RecordedPair pair_;
    rewriting::Arena arena_;
    WorkingProgram whole_;
    MeasureContext context_;
    std::array<Evaluator, 2> evaluators_;
    CellBudget budget_;
    WorkerPool pool_;
    Worker worker_;
    Bounds box_;
    bool is_all_in_box_ = false;
    std::optional<LabelChange> change_;
};

}  // namespace

SameLabels same_labels(const Phased& first, const Phased& second, const TraceableObject& traceable,
                       std::size_t max_boxes, const std::function<bool()>& is_stopped) {
    return Comparison(first, second, traceable, max_boxes, is_stopped).run();
}

}  // namespace phasetree::measuring
