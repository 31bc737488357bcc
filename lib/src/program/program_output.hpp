#pragma once

#include <vector>

#include "phasetree/program/program.hpp"

namespace phasetree::program {

/// An output of a program in a cell: the component of a phase is the value, or, with `negate`, minus the value. Where
/// only two phases meet one value gives both components.
struct ProgramOutput {
    Phase phase;
    std::uint32_t value = 0;
    bool negate = false;
};

/// The outputs of a whole object's program, none of them negated.
std::vector<ProgramOutput> outputs_of(const Program&);

}  // namespace phasetree::program
