#pragma once

#include "cells/routines.hpp"
#include "kernel/faces.hpp"

namespace phasetree::cells {

using kernel::FaceBatch, kernel::LinearBound;

/// A box in which a ray may meet a change of phase. It fills one cache line.
struct alignas(64) InterfaceCell {
    Bounds box;
    LinearBound bound;
    std::uint32_t shape, first_data;                   ///< its routine
    std::uint8_t curvature, other_curvature;           ///< CurvatureCode of the bounds in Curvature
    std::uint8_t first_phase;                          ///< the index of the first output's phase
    bool uses_own_component, first_component_decides;  ///< see Curvature
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
    /// The faces of cells whose programs are a single mesh (building/lone_mesh.hpp), and the index of the first of each
    /// cell, and the end. The corners are counterclockwise seen from the phase of the first output. Both are empty if
    /// no cell has any.
    std::vector<FaceBatch> faces;
    std::vector<std::uint32_t> first_faces;
    std::size_t recorded_constants = 0;  ///< the number of constants in the object's program; those of the cells follow
    bool is_coarser = false;             ///< whether more memory would have given more cells

    std::span<const FaceBatch> faces_of(std::size_t cell) const {
        if (first_faces.empty()) return {};
        return std::span(faces).subspan(first_faces[cell], first_faces[cell + 1] - first_faces[cell]);
    }
};

}  // namespace phasetree::cells
