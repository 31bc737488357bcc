#pragma once

#include "building/progress.hpp"
#include "phasetree/building/options.hpp"
#include "rewriting/program_context.hpp"

namespace phasetree::building {

using rewriting::ProgramContext;

/// Constant data of a build, shared by all its steps. Lengths are in scene units.
struct BuildContext {
    const CellOptions& options;
    BuildProgress& progress;
    ProgramContext program;
    float reach;  ///< how far beyond a node's box its program must be valid
    float size;   ///< the diagonal of the object's bounds
};

}  // namespace phasetree::building
