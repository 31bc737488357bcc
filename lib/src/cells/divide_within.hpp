#pragma once

#include "cells/divide.hpp"

namespace phasetree {

struct FoundWithin {
    FoundPieces found;
    bool is_coarser = false;  ///< than it would be with more memory
};

/// Cuts a box into cells that take no more than so many bytes, or into one; the result does not depend on the number of
/// threads. Throws BuildCancelled.
FoundWithin divide_within(std::size_t bytes, const Bounds&, const WorkingProgram&, const Division&);

}  // namespace phasetree
