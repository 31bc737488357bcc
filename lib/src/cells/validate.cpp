#include "cells/validate.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "model/local_data.hpp"
#include "phasetree/nodes/list.hpp"
#include "program/dispatch.hpp"
#include "program/fused.hpp"

namespace phasetree::cells {

using kernel::most_certificate_steps, kernel::most_faces, kernel::OutputSlot, kernel::Step;
using program::affine_map, program::first_map, program::first_placed, program::has_constant, program::OpTraits,
    program::placed_floats, program::traits;

namespace {

constexpr std::uint32_t first_primitive = static_cast<std::uint32_t>(Op::first_primitive);
constexpr std::uint32_t first_data_primitive = first_primitive + static_cast<std::uint32_t>(Primitives::size);
constexpr std::uint32_t operations = first_placed + static_cast<std::uint32_t>(Primitives::size);

// The number of constants of each operation. It is 0 for a primitive with data, whose data contain the number. A
// "placed" primitive is fused with an affine map, a scale and an offset (program/fused.hpp).
std::array<std::size_t, operations> all_floats() {
    std::array<std::size_t, operations> all{};
    for (std::uint32_t op = 0; op < first_primitive; ++op) all[op] = has_constant(static_cast<Op>(op)) ? 1 : 0;
    std::size_t primitive = first_primitive, map = first_map, placed = first_placed;
    for_each_type(Primitives(), [&]<class P>() {
        all[primitive++] = sizeof(P) / sizeof(float);
        all[placed++] = placed_floats + sizeof(P) / sizeof(float);
    });
    for_each_type(PointMaps(), [&]<class M>() { all[map++] = sizeof(M) / sizeof(float); });
    all[affine_map] = sizeof(AffineMap) / sizeof(float);
    return all;
}

bool is_known(std::uint32_t op) {
    return op > static_cast<std::uint32_t>(Op::input) && op < operations;
}
bool has_data(std::uint32_t op) {
    return op >= first_data_primitive && op < first_map;
}
// Whether a float with these upper 16 bits is not NaN.
bool is_number(std::uint16_t half) {
    return !std::isnan(std::bit_cast<float>(std::uint32_t{half} << 16));
}
bool is_phase(float phase) {
    return phase >= 0 && phase < static_cast<float>(Phase::capacity) && phase == std::floor(phase);
}
// Whether a range lies within a vector of this size.
bool fits(std::uint64_t first, std::uint64_t count, std::size_t size) {
    return first <= size && count <= size - first;
}

class Validation {
  public:
    Validation(const CellTables& t, const Program& program)
        : tables_(t), routines_(t.routines), constants_(program.constants) {
        for (const Instruction& in : program.instructions)
            if (has_data(static_cast<std::uint32_t>(in.op)))
                object_data_.push_back({static_cast<std::uint32_t>(in.op), in.data});
        std::ranges::sort(object_data_);
    }

    std::string operator()() {
        for (const RoutineTables::Shape& s : routines_.shapes)
            if (!is_valid(s)) return "a routine is invalid";
        if (tables_.first_certificate.size() != tables_.cells.size() + 1 || tables_.first_certificate.front() != 0 ||
            tables_.first_certificate.back() != tables_.certificates.size() ||
            !std::ranges::is_sorted(tables_.first_certificate))
            return "the certificate table does not match the cells";
        if (!are_faces_valid()) return "the table of faces does not match the cells";
        for (std::size_t i = 0; i < tables_.cells.size(); ++i) {
            const InterfaceCell& c = tables_.cells[i];
            if (c.shape >= routines_.shapes.size() || c.first_phase >= Phase::capacity) return "a cell is invalid";
            if (!has_constants(c)) return "a routine's constants are missing";
            if (!is_certificate(tables_.first_certificate[i], tables_.first_certificate[i + 1],
                                routines_.shapes[c.shape].slots))
                return "a certificate is invalid";
        }
        return "";
    }

  private:
    // Whether steps have written all `count` slots from `first` on.
    bool is_written(std::uint32_t first, std::uint32_t count) const {
        if (!fits(first, count, written_.size())) return false;
        return std::all_of(written_.begin() + first, written_.begin() + first + count, [](char w) { return w != 0; });
    }
    bool is_valid(const Step& s) {
        if (!is_known(s.op)) return false;
        const OpTraits& t = traits(static_cast<Op>(s.op));
        const bool takes_point = s.op >= first_primitive;
        const std::uint32_t size = t.gives_point ? 3 : 1;
        // A step that takes fewer operands refers to slot 0 for the others. Slot 0 always counts as written, because it
        // holds the input.
        if (!is_written(s.a, takes_point ? 3 : 1) || !is_written(s.b, 1)) return false;
        if (s.op >= first_placed && traits(static_cast<Op>(s.op - first_placed + first_primitive)).is_long_primitive)
            return false;
        if (!fits(s.to, size, written_.size())) return false;
        std::fill_n(written_.begin() + s.to, size, char{1});
        return true;
    }
    bool is_valid(const RoutineTables::Shape& s) {
        if (!fits(s.first_step, s.steps, routines_.steps.size()) ||
            !fits(s.first_output, s.outputs, routines_.outputs.size()))
            return false;
        // The input takes three slots, and each step writes at most three. More slots would never be written, but a
        // damaged file could demand a lot of memory with them.
        if (s.slots < 3 || s.slots > 3 + 3 * std::uint64_t{s.steps} || s.first_component_steps > s.steps) return false;
        if (s.outputs == 0 || s.outputs > Phase::capacity) return false;
        written_.assign(s.slots, 0);
        std::fill_n(written_.begin(), 3, char{1});
        for (std::uint32_t i = 0; i < s.steps; ++i)
            if (!is_valid(routines_.steps[s.first_step + i])) return false;
        for (std::uint32_t i = 0; i < s.outputs; ++i) {
            const OutputSlot& o = routines_.outputs[s.first_output + i];
            if (!is_written(o.slot, 1) || !is_phase(o.phase) || !(o.sign == 1 || o.sign == -1)) return false;
        }
        return true;
    }

    bool has_constants(const InterfaceCell& c) const {
        const RoutineTables::Shape& s = routines_.shapes[c.shape];
        if (!fits(c.first_data, s.steps, routines_.data.size())) return false;
        for (std::uint32_t i = 0; i < s.steps; ++i)
            if (!has_constants(routines_.steps[s.first_step + i].op, routines_.data[c.first_data + i])) return false;
        return true;
    }
    // Whether an operation finds its constants at an index. The length of a primitive with data depends on the data
    // themselves. So a specialised primitive (rewriting/specialise.hpp) checks its own data. Any other primitive may
    // only refer to the data of the same primitive in the object's program, which are complete.
    bool has_constants(std::uint32_t op, std::uint32_t at) const {
        static const auto floats = all_floats();
        if (!fits(at, floats[op], constants_.size())) return false;
        if (!has_data(op)) return true;
        bool is_sound = false;
        program::dispatch(DataPrimitives(), op - first_data_primitive, [&]<class P>() {
            if constexpr (CheckedData<P>)
                is_sound = P::is_sound(constants_.subspan(at));
            else
                is_sound = std::ranges::binary_search(object_data_, std::pair{op, at});
        });
        return is_sound;
    }

    // Whether each cell finds its faces, and no more than a search has room for. A cell with faces has two phases.
    bool are_faces_valid() const {
        const std::vector<std::uint32_t>& first = tables_.first_faces;
        if (first.empty()) return tables_.faces.empty();
        if (first.size() != tables_.cells.size() + 1 || first.front() != 0 || first.back() != tables_.faces.size() ||
            !std::ranges::is_sorted(first))
            return false;
        for (std::size_t i = 0; i < tables_.cells.size(); ++i) {
            const std::uint32_t batches = first[i + 1] - first[i], shape = tables_.cells[i].shape;
            if (batches == 0) continue;
            if (batches > most_faces / batch_size || shape >= routines_.shapes.size() ||
                routines_.shapes[shape].outputs != 2)
                return false;
        }
        return true;
    }

    // Whether these steps form a tree in postfix order, determined from the depth of an evaluation stack.
    bool is_certificate(std::uint32_t first, std::uint32_t end, std::uint32_t slots) const {
        if (end - first > most_certificate_steps) return false;
        std::size_t depth = 0;
        for (std::uint32_t i = first; i < end; ++i) {
            const PackedCertificateStep& s = tables_.certificates[i];
            // A leaf pushes one entry; any other step replaces two entries by one. Bounds of second derivatives may be
            // infinite but not NaN.
            if (s.kind == PackedCertificateStep::leaf) {
                if (s.slot >= slots || !is_number(s.factor) || !is_number(s.up) || !is_number(s.down)) return false;
                ++depth;
            } else {
                if (depth < 2) return false;
                --depth;
            }
        }
        return depth == 1 || first == end;
    }

    const CellTables& tables_;
    const RoutineTables& routines_;
    std::span<const float> constants_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>>
        object_data_;            // the operation and first constant of each primitive with data
    std::vector<char> written_;  // whether an earlier step has written each slot
};

}  // namespace

std::string describe_damage(const CellTables& tables, const Program& program) {
    return Validation(tables, program)();
}

}  // namespace phasetree::cells
