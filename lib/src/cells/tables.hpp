#pragma once

#include "building/routines.hpp"

namespace phasetree::cells {

using building::RoutineTables;
using kernel::LinearBound, kernel::PackedCertificateStep;

/// Where a ray may meet a change of phase: one line of the cache.
struct alignas(64) InterfaceCell {
    Bounds box;
    LinearBound bound;
    std::uint32_t shape, first_data;
    std::uint8_t curvature, other_curvature, first_phase;
    bool is_by_own, is_by_first;
};
static_assert(sizeof(InterfaceCell) == 64);

/// All that is built for an object beside its own program: what a file of cells keeps (file.cpp).
struct CellTables {
    std::vector<InterfaceCell> cells;
    std::size_t routine_count = 0;
    RoutineTables routines;
    std::vector<PackedCertificateStep> certificates;
    std::vector<std::uint32_t> first_certificate;  ///< of each cell, and the end
    std::size_t recorded_constants = 0;            ///< of the program's: those behind them are the cells'
    bool is_coarser = false;                       ///< for want of memory
};

}  // namespace phasetree::cells
