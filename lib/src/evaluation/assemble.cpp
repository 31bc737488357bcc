#include "evaluation/assemble.hpp"

#include <array>
#include <limits>

#include "program/fused.hpp"

namespace phasetree {

namespace {

/// Hands out register slots; a freed one is used again.
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

namespace {

static_assert(first_placed + Primitives::size <= most_operations);

template <class... Ps>
constexpr auto long_ones(TypeList<Ps...>) {
    return std::array<bool, sizeof...(Ps)>{LongPrimitive<Ps>...};
}

template <class... Ps>
constexpr void mark_patterns(TypeList<Ps...>, auto& all) {
    constexpr auto first = static_cast<std::size_t>(Op::first_primitive);
    const auto mark = [&]<class P>() {
        if constexpr (PatternPrimitive<P>) all[first + index_in<P>(Primitives())].is_pattern = true;
        if constexpr (LocalPrimitive<P>) {
            OpTraits& local = all[first + index_in<P>(Primitives())];
            local.is_local = true;
            local.half_works = 800;  // as long as all of it may matter
            all[first + Primitives::size + index_in<typename P::Specialised>(DataPrimitives())].is_near = true;
        }
    };
    (mark.template operator()<Ps>(), ...);
}

constexpr auto all_traits() {
    std::array<OpTraits, most_operations> all{};
    constexpr auto first_primitive = static_cast<std::size_t>(Op::first_primitive);
    const auto of = [&](Op op) -> OpTraits& { return all[static_cast<std::size_t>(op)]; };
    of(Op::input) = {.operands = 0, .gives_point = true};
    for (const Op op : {Op::add, Op::subtract, Op::minimum, Op::maximum, Op::far_bound, Op::far_bound_inside,
                        Op::smooth_minimum, Op::guarded, Op::corner})
        of(op).operands = 2;
    constexpr auto is_long = long_ones(Primitives());
    for (std::size_t i = 0; i < Primitives::size + DataPrimitives::size; ++i)
        all[first_primitive + i].is_long_primitive = i >= is_long.size() || is_long[i];  // then come those with data
    for (std::size_t i = first_primitive; i < first_placed + Primitives::size; ++i)
        all[i].half_works = all[i].is_long_primitive ? 120 : 3;
    for (std::size_t i = first_map; i < first_placed; ++i) all[i].gives_point = true;
    all[first_map + index_in<FoldMap>(PointMaps())].is_fold = true;
    all[first_primitive + Primitives::size + index_in<Siren::Network>(DataPrimitives())].is_network = true;
    mark_patterns(Primitives(), all);
    return all;
}
}  // namespace

constexpr std::array<OpTraits, most_operations> op_traits = all_traits();

Assembly assemble(std::span<const Instruction> code, std::span<const ProgramOutput> outputs,
                  std::span<KeptValue> kept) {
    Assembly result;
    constexpr auto forever = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> last_use(code.size(), 0), slot(code.size(), 0);
    for (std::uint32_t i = 0; i < code.size(); ++i) {
        if (operands(code[i].op) > 0) last_use[code[i].a] = i;
        if (operands(code[i].op) > 1) last_use[code[i].b] = i;
    }
    last_use[0] = forever;  // the input keeps slots 0 … 2
    for (const ProgramOutput& o : outputs) last_use[o.value] = forever;
    for (const KeptValue& k : kept) last_use[k.value] = forever;

    Slots slots;
    result.steps.reserve(code.size());
    result.data.reserve(code.size());
    result.outputs.reserve(outputs.size());
    for (std::uint32_t i = 0; i < code.size(); ++i) {
        const Instruction& in = code[i];
        const int n = operands(in.op);
        // A map writes its result one component at a time, so it is placed before its operand's slots are freed.
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

std::vector<ProgramOutput> outputs_of(const Program& program) {
    std::vector<ProgramOutput> outputs;
    for (const Output& o : program.outputs) outputs.push_back({o.phase, o.value, false});
    return outputs;
}

}  // namespace phasetree
