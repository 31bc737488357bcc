#include "cells/routines.hpp"

namespace phasetree {

const Routines::Ready& Routines::add(const Found& found, const Found::Cell& cell) {
    kept_.clear();
    for (const ProofPart& part : found.proof_of(cell))
        if (part.kind == ProofStep::leaf) kept_.push_back(part.value);
    key_.clear();
    const auto put = [&](auto... words) { (key_.push_back(static_cast<char32_t>(words)), ...); };
    for (const Instruction& in : found.code_of(cell)) put(in.op, in.a, in.b, in.data);
    for (const ProgramOutput& o : found.outputs_of(cell)) put(o.phase.index, o.value, o.negate);
    put(cell.leading, found.outputs_of(cell).size());
    for (const std::uint32_t v : kept_) put(v);
    if (const auto known = known_.find(key_); known != known_.end()) return known->second;
    return known_.emplace(key_, make(found, cell)).first->second;
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
