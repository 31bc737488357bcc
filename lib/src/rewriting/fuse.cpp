#include "rewriting/fuse.hpp"

#include <array>
#include <cstring>
#include <optional>

#include "phasetree_support/mixed_hash.hpp"
#include "program/fused.hpp"
#include "program/op_traits.hpp"
#include "rewriting/affine_map_of.hpp"

namespace phasetree::rewriting {

using program::affine_map, program::first_placed, program::gives_point, program::is_long_primitive, program::operands,
    program::placed_floats, program::PlacedPrimitive;

namespace {

// The number of floats of each of these primitives.
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

std::uint32_t Fuser::intern(const void* floats, std::size_t count) {
    std::uint64_t hash = count;
    const auto* const bytes = static_cast<const std::byte*>(floats);
    for (std::size_t i = 0; i < count; ++i) {
        std::uint32_t word;
        std::memcpy(&word, bytes + i * sizeof word, sizeof word);
        hash = support::mixed(hash, word);
    }
    const auto [begin, end] = interned_.equal_range(hash);
    for (auto known = begin; known != end; ++known)
        if (known->second.count == count &&
            std::memcmp(&constants_[known->second.first], floats, count * sizeof(float)) == 0)
            return known->second.first;
    const auto first = static_cast<std::uint32_t>(constants_.size());
    constants_.resize(constants_.size() + count);
    std::memcpy(&constants_[first], floats, count * sizeof(float));
    interned_.emplace(hash, Interned{first, static_cast<std::uint32_t>(count)});
    return first;
}

// Finds which points are affine maps of other points, and which numbers are scaled primitives.
void Fuser::find_affine_values(std::span<const Instruction> code) {
    chains_.assign(code.size(), {});
    scaled_.assign(code.size(), {});
    for (std::uint32_t i = 1; i < code.size(); ++i) {
        const Instruction& in = code[i];
        if (is_map(in.op)) {
            const auto map = affine_map_of(in.op, &constants_[in.data]);
            if (!map) continue;
            const AffineChain& before = chains_[in.a];
            const auto both = before.maps > 0 ? before.map.then(*map) : std::nullopt;
            chains_[i] = both ? AffineChain{before.base, before.maps + 1, *both} : AffineChain{in.a, 1, *map};
        } else if (is_short_primitive(in.op)) {
            scaled_[i].primitive = i;
        } else if (operands(in.op) == 1 && scaled_[in.a].primitive != 0 && uses_[in.a] == 1) {
            scaled_[i] = scaled_primitive(in);
        }
    }
}

// The result of an instruction applied to its operand, a scaled primitive without other uses. A fused instruction
// multiplies once and then adds once, so the only operation that can follow an offset is a change of sign.
Fuser::ScaledPrimitive Fuser::scaled_primitive(const Instruction& in) const {
    const ScaledPrimitive& before = scaled_[in.a];
    const float c = constants_[in.data];
    const bool has_offset = before.offset != 0, has_scale = before.scale != 1 && before.scale != -1;
    if (in.op == Op::negate) return {before.primitive, -before.scale, -before.offset};
    if (in.op == Op::add_constant && !has_offset) return {before.primitive, before.scale, c};
    if (in.op == Op::constant_minus && !has_offset) return {before.primitive, -before.scale, c};
    if (in.op == Op::multiply_constant && !has_offset && !has_scale) return {before.primitive, before.scale * c, 0};
    return {};
}

// An instruction, fused with those before it where possible. Its operands have their old indices.
Instruction Fuser::fused(std::span<const Instruction> code, std::uint32_t i) {
    static constexpr auto floats_of_primitive = floats_of(Primitives());
    const Instruction& in = code[i];
    if (chains_[i].maps > 1) {
        const AffineMap& map = chains_[i].map;
        return {static_cast<Op>(affine_map), chains_[i].base, 0, intern(&map, sizeof map / sizeof(float))};
    }
    const ScaledPrimitive& scaled = scaled_[i];
    if (scaled.primitive == 0) return in;
    const Instruction& primitive = code[scaled.primitive];
    const AffineChain& chain = chains_[primitive.a];
    if (chain.maps == 0 && scaled.primitive == i) return in;
    const auto index = static_cast<std::uint32_t>(primitive.op) - static_cast<std::uint32_t>(Op::first_primitive);
    const PlacedPrimitive placed{chain.map, scaled.scale, scaled.offset};
    std::vector<float> floats(placed_floats + floats_of_primitive[index]);
    std::memcpy(floats.data(), &placed, sizeof placed);
    std::memcpy(floats.data() + placed_floats, &constants_[primitive.data], floats_of_primitive[index] * sizeof(float));
    return {static_cast<Op>(first_placed + index), chain.maps > 0 ? chain.base : primitive.a, 0,
            intern(floats.data(), floats.size())};
}

const Fuser::Fused& Fuser::operator()(std::span<const Instruction> code, std::span<const ProgramOutput> outputs,
                                      std::span<const std::uint32_t> kept, std::uint32_t prefix) {
    uses_.assign(code.size(), 0);
    is_needed_.assign(code.size(), 0);
    for (const Instruction& in : code) {
        if (operands(in.op) > 0) ++uses_[in.a];
        if (operands(in.op) > 1) ++uses_[in.b];
    }
    const auto keep = [&](std::uint32_t v) {
        uses_[v] += 2;  // A value with more than one use is never fused with its users.
        is_needed_[v] = 1;
    };
    for (const ProgramOutput& o : outputs) keep(o.value);
    for (const std::uint32_t v : kept) keep(v);
    find_affine_values(code);

    std::vector<Instruction> made(code.size());
    for (auto i = static_cast<std::uint32_t>(code.size()); i-- > 1;) {
        if (!is_needed_[i]) continue;
        made[i] = fused(code, i);
        if (operands(made[i].op) > 0) is_needed_[made[i].a] = 1;
        if (operands(made[i].op) > 1) is_needed_[made[i].b] = 1;
    }
    fused_.code.assign(1, code[0]);
    fused_.renumbered.assign(code.size(), 0);
    fused_.prefix = 0;
    for (std::uint32_t i = 1; i < code.size(); ++i) {
        if (!is_needed_[i]) continue;
        fused_.renumbered[i] = static_cast<std::uint32_t>(fused_.code.size());
        Instruction in = made[i];
        in.a = fused_.renumbered[in.a];
        in.b = fused_.renumbered[in.b];
        fused_.code.push_back(in);
        fused_.prefix += i <= prefix;
    }
    return fused_;
}

}  // namespace phasetree::rewriting
