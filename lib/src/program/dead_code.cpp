#include "program/dead_code.hpp"

#include <algorithm>

#include "program/op_traits.hpp"

namespace phasetree::program {

Program without_dead_code(Program program) {
    std::vector<char> live(program.instructions.size(), 0);
    live[0] = 1;
    for (const Output& o : program.outputs) live[o.value] = 1;
    for (std::size_t i = live.size(); i-- > 1;) {
        if (!live[i]) continue;
        const Instruction& in = program.instructions[i];
        if (operands(in.op) > 0) live[in.a] = 1;
        if (operands(in.op) > 1) live[in.b] = 1;
    }
    // Avoid copying: programs may contain images.
    if (std::ranges::all_of(live, [](char is_live) { return is_live != 0; })) return program;
    std::vector<std::uint32_t> moved(live.size(), 0);  // the new index of each live value
    Program kept;
    for (std::size_t i = 0; i < live.size(); ++i) {
        if (!live[i]) continue;
        moved[i] = static_cast<std::uint32_t>(kept.instructions.size());
        Instruction in = program.instructions[i];
        const std::size_t end = i + 1 < live.size() ? program.instructions[i + 1].data : program.constants.size();
        const auto first = program.constants.begin() + in.data,
                   last = program.constants.begin() + static_cast<std::ptrdiff_t>(end);
        in.data = static_cast<std::uint32_t>(kept.constants.size());
        if (i > 0) kept.constants.insert(kept.constants.end(), first, last);
        in.a = moved[in.a];
        in.b = moved[in.b];
        kept.instructions.push_back(in);
        kept.lipschitz.push_back(program.lipschitz[i]);
    }
    for (const Output& o : program.outputs) kept.outputs.push_back({o.phase, moved[o.value]});
    return kept;
}

}  // namespace phasetree::program
