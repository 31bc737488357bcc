#pragma once

#include <algorithm>

#include "model/local_data.hpp"
#include "phasetree/nodes/list.hpp"
#include "program/dispatch.hpp"
#include "rewriting/working_program.hpp"

/// Specialisation of primitives of which only a small part matters in a small box (LocalPrimitive in
/// model/concepts.hpp). For example, a Voronoi pattern examines 125 sites per point, and in a small box nearly all of
/// them have no effect. The program of such a box uses a specialised primitive instead, whose data are the few sites
/// that matter. Its values are the same to the last bit.
namespace phasetree::rewriting {

using program::traits;

/// The largest value of a local primitive that matters in a region (pruning/required_interval.hpp). Where the primitive
/// is larger, its value need not be exact, only larger than this limit.
struct RequiredOfLocal {
    std::uint32_t source;  ///< see Specialisation::source
    float high;
};

/// What a local primitive of a program becomes in a box.
struct Specialisation {
    static constexpr std::uint32_t no_source = 0xffffffff;

    std::uint32_t value = 0;  ///< the primitive's instruction
    /// The index of the general primitive's constants. It identifies this specialisation in smaller boxes, where
    /// instructions are renumbered. It is no_source if several instructions of the program share these constants.
    std::uint32_t source = no_source;
    Op op{};                               ///< the operation of P::Specialised
    std::span<const float> data{};         ///< its data; empty if the primitive is not replaced
    unsigned half_instructions_saved = 0;  ///< the work that it saves (OpTraits::half_instructions)

    template <AnyLocalPrimitive P>
    static Specialisation of(std::span<const float> data) {
        const unsigned before = traits(program::op_of<P>()).half_instructions;
        const unsigned after = P::Specialised::half_instructions(data.data());
        return {0, no_source, program::op_of<typename P::Specialised>(), data, after < before ? before - after : 0};
    }
};

inline bool has_local_primitive(const WorkingProgram& program) {
    return std::ranges::any_of(program.code, [](const Instruction& in) { return traits(in.op).is_local; });
}

/// The program with specialised primitives instead of local ones. Their data are appended to `floats`. Such an
/// instruction (OpTraits::is_specialised) no longer refers to the whole program's constants: its index is `first` plus
/// the offset in `floats`. To evaluate the program immediately, `first` is the position of a copy of `floats` after
/// those constants (SharedConstants). In a cell that is kept, `first` is 0 until routines assign an offset to these
/// data (RoutineBuilder).
WorkingProgram specialised(const WorkingProgram&, std::span<const Specialisation>, std::vector<float>& floats,
                           Arena& scratch, std::uint32_t first = 0);

/// The data of an instruction created by specialised(), at the beginning of `floats`.
std::span<const float> data_of_specialised(Op, std::span<const float> floats);

}  // namespace phasetree::rewriting
