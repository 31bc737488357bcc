#include "rewriting/first_component.hpp"

#include <algorithm>

#include "rewriting/live_set.hpp"

namespace phasetree::rewriting {

FirstComponentFirst first_component_first(const WorkingProgram& program, const Arenas& arenas) {
    const std::size_t size = program.code.size();
    const LiveSet needed(program, program.outputs.first(1), arenas.scratch);
    const std::span<std::uint32_t> renumbered = arenas.scratch.allocate<std::uint32_t>(size);
    const std::span<Instruction> code = arenas.results.allocate<Instruction>(size);
    const std::span<float> lipschitz = arenas.results.allocate<float>(size);
    const std::span<ProgramOutput> outputs = arenas.results.copy(program.outputs);
    std::uint32_t count = 0;
    for (const bool is_needed_pass : {true, false})
        for (std::uint32_t i = 0; i < size; ++i) {
            if (needed.has(i) != is_needed_pass) continue;
            const Instruction& in = program.code[i];
            renumbered[i] = count;
            code[count] = {in.op, i > 0 ? renumbered[in.a] : 0, i > 0 ? renumbered[in.b] : 0, in.data};
            lipschitz[count++] = program.lipschitz[i];
        }
    for (ProgramOutput& o : outputs) o.value = renumbered[o.value];
    return {{code, lipschitz, outputs}, static_cast<std::uint32_t>(needed.size()), renumbered};
}

}  // namespace phasetree::rewriting
