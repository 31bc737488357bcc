#pragma once

#include <vector>

#include "phasetree/program/program.hpp"

namespace phasetree::program {

/// An output as it comes out of a program. With `negate` the component is minus the value: where only two phases meet,
/// one value tells both.
struct ProgramOutput {
    Phase phase;
    std::uint32_t value = 0;
    bool negate = false;
};

std::vector<ProgramOutput> outputs_of(const Program&);

}  // namespace phasetree::program
