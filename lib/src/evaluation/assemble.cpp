#include "evaluation/assemble.hpp"

#include <limits>

#include "program/op_traits.hpp"

namespace phasetree::evaluation {

using program::gives_point, program::operands;

namespace {

// Allocates register slots, reusing freed ones.
class Slots {
  public:
    std::uint32_t take(std::uint32_t size) {
        auto& free = size == 1 ? scalars_ : points_;
        if (!free.empty()) {
            const std::uint32_t slot = free.back();
            free.pop_back();
            return slot;
        }
        const std::uint32_t slot = end_;
        end_ += size;
        return slot;
    }
    void give_back(std::uint32_t slot, std::uint32_t size) { (size == 1 ? scalars_ : points_).push_back(slot); }
    std::uint32_t end() const { return end_; }

  private:
    std::vector<std::uint32_t> scalars_, points_;
    std::uint32_t end_ = 0;
};

std::uint32_t size_of(Op op) {
    return gives_point(op) ? 3 : 1;
}

}  // namespace

Assembly assemble(std::span<const Instruction> code, std::span<const ProgramOutput> outputs,
                  std::span<KeptValue> kept) {
    Assembly result;
    constexpr auto forever = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> last_use(code.size(), 0), slot(code.size(), 0);
    for (std::uint32_t i = 0; i < code.size(); ++i) {
        if (operands(code[i].op) > 0) last_use[code[i].a] = i;
        if (operands(code[i].op) > 1) last_use[code[i].b] = i;
    }
    last_use[0] = forever;  // the input point keeps slots 0 … 2
    for (const ProgramOutput& o : outputs) last_use[o.value] = forever;
    for (const KeptValue& k : kept) last_use[k.value] = forever;

    Slots slots;
    result.steps.reserve(code.size());
    result.data.reserve(code.size());
    result.outputs.reserve(outputs.size());
    for (std::uint32_t i = 0; i < code.size(); ++i) {
        const Instruction& in = code[i];
        const int n = operands(in.op);
        // A map writes its result one component at a time, so its slots are taken before those of its operand are
        // freed.
        slot[i] = slots.take(size_of(in.op));
        if (in.op != Op::input) {
            result.steps.push_back(
                {static_cast<std::uint32_t>(in.op), slot[i], n > 0 ? slot[in.a] : 0, n > 1 ? slot[in.b] : 0});
            result.data.push_back(in.data);
        }
        if (n > 0 && last_use[in.a] == i) slots.give_back(slot[in.a], size_of(code[in.a].op));
        if (n > 1 && in.b != in.a && last_use[in.b] == i) slots.give_back(slot[in.b], size_of(code[in.b].op));
    }
    for (const ProgramOutput& o : outputs)
        result.outputs.push_back({slot[o.value], static_cast<float>(o.phase.index), o.negate ? -1.f : 1.f});
    for (KeptValue& k : kept) k.slot = slot[k.value];
    result.slots = slots.end();
    return result;
}

}  // namespace phasetree::evaluation
