#include "program/program_output.hpp"

namespace phasetree::program {

std::vector<ProgramOutput> outputs_of(const Program& program) {
    std::vector<ProgramOutput> outputs;
    for (const Output& o : program.outputs) outputs.push_back({o.phase, o.value, false});
    return outputs;
}

}  // namespace phasetree::program
