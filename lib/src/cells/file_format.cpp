#include "cells/file_format.hpp"

#include <algorithm>

#include "phasetree/nodes/list.hpp"
#include "phasetree/version.hpp"
#include "program/fused.hpp"

namespace phasetree::cells {

using kernel::few_slots, kernel::most_certificate_steps, kernel::most_faces;
using program::first_placed, program::placed_floats;

namespace {

static_assert(sizeof(StoredCell) == 64 && sizeof(Step) == 16 && sizeof(OutputSlot) == 12 &&
              sizeof(PackedCertificateStep) == 16 && sizeof(RoutineTables::Shape) == 24 && sizeof(FaceBatch) == 288);

std::array<char, 24> as_chars(std::string_view text) {
    std::array<char, 24> chars{};
    std::copy_n(text.begin(), std::min(text.size(), chars.size() - 1), chars.begin());
    return chars;
}

// A hash of everything that determines what the tables mean: the list of operations with their numbers of floats, and
// the constants on which steps and registers depend. Operations from first_placed on are primitives fused with an
// affine map, a scale and an offset (program/fused.hpp).
std::uint64_t layout_of_tables() {
    Checksum sum;
    const auto put = [&](std::uint64_t n) { sum.put(&n, sizeof n); };
    for (const std::size_t n : {batch_size, std::size_t{few_slots}, most_certificate_steps, most_faces, placed_floats,
                                std::size_t{first_placed}})
        put(n);
    const auto put_type = [&]<class T>() {
        put(sizeof(T));
        if constexpr (requires { T::info.name; }) sum.put(T::info.name.data(), T::info.name.size());
    };
    for_each_type(Primitives(), put_type);
    for_each_type(DataPrimitives(), put_type);
    for_each_type(PointMaps(), put_type);
    return sum.get();
}

// A hash of an object as recorded, with only its own constants.
std::uint64_t fingerprint(const Program& program, std::size_t recorded_constants) {
    Checksum sum;
    for (const Instruction& in : program.instructions) {
        const std::array<std::uint32_t, 4> words{static_cast<std::uint32_t>(in.op), in.a, in.b, in.data};
        sum.put(words.data(), sizeof words);
    }
    for (const Output& o : program.outputs) {
        const std::array<std::uint32_t, 2> words{o.phase.index, o.value};
        sum.put(words.data(), sizeof words);
    }
    sum.put(program.constants.data(), recorded_constants * sizeof(float));
    sum.put(program.lipschitz.data(), program.lipschitz.size() * sizeof(float));
    return sum.get();
}

}  // namespace

StoredCell StoredCell::of(const InterfaceCell& c) {
    return {c.box,
            c.bound,
            c.shape,
            c.first_data,
            c.curvature,
            c.other_curvature,
            c.first_phase,
            static_cast<std::uint8_t>((c.uses_own_component ? by_own : 0) | (c.first_component_decides ? by_first : 0)),
            0};
}

InterfaceCell StoredCell::cell() const {
    return {box,
            bound,
            shape,
            first_data,
            curvature,
            other_curvature,
            first_phase,
            (flags & by_own) != 0,
            (flags & by_first) != 0};
}

std::string_view machine() {
#if defined(__x86_64__)
    return "x86-64";
#elif defined(__aarch64__)
    return "aarch64";
#else
    return "another 64-bit machine";
#endif
}

std::string as_text(const std::array<char, 24>& chars) {
    std::string text;
    for (const char c : chars) {
        if (c == '\0') break;
        text += c >= ' ' && c < '\x7f' ? c : '?';
    }
    return text;
}

CellsFileHeader header_of(const Program& program, std::size_t recorded_constants, const BuildSettings& settings) {
    CellsFileHeader h{};
    h.magic = CellsFileHeader::known_magic;
    h.format = CellsFileHeader::known_format;
    h.byte_order = CellsFileHeader::own_byte_order;
    h.library = as_chars(build_id());
    h.machine = as_chars(machine());
    h.layout = layout_of_tables();
    h.program = fingerprint(program, recorded_constants);
    h.opaque = settings.opaque.bits;
    h.max_bytes = settings.max_bytes;
    h.resolution = settings.resolution;
    h.max_depth = settings.max_depth;
    h.quality = static_cast<std::uint32_t>(settings.quality);
    return h;
}

}  // namespace phasetree::cells
