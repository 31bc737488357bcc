#pragma once

#include <algorithm>

#include "phasetree/nodes/list.hpp"
#include "rewriting/working_program.hpp"

namespace phasetree::rewriting {

using program::traits;

/// A LocalPrimitive of a program, and what it becomes in a box: nothing if that is no gain.
struct LocalValue {
    static constexpr std::uint32_t no_source = 0xffffffff;

    std::uint32_t value = 0;
    std::uint32_t source = no_source;  ///< where the primitive's constants are, if no other value has the same
    Op op{};                           ///< of P::Specialised
    std::span<const float> data{};
    unsigned half_works_saved = 0;

    template <LocalPrimitive P>
    static LocalValue of(std::span<const float> data) {
        constexpr auto first = static_cast<std::size_t>(Op::first_primitive);
        constexpr std::size_t before = first + index_in<P>(Primitives());
        constexpr std::size_t near = first + Primitives::size + index_in<typename P::Specialised>(DataPrimitives());
        const unsigned all = traits(static_cast<Op>(before)).half_works, now = P::Specialised::half_works(data.data());
        return {0, no_source, static_cast<Op>(near), data, now < all ? all - now : 0};
    }
};

inline bool has_local_primitive(const WorkingProgram& program) {
    return std::ranges::any_of(program.code, [](const Instruction& in) { return traits(in.op).is_local; });
}

/// The program with them in their places, and their data appended to `floats`: there such an instruction's data start.
WorkingProgram specialised(const WorkingProgram&, std::span<const LocalValue>, std::vector<float>& floats,
                           Arena& scratch);

/// How large the features of a program's patterns are, at the least; endless if it has none.
float finest_pattern(const WorkingProgram&, std::span<const float> constants);

/// The data of an instruction that specialised() has made.
std::span<const float> data_of_specialised(Op, std::span<const float> floats);

}  // namespace phasetree::rewriting
