#include "rewriting/live_set.hpp"

namespace phasetree::rewriting {

LiveSet::LiveSet(const WorkingProgram& program, std::span<const ProgramOutput> outputs, Arena& scratch)
    : program_(program), outputs_(outputs), is_live_(scratch.allocate<char>(program.code.size())) {
    std::ranges::fill(is_live_, char{0});
    for (const ProgramOutput& o : outputs) is_live_[o.value] = 1;
    for (std::size_t i = program.code.size(); i-- > 1;) {
        if (!is_live_[i]) continue;
        ++size_;
        is_live_[program.code[i].a] = 1;
        is_live_[program.code[i].b] = 1;
    }
}

WorkingProgram LiveSet::program(const Arenas& arenas) const {
    Arena& results = arenas.results;
    if (size_ + 1 == program_.code.size())
        return {results.copy(program_.code), results.copy(program_.lipschitz), results.copy(outputs_)};
    const std::span<std::uint32_t> renumbered = arenas.scratch.allocate<std::uint32_t>(program_.code.size());
    const std::span<Instruction> code = results.allocate<Instruction>(size_ + 1);
    const std::span<float> lipschitz = results.allocate<float>(size_ + 1);
    const std::span<ProgramOutput> outputs = results.allocate<ProgramOutput>(outputs_.size());
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < program_.code.size(); ++i) {
        renumbered[i] = count;
        if (i > 0 && !is_live_[i]) continue;
        const Instruction& in = program_.code[i];
        code[count] = {in.op, renumbered[in.a], renumbered[in.b], in.data};
        lipschitz[count++] = program_.lipschitz[i];
    }
    for (std::size_t k = 0; k < outputs_.size(); ++k)
        outputs[k] = {outputs_[k].phase, renumbered[outputs_[k].value], outputs_[k].negate};
    return {code, lipschitz, outputs};
}

}  // namespace phasetree::rewriting
