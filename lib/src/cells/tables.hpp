#pragma once

#include "cells/routines.hpp"
#include "kernel/faces.hpp"

namespace phasetree::cells {

using kernel::FaceBatch, kernel::LinearBound;

/// A box in which a ray may meet a change of phase. It fills one cache line.
struct alignas(64) InterfaceCell {
    Bounds box;
    LinearBound bound;
    /// The routine: the index of a RoutineTables::Shape, and of the routine's first entry in RoutineTables::data.
    std::uint32_t shape, first_data;
    /// Curvature::bound as CurvatureCodes: for rays in the phase of the first output, and for all other rays.
    std::uint8_t curvature, other_curvature;
    std::uint8_t first_phase;                          ///< the index of the first output's phase
    bool uses_own_component, first_component_decides;  ///< see Routine
};
static_assert(sizeof(InterfaceCell) == 64);

/// Everything that is built for an object besides its own program. This is what a cell file stores (file_format.hpp).
struct CellTables {
    std::vector<InterfaceCell> cells;
    std::size_t routine_count = 0;  ///< the number of different programs of the cells
    RoutineTables routines;
    /// The steps of the sign certificates (kernel/sign_certificate.inl), which prove that a component keeps its sign
    /// between samples.
    std::vector<PackedCertificateStep> certificates;
    /// The index in `certificates` of each cell's first step. The last element is the total number of steps.
    std::vector<std::uint32_t> first_certificate;
    /// The faces, in batches of eight, of the cells whose program is a single mesh (building/lone_mesh.hpp). Corners
    /// are counterclockwise seen from the phase of the first output.
    std::vector<FaceBatch> faces;
    /// The index in `faces` of each cell's first batch. The last element is the total number of batches. Empty if no
    /// cell has faces.
    std::vector<std::uint32_t> first_faces;
    std::size_t recorded_constants = 0;  ///< the number of constants in the object's program; those of the cells follow
    bool is_coarser = false;             ///< whether more memory would have given more cells

    std::span<const FaceBatch> faces_of(std::size_t cell) const {
        if (first_faces.empty()) return {};
        return std::span(faces).subspan(first_faces[cell], first_faces[cell + 1] - first_faces[cell]);
    }
};

}  // namespace phasetree::cells
