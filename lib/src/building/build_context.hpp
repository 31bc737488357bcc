#pragma once

#include "building/progress.hpp"
#include "phasetree/building/options.hpp"
#include "rewriting/program_context.hpp"

namespace phasetree::building {

using rewriting::ProgramContext;

/// What all steps of a build know and none of them changes. Lengths are in the scene's unit of length.
struct BuildContext {
    const CellOptions& options;
    BuildProgress& progress;
    ProgramContext program;
    float reach;  ///< how far beyond a cell's share of space its program must be right
    float size;   ///< the diagonal of the object's bounds
};

}  // namespace phasetree::building
