#pragma once

#include "measuring/slice_grid.hpp"
#include "phasetree/evaluation/evaluator.hpp"

namespace phasetree::measuring {

/// Sets the vertices and loops of a slice, given the squares in doubt. Throws SlicingCancelled.
void set_outlines(Slice& result, const SliceGrid&, const Evaluator&, std::vector<GridSquare> squares,
                  const SliceOptions&);

}  // namespace phasetree::measuring
