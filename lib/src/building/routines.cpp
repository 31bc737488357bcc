#include "building/routines.hpp"

#include <algorithm>
#include <bit>
#include <ranges>

#include "rewriting/specialise.hpp"

namespace phasetree::building {

using evaluation::assemble, evaluation::KeptValue;
using program::traits;
using rewriting::data_of_specialised;

namespace {

bool is_equal(const Instruction& a, const Instruction& b) {
    return a.op == b.op && a.a == b.a && a.b == b.b && a.data == b.data;
}
/// Of words, two at a time.
class Hash64 {
  public:
    explicit Hash64(std::uint64_t start) : hash_(start) {}
    void put(std::uint64_t first, std::uint64_t second) {
        hash_ = (hash_ ^ first) * 0x9e3779b97f4a7c15u + second * 0xbf58476d1ce4e5b9u;
        hash_ ^= hash_ >> 32;
    }
    std::uint64_t get() const { return hash_; }

  private:
    std::uint64_t hash_;
};
std::uint64_t both(std::uint64_t high, std::uint32_t low) {
    return high << 32 | low;
}

bool is_equal(const ProgramOutput& a, const ProgramOutput& b) {
    return a.phase == b.phase && a.value == b.value && a.negate == b.negate;
}
bool is_leaf(const CertificateStep& part) {
    return part.kind == PackedCertificateStep::leaf;
}

/// What a routine has to know of a certificate: calls f(value) for the values that it speaks of, in its order.
template <class F>
void for_each_value(std::span<const CertificateStep> certificate, F&& f) {
    for (const CertificateStep& part : certificate)
        if (is_leaf(part)) f(part.value);
}

/// Whether two certificates speak of the same values in the same order.
bool has_equal_values(std::span<const CertificateStep> a, std::span<const CertificateStep> b) {
    for (auto i = a.begin(), j = b.begin();; ++i, ++j) {
        i = std::find_if(i, a.end(), is_leaf);
        j = std::find_if(j, b.end(), is_leaf);
        if (i == a.end() || j == b.end()) return i == a.end() && j == b.end();
        if (i->value != j->value) return false;
    }
}

}  // namespace

Routines::Key Routines::key_of(const CellBuffer& found, const CellBuffer::Cell& cell) {
    Hash64 hash(cell.leading);
    for (const Instruction& in : found.code_of(cell))
        hash.put(both(static_cast<std::uint32_t>(in.op), in.data), both(in.a, in.b));
    for (const ProgramOutput& o : found.outputs_of(cell)) hash.put(both(o.phase.index, o.value), o.negate);
    for_each_value(found.certificate_of(cell), [&](std::uint32_t value) { hash.put(value, 1); });
    return {&found, &cell, hash.get()};
}

bool Routines::Key::operator==(const Key& other) const {
    const auto are_equal = [](const auto& a, const auto& b) {
        return std::ranges::equal(a, b, [](const auto& x, const auto& y) { return is_equal(x, y); });
    };
    return hash == other.hash && cell->leading == other.cell->leading &&
           are_equal(found->code_of(*cell), other.found->code_of(*other.cell)) &&
           are_equal(found->outputs_of(*cell), other.found->outputs_of(*other.cell)) &&
           has_equal_values(found->certificate_of(*cell), other.found->certificate_of(*other.cell));
}

void Routines::take_specialised_data(CellBuffer& found) {
    for (Instruction& in : found.code) {
        if (!traits(in.op).is_specialised) continue;
        const auto data = data_of_specialised(in.op, std::span(found.specialised_data).subspan(in.data));
        in.data = fuse_.constant(data.data(), data.size());
    }
    found.specialised_data = {};
}

const Routines::Ready& Routines::add(const CellBuffer& found, const CellBuffer::Cell& cell) {
    const Key key = key_of(found, cell);
    if (const auto known = known_.find(key); known != known_.end()) return known->second;
    kept_.clear();
    for_each_value(found.certificate_of(cell), [&](std::uint32_t value) { kept_.push_back(value); });
    return known_.emplace(key, make(found, cell)).first->second;
}

Routines::Ready Routines::make(const CellBuffer& found, const CellBuffer::Cell& cell) {
    const Fuser::Fused& fused = fuse_(found.code_of(cell), found.outputs_of(cell), kept_, cell.leading);
    std::vector<ProgramOutput> ends;
    for (ProgramOutput o : found.outputs_of(cell)) {
        o.value = fused.where[o.value];
        ends.push_back(o);
    }
    std::vector<KeptValue> kept;
    for (const std::uint32_t v : kept_) kept.push_back({fused.where[v]});
    const Assembly assembly = assemble(fused.code, ends, kept);
    const Ready ready{shape_of(assembly, fused.leading), CellBuffer::narrow(tables.data.size()),
                      CellBuffer::narrow(kept_slots_.size())};
    tables.data.insert(tables.data.end(), assembly.data.begin(), assembly.data.end());
    for (const KeptValue& k : kept) kept_slots_.push_back(k.slot);
    return ready;
}

std::uint32_t Routines::shape_of(const Assembly& assembly, std::uint32_t leading) {
    Hash64 hash(leading);
    for (const Step& s : assembly.steps) hash.put(both(s.op, s.to), both(s.a, s.b));
    for (const OutputSlot& o : assembly.outputs)
        hash.put(both(o.slot, std::bit_cast<std::uint32_t>(o.phase)), std::bit_cast<std::uint32_t>(o.sign));
    const auto is_it = [&](const RoutineTables::Shape& s) {
        return s.leading == leading && s.slots == assembly.slots &&
               std::ranges::equal(std::span(tables.steps).subspan(s.first_step, s.steps), assembly.steps) &&
               std::ranges::equal(std::span(tables.outputs).subspan(s.first_output, s.outputs), assembly.outputs);
    };
    const auto [first, end] = shapes_.equal_range(hash.get());
    for (auto known = first; known != end; ++known)
        if (is_it(tables.shapes[known->second])) return known->second;
    const std::uint32_t shape = CellBuffer::narrow(tables.shapes.size());
    tables.shapes.push_back({CellBuffer::narrow(tables.steps.size()), CellBuffer::narrow(assembly.steps.size()),
                             leading, CellBuffer::narrow(tables.outputs.size()),
                             CellBuffer::narrow(assembly.outputs.size()), assembly.slots});
    tables.steps.insert(tables.steps.end(), assembly.steps.begin(), assembly.steps.end());
    tables.outputs.insert(tables.outputs.end(), assembly.outputs.begin(), assembly.outputs.end());
    shapes_.emplace(hash.get(), shape);
    return shape;
}

void Routines::add_certificate(const Ready& ready, std::span<const CertificateStep> certificate,
                               std::vector<PackedCertificateStep>& certificates) const {
    std::size_t at = ready.first_kept;
    for (const CertificateStep& part : certificate)
        certificates.push_back(part.step(part.kind == PackedCertificateStep::leaf ? kept_slots_[at++] : 0));
}

}  // namespace phasetree::building
