#include "cells/routines.hpp"

#include <algorithm>
#include <ranges>

#include "cells/localise.hpp"

namespace phasetree {

namespace {

bool is_equal(const Instruction& a, const Instruction& b) {
    return a.op == b.op && a.a == b.a && a.b == b.b && a.data == b.data;
}
bool is_equal(const ProgramOutput& a, const ProgramOutput& b) {
    return a.phase == b.phase && a.value == b.value && a.negate == b.negate;
}
constexpr auto is_leaf = [](const ProofPart& part) { return part.kind == ProofStep::leaf; };

/// What a routine has to know of a proof: which values it speaks of, in which order.
auto values_of(std::span<const ProofPart> proof) {
    return proof | std::views::filter(is_leaf) | std::views::transform(&ProofPart::value);
}

}  // namespace

Routines::Key Routines::key_of(const Found& found, const Found::Cell& cell) {
    std::uint64_t hash = cell.leading;
    const auto put = [&](std::uint64_t first, std::uint64_t second) {
        hash = (hash ^ first) * 0x9e3779b97f4a7c15u + second * 0xbf58476d1ce4e5b9u;
        hash ^= hash >> 32;
    };
    const auto both = [](std::uint64_t high, std::uint32_t low) { return high << 32 | low; };
    for (const Instruction& in : found.code_of(cell))
        put(both(static_cast<std::uint32_t>(in.op), in.data), both(in.a, in.b));
    for (const ProgramOutput& o : found.outputs_of(cell)) put(both(o.phase.index, o.value), o.negate);
    for (const std::uint32_t value : values_of(found.proof_of(cell))) put(value, 1);
    return {&found, &cell, hash};
}

bool Routines::Key::operator==(const Key& other) const {
    const auto are_equal = [](const auto& a, const auto& b) {
        return std::ranges::equal(a, b, [](const auto& x, const auto& y) { return is_equal(x, y); });
    };
    return hash == other.hash && cell->leading == other.cell->leading &&
           are_equal(found->code_of(*cell), other.found->code_of(*other.cell)) &&
           are_equal(found->outputs_of(*cell), other.found->outputs_of(*other.cell)) &&
           std::ranges::equal(values_of(found->proof_of(*cell)), values_of(other.found->proof_of(*other.cell)));
}

void Routines::take_near(Found& found) {
    for (Instruction& in : found.code) {
        if (!traits(in.op).is_near) continue;
        const auto data = data_of_near(in.op, std::span(found.near).subspan(in.data));
        in.data = fuse_.constant(data.data(), data.size());
    }
    found.near = {};
}

const Routines::Ready& Routines::add(const Found& found, const Found::Cell& cell) {
    const Key key = key_of(found, cell);
    if (const auto known = known_.find(key); known != known_.end()) return known->second;
    kept_.clear();
    for (const std::uint32_t value : values_of(found.proof_of(cell))) kept_.push_back(value);
    return known_.emplace(key, make(found, cell)).first->second;
}

Routines::Ready Routines::make(const Found& found, const Found::Cell& cell) {
    const Fuser::Fused& fused = fuse_(found.code_of(cell), found.outputs_of(cell), kept_, cell.leading);
    std::vector<ProgramOutput> ends;
    for (ProgramOutput o : found.outputs_of(cell)) {
        o.value = fused.where[o.value];
        ends.push_back(o);
    }
    std::vector<KeptValue> kept;
    for (const std::uint32_t v : kept_) kept.push_back({fused.where[v]});
    const std::size_t first_step = steps.size(), first_output = outputs.size(), first_kept = kept_slots_.size();
    const std::uint32_t slots = assemble(fused.code, ends, kept, steps, outputs);
    for (const KeptValue& k : kept) kept_slots_.push_back(k.slot);
    return {Found::narrow(first_step),
            Found::narrow(steps.size() - first_step),
            fused.leading,
            Found::narrow(first_output),
            Found::narrow(ends.size()),
            slots,
            Found::narrow(first_kept)};
}

void Routines::add_proof(const Ready& ready, std::span<const ProofPart> proof, std::vector<ProofStep>& proofs) const {
    std::size_t at = ready.first_kept;
    for (const ProofPart& part : proof)
        proofs.push_back(part.step(part.kind == ProofStep::leaf ? kept_slots_[at++] : 0));
}

}  // namespace phasetree
