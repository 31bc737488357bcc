#pragma once

#include "cells/routines.hpp"

namespace phasetree::cells {

using kernel::LinearBound;

/// A box in which a ray may meet a change of phase. It fills one line of the processor's cache.
struct alignas(64) InterfaceCell {
    Bounds box;
    LinearBound bound;
    std::uint32_t shape, first_data;          ///< its routine
    std::uint8_t curvature, other_curvature;  ///< codes of the bounds of Curvature (curvature_code.hpp)
    std::uint8_t first_phase;                 ///< the index of the first output's phase
    bool is_by_own, is_by_first;              ///< see Curvature
};
static_assert(sizeof(InterfaceCell) == 64);

/// All that is built for an object besides its own program. A file of cells keeps this (file_format.hpp).
struct CellTables {
    std::vector<InterfaceCell> cells;
    std::size_t routine_count = 0;  ///< how many different programs the cells have
    RoutineTables routines;
    std::vector<PackedCertificateStep> certificates;
    std::vector<std::uint32_t> first_certificate;  ///< the first step of each cell's certificate, and the end
    std::size_t recorded_constants = 0;  ///< how many constants the object's program has; the cells' are behind them
    bool is_coarser = false;             ///< whether more memory would have given more cells
};

}  // namespace phasetree::cells
