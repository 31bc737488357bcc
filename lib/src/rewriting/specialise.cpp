#include "rewriting/specialise.hpp"

#include <algorithm>
#include <cstring>

#include "program/dispatch.hpp"

namespace phasetree::rewriting {

namespace {

// Calls f<P>() if the operation is a primitive P with data.
template <class F>
void with_data_primitive(Op op, F&& f) {
    const auto first = static_cast<std::uint32_t>(Op::first_primitive) + static_cast<std::uint32_t>(Primitives::size);
    program::dispatch(DataPrimitives(), static_cast<std::uint32_t>(op) - first, f);
}

}  // namespace

WorkingProgram specialised(const WorkingProgram& program, std::span<const Specialisation> values,
                           std::vector<float>& floats, Arena& scratch, std::uint32_t first) {
    if (values.empty()) return program;
    const std::span<Instruction> code = scratch.copy(program.code);
    for (const Specialisation& v : values) {
        code[v.value].op = v.op;
        code[v.value].data = first + static_cast<std::uint32_t>(floats.size());
        floats.insert(floats.end(), v.data.begin(), v.data.end());
    }
    WorkingProgram result = program;
    result.code = code;
    return result;
}

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

std::span<const float> data_of_specialised(Op op, std::span<const float> floats) {
    std::size_t count = 0;
    with_data_primitive(op, [&]<class D>() {
        if constexpr (requires { D::floats(floats.data()); }) count = D::floats(floats.data());
    });
    return floats.first(count);
}

}  // namespace phasetree::rewriting
