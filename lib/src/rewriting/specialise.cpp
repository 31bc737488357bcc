#include "rewriting/specialise.hpp"

#include "rewriting/data_primitive.hpp"

namespace phasetree::rewriting {

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

std::span<const float> data_of_specialised(Op op, std::span<const float> floats) {
    std::size_t count = 0;
    with_data_primitive(op, [&]<class D>() {
        if constexpr (requires { D::floats(floats.data()); }) count = D::floats(floats.data());
    });
    return floats.first(count);
}

}  // namespace phasetree::rewriting
