#include "rewriting/fuse.hpp"

#include <array>
#include <cstring>
#include <optional>

#include "program/fused.hpp"
#include "program/op_traits.hpp"

namespace phasetree::rewriting {

using program::affine_map, program::first_map, program::first_placed, program::gives_point, program::is_long_primitive,
    program::operands, program::placed_floats, program::PlacedPrimitive;

namespace {

/// The map of the index-th type of a list, if it is affine.
template <class... Ms>
std::optional<AffineMap> find_affine(TypeList<Ms...>, std::uint32_t index, const float* constants) {
    std::optional<AffineMap> found;
    const auto read = [&]<class M>() {
        if constexpr (AffinePointMap<M>) {
            M map;
            std::memcpy(static_cast<void*>(&map), constants, sizeof map);
            found = map.affine();
        }
    };
    std::uint32_t k = 0;
    (void)((k++ == index ? (read.template operator()<Ms>(), true) : false) || ...);
    return found;
}

template <class... Ps>
constexpr auto floats_of(TypeList<Ps...>) {
    return std::array<std::size_t, sizeof...(Ps)>{sizeof(Ps) / sizeof(float)...};
}

bool is_map(Op op) {
    return op != Op::input && gives_point(op);
}
bool is_short_primitive(Op op) {
    const auto code = static_cast<std::uint32_t>(op), first = static_cast<std::uint32_t>(Op::first_primitive);
    return code >= first && code < first + Primitives::size && !is_long_primitive(op);
}

}  // namespace

std::uint32_t Fuser::constant(const void* floats, std::size_t count) {
    std::string key(count * sizeof(float), '\0');
    std::memcpy(key.data(), floats, key.size());
    const auto [where, is_new] = known_.try_emplace(std::move(key), static_cast<std::uint32_t>(constants_.size()));
    if (is_new) {
        constants_.resize(constants_.size() + count);
        std::memcpy(&constants_[where->second], floats, count * sizeof(float));
    }
    return where->second;
}

/// What of each value is affine: before it, if it is a point; after it, if it is a primitive's distance.
void Fuser::follow(std::span<const Instruction> code) {
    frames_.assign(code.size(), {});
    groups_.assign(code.size(), {});
    for (std::uint32_t i = 1; i < code.size(); ++i) {
        const Instruction& in = code[i];
        if (is_map(in.op)) {
            const auto map =
                find_affine(PointMaps(), static_cast<std::uint32_t>(in.op) - first_map, &constants_[in.data]);
            if (!map) continue;
            const Frame& before = frames_[in.a];
            const auto both = before.maps > 0 ? before.map.then(*map) : std::nullopt;
            frames_[i] = both ? Frame{before.base, before.maps + 1, *both} : Frame{in.a, 1, *map};
            continue;
        }
        if (is_short_primitive(in.op)) {
            groups_[i].primitive = i;
            continue;
        }
        const Group& before = groups_[in.a];
        if (operands(in.op) != 1 || before.primitive == 0 || uses_[in.a] != 1) continue;
        const float c = constants_[in.data];
        const bool is_moved = before.offset != 0, is_scaled = before.scale != 1 && before.scale != -1;
        Group& g = groups_[i];
        if (in.op == Op::negate)
            g = {before.primitive, -before.scale, -before.offset};
        else if (in.op == Op::add_constant && !is_moved)
            g = {before.primitive, before.scale, c};
        else if (in.op == Op::constant_minus && !is_moved)
            g = {before.primitive, -before.scale, c};
        else if (in.op == Op::multiply_constant && !is_moved && !is_scaled)
            g = {before.primitive, before.scale * c, 0};
    }
}

/// An instruction as it was, or in one with those before it; operands are still old values.
Instruction Fuser::fused(std::span<const Instruction> code, std::uint32_t i) {
    static constexpr auto size = floats_of(Primitives());
    const Instruction& in = code[i];
    if (frames_[i].maps > 1) {
        const AffineMap& map = frames_[i].map;
        return {static_cast<Op>(affine_map), frames_[i].base, 0, constant(&map, sizeof map / sizeof(float))};
    }
    const Group& g = groups_[i];
    if (g.primitive == 0) return in;
    const Instruction& primitive = code[g.primitive];
    const Frame& frame = frames_[primitive.a];
    if (frame.maps == 0 && g.primitive == i) return in;
    const auto index = static_cast<std::uint32_t>(primitive.op) - static_cast<std::uint32_t>(Op::first_primitive);
    const PlacedPrimitive placed{frame.map, g.scale, g.offset};
    std::vector<float> floats(placed_floats + size[index]);
    std::memcpy(floats.data(), &placed, sizeof placed);
    std::memcpy(floats.data() + placed_floats, &constants_[primitive.data], size[index] * sizeof(float));
    return {static_cast<Op>(first_placed + index), frame.maps > 0 ? frame.base : primitive.a, 0,
            constant(floats.data(), floats.size())};
}

const Fuser::Fused& Fuser::operator()(std::span<const Instruction> code, std::span<const ProgramOutput> outputs,
                                      std::span<const std::uint32_t> kept, std::uint32_t leading) {
    uses_.assign(code.size(), 0);
    is_needed_.assign(code.size(), 0);
    for (const Instruction& in : code) {
        if (operands(in.op) > 0) ++uses_[in.a];
        if (operands(in.op) > 1) ++uses_[in.b];
    }
    const auto keep = [&](std::uint32_t v) {
        uses_[v] += 2;  // never in one with another
        is_needed_[v] = 1;
    };
    for (const ProgramOutput& o : outputs) keep(o.value);
    for (const std::uint32_t v : kept) keep(v);
    follow(code);

    std::vector<Instruction> made(code.size());
    for (auto i = static_cast<std::uint32_t>(code.size()); i-- > 1;) {
        if (!is_needed_[i]) continue;
        made[i] = fused(code, i);
        if (operands(made[i].op) > 0) is_needed_[made[i].a] = 1;
        if (operands(made[i].op) > 1) is_needed_[made[i].b] = 1;
    }
    fused_.code.assign(1, code[0]);
    fused_.where.assign(code.size(), 0);
    fused_.leading = 0;
    for (std::uint32_t i = 1; i < code.size(); ++i) {
        if (!is_needed_[i]) continue;
        fused_.where[i] = static_cast<std::uint32_t>(fused_.code.size());
        Instruction in = made[i];
        in.a = fused_.where[in.a];
        in.b = fused_.where[in.b];
        fused_.code.push_back(in);
        fused_.leading += i <= leading;
    }
    return fused_;
}

}  // namespace phasetree::rewriting
