#include "cells/routines.hpp"

#include <algorithm>
#include <bit>
#include <ranges>

#include "phasetree_support/mixed_hash.hpp"
#include "rewriting/specialise.hpp"

namespace phasetree::cells {

using building::narrow;
using evaluation::assemble, evaluation::KeptValue;
using program::ProgramOutput, program::traits;
using rewriting::data_of_specialised;

namespace {

std::uint64_t as_one_word(std::uint64_t high, std::uint32_t low) {
    return high << 32 | low;
}

bool is_equal(const Instruction& a, const Instruction& b) {
    return a.op == b.op && a.a == b.a && a.b == b.b && a.data == b.data;
}
bool is_equal(const ProgramOutput& a, const ProgramOutput& b) {
    return a.phase == b.phase && a.value == b.value && a.negate == b.negate;
}
bool is_leaf(const CertificateStep& step) {
    return step.kind == PackedCertificateStep::leaf;
}

// Calls f with the value of each leaf of a certificate, in order. A routine must keep these values; the rest of the
// certificate does not affect it.
template <class F>
void for_each_value(std::span<const CertificateStep> certificate, F&& f) {
    for (const CertificateStep& step : certificate)
        if (is_leaf(step)) f(step.value);
}

// Whether the leaves of two certificates have the same values in the same order.
bool has_equal_values(std::span<const CertificateStep> a, std::span<const CertificateStep> b) {
    for (auto i = a.begin(), j = b.begin();; ++i, ++j) {
        i = std::find_if(i, a.end(), is_leaf);
        j = std::find_if(j, b.end(), is_leaf);
        if (i == a.end() || j == b.end()) return i == a.end() && j == b.end();
        if (i->value != j->value) return false;
    }
}

}  // namespace

std::size_t RoutineTables::bytes() const {
    return shapes.size() * sizeof(Shape) + steps.size() * sizeof(Step) + outputs.size() * sizeof(OutputSlot) +
           data.size() * sizeof(data[0]);
}

void RoutineTables::shrink_to_fit() {
    shapes.shrink_to_fit();
    steps.shrink_to_fit();
    outputs.shrink_to_fit();
    data.shrink_to_fit();
}

RoutineBuilder::Key RoutineBuilder::key_of(const CellBuffer& buffer, const CellBuffer::Cell& cell) {
    std::uint64_t hash = cell.first_component_steps;
    const auto put = [&](std::uint64_t word) { hash = support::mixed(hash, word); };
    for (const Instruction& in : buffer.code_of(cell)) {
        put(as_one_word(static_cast<std::uint32_t>(in.op), in.data));
        put(as_one_word(in.a, in.b));
    }
    for (const ProgramOutput& o : buffer.outputs_of(cell)) {
        put(as_one_word(o.phase.index, o.value));
        put(o.negate);
    }
    for_each_value(buffer.certificate_of(cell), put);
    return {&buffer, &cell, hash};
}

bool RoutineBuilder::Key::operator==(const Key& other) const {
    const auto are_equal = [](const auto& a, const auto& b) {
        return std::ranges::equal(a, b, [](const auto& x, const auto& y) { return is_equal(x, y); });
    };
    return hash == other.hash && cell->first_component_steps == other.cell->first_component_steps &&
           are_equal(buffer->code_of(*cell), other.buffer->code_of(*other.cell)) &&
           are_equal(buffer->outputs_of(*cell), other.buffer->outputs_of(*other.cell)) &&
           has_equal_values(buffer->certificate_of(*cell), other.buffer->certificate_of(*other.cell));
}

void RoutineBuilder::intern_specialised_data(CellBuffer& buffer) {
    for (Instruction& in : buffer.code) {
        if (!traits(in.op).is_specialised) continue;
        const auto data = data_of_specialised(in.op, std::span(buffer.specialised_data).subspan(in.data));
        in.data = fuse_.intern(data.data(), data.size());
    }
    buffer.specialised_data = {};
}

const RoutineBuilder::BuiltRoutine& RoutineBuilder::add(const CellBuffer& buffer, const CellBuffer::Cell& cell) {
    const Key key = key_of(buffer, cell);
    if (const auto known = built_.find(key); known != built_.end()) return known->second;
    kept_values_.clear();
    for_each_value(buffer.certificate_of(cell), [&](std::uint32_t value) { kept_values_.push_back(value); });
    return built_.emplace(key, build(buffer, cell)).first->second;
}

RoutineBuilder::BuiltRoutine RoutineBuilder::build(const CellBuffer& buffer, const CellBuffer::Cell& cell) {
    const Fuser::Fused& fused =
        fuse_(buffer.code_of(cell), buffer.outputs_of(cell), kept_values_, cell.first_component_steps);
    std::vector<ProgramOutput> outputs;
    for (ProgramOutput o : buffer.outputs_of(cell)) {
        o.value = fused.renumbered[o.value];
        outputs.push_back(o);
    }
    std::vector<KeptValue> kept;
    for (const std::uint32_t v : kept_values_) kept.push_back({fused.renumbered[v]});
    const Assembly assembly = assemble(fused.code, outputs, kept);
    const BuiltRoutine built{intern_shape(assembly, fused.prefix), narrow(tables.data.size()),
                             narrow(kept_slots_.size())};
    tables.data.insert(tables.data.end(), assembly.data.begin(), assembly.data.end());
    for (const KeptValue& k : kept) kept_slots_.push_back(k.slot);
    return built;
}

// The index of this shape in the table. Appends it unless an equal shape exists.
std::uint32_t RoutineBuilder::intern_shape(const Assembly& assembly, std::uint32_t first_component_steps) {
    std::uint64_t hash = first_component_steps;
    const auto put = [&](std::uint64_t word) { hash = support::mixed(hash, word); };
    for (const Step& s : assembly.steps) {
        put(as_one_word(s.op, s.to));
        put(as_one_word(s.a, s.b));
    }
    for (const OutputSlot& o : assembly.outputs) {
        put(as_one_word(o.slot, std::bit_cast<std::uint32_t>(o.phase)));
        put(std::bit_cast<std::uint32_t>(o.sign));
    }
    const auto is_equal_shape = [&](const RoutineTables::Shape& s) {
        return s.first_component_steps == first_component_steps && s.slots == assembly.slots &&
               std::ranges::equal(std::span(tables.steps).subspan(s.first_step, s.steps), assembly.steps) &&
               std::ranges::equal(std::span(tables.outputs).subspan(s.first_output, s.outputs), assembly.outputs);
    };
    const auto [first, end] = shapes_.equal_range(hash);
    for (auto known = first; known != end; ++known)
        if (is_equal_shape(tables.shapes[known->second])) return known->second;
    const std::uint32_t shape = narrow(tables.shapes.size());
    tables.shapes.push_back({narrow(tables.steps.size()), narrow(assembly.steps.size()), first_component_steps,
                             narrow(tables.outputs.size()), narrow(assembly.outputs.size()), assembly.slots});
    tables.steps.insert(tables.steps.end(), assembly.steps.begin(), assembly.steps.end());
    tables.outputs.insert(tables.outputs.end(), assembly.outputs.begin(), assembly.outputs.end());
    shapes_.emplace(hash, shape);
    return shape;
}

void RoutineBuilder::pack_certificate(const BuiltRoutine& routine, std::span<const CertificateStep> certificate,
                                      std::vector<PackedCertificateStep>& packed) const {
    std::size_t at = routine.first_kept;
    for (const CertificateStep& step : certificate)
        packed.push_back(step.packed(is_leaf(step) ? kept_slots_[at++] : 0));
}

}  // namespace phasetree::cells
