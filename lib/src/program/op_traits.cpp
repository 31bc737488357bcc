#include "program/op_traits.hpp"

#include "model/local_data.hpp"
#include "program/dispatch.hpp"
#include "program/fused.hpp"

namespace phasetree::program {

namespace {

static_assert(first_placed + Primitives::size <= max_operations);

constexpr std::uint16_t half_instructions_of_short = 3;  // rough estimates
constexpr std::uint16_t typical_half_instructions = 120;

// The cost of a primitive; a typical one if it depends on the data.
template <class P>
constexpr std::uint16_t half_instructions_of() {
    if constexpr (LocalDataPrimitive<P>) {
        return P::search_half_instructions;
    } else if constexpr (LongPrimitive<P>) {
        static_assert(StatesCost<P>, "a long primitive must state its cost (phasetree/model/concepts.hpp)");
        if constexpr (HasConstantCost<P>)
            return P::half_instructions;
        else
            return typical_half_instructions;
    } else {
        return half_instructions_of_short;
    }
}

template <class P>
constexpr OpTraits traits_of_primitive() {
    OpTraits t;
    t.half_instructions = half_instructions_of<P>();
    t.has_cost_in_data = HasCostInData<P> && !LocalDataPrimitive<P>;
    t.is_long_primitive = LongPrimitive<P>;
    t.is_pattern = PatternPrimitive<P> || PatternDataPrimitive<P>;
    t.is_voxel_grid = PatternDataPrimitive<P>;
    t.is_local = AnyLocalPrimitive<P>;
    t.has_many_parts = PrimitiveOfParts<P>;
    if constexpr (requires { P::floats_read; }) t.floats_read = P::floats_read;
    if constexpr (requires { P::is_best_in_small_boxes; }) t.is_best_in_small_boxes = P::is_best_in_small_boxes;
    return t;
}

// Sets the traits of all primitives of a list.
template <class... Ps>
constexpr void set_primitives(TypeList<Ps...>, auto& all) {
    const auto of = [&](Op op) -> OpTraits& { return all[static_cast<std::size_t>(op)]; };
    ((of(op_of<Ps>()) = traits_of_primitive<Ps>()), ...);
}
// Marks the specialised forms of the local primitives of a list.
template <class... Ps>
constexpr void mark_specialised(TypeList<Ps...>, auto& all) {
    const auto mark = [&]<class P>() {
        if constexpr (AnyLocalPrimitive<P>)
            all[static_cast<std::size_t>(op_of<typename P::Specialised>())].is_specialised = true;
    };
    (mark.template operator()<Ps>(), ...);
}
// Sets the traits of all maps of a list.
template <class... Ms>
constexpr void set_maps(TypeList<Ms...>, auto& all) {
    std::size_t op = first_map;
    ((all[op++] = {.gives_point = true, .is_fold = FoldingMap<Ms>}), ...);
}

constexpr auto all_traits() {
    std::array<OpTraits, max_operations> all{};
    const auto of = [&](Op op) -> OpTraits& { return all[static_cast<std::size_t>(op)]; };
    of(Op::input) = {.operands = 0, .gives_point = true};
    for (const Op op : {Op::add, Op::subtract, Op::minimum, Op::maximum, Op::far_bound, Op::far_bound_inside,
                        Op::smooth_minimum, Op::guarded, Op::corner, Op::nearer})
        of(op).operands = 2;
    for (const Op op :
         {Op::add_constant, Op::constant_minus, Op::multiply_constant, Op::smooth_minimum, Op::guarded, Op::falloff})
        of(op).has_constant = true;
    set_primitives(Primitives(), all);
    set_primitives(DataPrimitives(), all);
    mark_specialised(Primitives(), all);
    mark_specialised(DataPrimitives(), all);
    set_maps(PointMaps(), all);
    all[affine_map].gives_point = true;
    for (std::size_t i = first_map; i < first_placed + Primitives::size; ++i)
        all[i].half_instructions = half_instructions_of_short;
    return all;
}
}  // namespace

constexpr std::array<OpTraits, max_operations> op_traits = all_traits();

}  // namespace phasetree::program
