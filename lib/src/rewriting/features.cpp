#include "rewriting/features.hpp"

#include <algorithm>
#include <cstring>

#include "rewriting/data_primitive.hpp"

namespace phasetree::rewriting {

float finest_pattern(const WorkingProgram& program, std::span<const float> constants) {
    float finest = Bounds::infinity;
    for (const Instruction& in : program.code) {
        if (!traits(in.op).is_pattern) continue;
        with_data_primitive(in.op, [&]<class P>() {
            if constexpr (PatternDataPrimitive<P>)
                finest = std::min(finest, P::period(&constants[in.data]) / program.lipschitz[in.a]);
        });
        const auto op = static_cast<std::uint32_t>(in.op) - static_cast<std::uint32_t>(Op::first_primitive);
        program::dispatch(Primitives(), op, [&]<class P>() {
            if constexpr (PatternPrimitive<P>) {
                P primitive;
                std::memcpy(static_cast<void*>(&primitive), &constants[in.data], sizeof primitive);
                finest = std::min(finest, primitive.period() / program.lipschitz[in.a]);
            }
        });
    }
    return finest;
}

float finest_spacing(const WorkingProgram& program, std::span<const float> constants) {
    float finest = Bounds::infinity;
    for (const Instruction& in : program.code)
        with_data_primitive(in.op, [&]<class P>() {
            if constexpr (PrimitiveOfParts<P>)
                finest = std::min(finest, P::spacing(&constants[in.data]) / program.lipschitz[in.a]);
        });
    return finest;
}

float work_of_parts(const WorkingProgram& program, std::span<const Specialisation> specialisations) {
    unsigned halves = 0;
    for (const Specialisation& s : specialisations)
        with_data_primitive(program.code[s.value].op, [&]<class P>() {
            if constexpr (PrimitiveOfParts<P>) halves += P::Specialised::half_instructions(s.data.data());
        });
    return 0.5f * static_cast<float>(halves);
}

}  // namespace phasetree::rewriting
