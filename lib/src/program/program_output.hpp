#pragma once

#include <vector>

#include "phasetree/program/program.hpp"

namespace phasetree::program {

/// An output of a cell's program: the component of a phase is the value, or minus the value if `negate` is set. Where
/// only two phases meet, one value gives both components.
struct ProgramOutput {
    Phase phase;
    std::uint32_t value = 0;
    bool negate = false;
};

/// The outputs of a whole object's program; none of them is negated.
std::vector<ProgramOutput> outputs_of(const Program&);

}  // namespace phasetree::program
