#include "rewriting/first_component.hpp"

#include <algorithm>

#include "rewriting/live_set.hpp"

namespace phasetree::rewriting {

FirstComponentFirst first_component_first(const WorkingProgram& program, Arena& keep, Arena& scratch) {
    const std::size_t size = program.code.size();
    const LiveSet first(program, program.outputs.first(1), scratch);
    const std::span<std::uint32_t> renumbered = scratch.take<std::uint32_t>(size);
    const std::span<Instruction> code = keep.take<Instruction>(size);
    const std::span<float> lipschitz = keep.take<float>(size);
    const std::span<ProgramOutput> outputs = keep.copy(program.outputs);
    std::uint32_t count = 0;
    for (const bool is_first : {true, false})
        for (std::uint32_t i = 0; i < size; ++i) {
            if (first.has(i) != is_first) continue;
            const Instruction& in = program.code[i];
            renumbered[i] = count;
            code[count] = {in.op, i > 0 ? renumbered[in.a] : 0, i > 0 ? renumbered[in.b] : 0, in.data};
            lipschitz[count++] = program.lipschitz[i];
        }
    for (ProgramOutput& o : outputs) o.value = renumbered[o.value];
    return {{code, lipschitz, outputs}, static_cast<std::uint32_t>(first.size()), renumbered};
}

}  // namespace phasetree::rewriting
