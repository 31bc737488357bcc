#pragma once

#include "building/progress.hpp"
#include "phasetree/building/options.hpp"
#include "rewriting/program_context.hpp"

namespace phasetree::building {

using rewriting::ProgramContext;

/// What every step of dividing an object into cells needs to know and none of them changes.
struct BuildContext {
    const CellOptions& options;
    BuildProgress& progress;
    ProgramContext program;
    float reach;  ///< how far beyond its share of space a cell's program must be right
    float size;   ///< the diagonal of the object's bounds
};

}  // namespace phasetree::building
