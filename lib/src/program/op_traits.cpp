#include "program/op_traits.hpp"

#include "model/local_data.hpp"
#include "program/dispatch.hpp"
#include "program/fused.hpp"

namespace phasetree::program {

namespace {

static_assert(first_placed + Primitives::size <= most_operations);

// Whether each primitive of a list is long.
template <class... Ps>
constexpr auto long_ones(TypeList<Ps...>) {
    return std::array<bool, sizeof...(Ps)>{LongPrimitive<Ps>...};
}

constexpr OpTraits& traits_of(auto& all, Op op) {
    return all[static_cast<std::size_t>(op)];
}

// Sets the traits of patterns and of primitives that can be specialised.
template <class... Ps>
constexpr void mark_patterns(TypeList<Ps...>, auto& all) {
    const auto mark = [&]<class P>() {
        if constexpr (PatternPrimitive<P> || PatternDataPrimitive<P>) traits_of(all, op_of<P>()).is_pattern = true;
        if constexpr (PatternDataPrimitive<P>) traits_of(all, op_of<P>()).is_voxel_grid = true;
        if constexpr (AnyLocalPrimitive<P>) {
            OpTraits& local = traits_of(all, op_of<P>());
            local.is_local = true;
            local.half_instructions = 800;  // rough estimate for all sites of a Voronoi pattern
            local.has_many_parts = PrimitiveOfParts<P>;
            traits_of(all, op_of<typename P::Specialised>()).is_specialised = true;
        }
        if constexpr (requires { P::search_half_instructions; })
            traits_of(all, op_of<P>()).half_instructions = P::search_half_instructions;
    };
    (mark.template operator()<Ps>(), ...);
}

constexpr auto all_traits() {
    std::array<OpTraits, most_operations> all{};
    constexpr auto first_primitive = static_cast<std::size_t>(Op::first_primitive);
    const auto of = [&](Op op) -> OpTraits& { return all[static_cast<std::size_t>(op)]; };
    of(Op::input) = {.operands = 0, .gives_point = true};
    for (const Op op : {Op::add, Op::subtract, Op::minimum, Op::maximum, Op::far_bound, Op::far_bound_inside,
                        Op::smooth_minimum, Op::guarded, Op::corner, Op::nearer})
        of(op).operands = 2;
    for (const Op op :
         {Op::add_constant, Op::constant_minus, Op::multiply_constant, Op::smooth_minimum, Op::guarded, Op::falloff})
        of(op).has_constant = true;
    constexpr auto is_long = long_ones(Primitives());
    for (std::size_t i = 0; i < Primitives::size + DataPrimitives::size; ++i)
        all[first_primitive + i].is_long_primitive =
            i >= is_long.size() || is_long[i];  // primitives with data follow; all count as long
    for (std::size_t i = first_primitive; i < first_placed + Primitives::size; ++i)
        all[i].half_instructions = all[i].is_long_primitive ? 120 : 3;  // rough estimates
    for (std::size_t i = first_map; i < first_placed; ++i) all[i].gives_point = true;
    all[first_map + index_in<FoldMap>(PointMaps())].is_fold = true;
    all[first_primitive + Primitives::size + index_in<Siren::Network>(DataPrimitives())].is_network = true;
    mark_patterns(Primitives(), all);
    mark_patterns(DataPrimitives(), all);
    return all;
}
}  // namespace

constexpr std::array<OpTraits, most_operations> op_traits = all_traits();

}  // namespace phasetree::program
