#pragma once

#include "cells/routines.hpp"

namespace phasetree::cells {

using kernel::LinearBound;

/// A box in which a ray may meet a change of phase. It fills one cache line.
struct alignas(64) InterfaceCell {
    Bounds box;
    LinearBound bound;
    std::uint32_t shape, first_data;          ///< its routine
    std::uint8_t curvature, other_curvature;  ///< CurvatureCode of the bounds in Curvature
    std::uint8_t first_phase;                 ///< the index of the first output's phase
    bool is_by_own, is_by_first;              ///< see Curvature
};
static_assert(sizeof(InterfaceCell) == 64);

/// Everything that is built for an object besides its own program. This is what a cell file stores (file_format.hpp).
struct CellTables {
    std::vector<InterfaceCell> cells;
    std::size_t routine_count = 0;  ///< the number of different programs of the cells
    RoutineTables routines;
    std::vector<PackedCertificateStep> certificates;
    std::vector<std::uint32_t> first_certificate;  ///< the index of the first step of each cell's certificate, and the
                                                   ///< end
    std::size_t recorded_constants = 0;  ///< the number of constants in the object's program; those of the cells follow
    bool is_coarser = false;             ///< whether more memory would have given more cells
};

}  // namespace phasetree::cells
