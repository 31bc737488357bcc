#pragma once

#include <optional>

#include "cells/cells_file.hpp"
#include "cells/curvature_code.hpp"
#include "phasetree/cells/cells.hpp"
#include "trace/faces.hpp"

namespace phasetree {

/// The contents of InterfaceCells: the tables of the cells, the program of the whole object, and the build settings.
struct InterfaceCells::Data : cells::CellTables {
    using Cell = cells::InterfaceCell;

    /// Sets everything that follows from the object's bounds and the options. The caller, which builds or reads the
    /// cells, sets the tables, `whole` and `build_seconds`.
    Data(const Phased& object, const CellOptions&);

    std::optional<Evaluator> whole;
    Bounds bounds;
    float resolution = 0;
    std::string warning;
    float reach = 0;
    PhaseSet opaque;
    int max_depth = 0;
    BuildQuality quality{};
    std::size_t max_bytes = 0;
    double build_seconds = 0;
    cells::CurvatureCode curvature_code;

    cells::BuildSettings settings() const { return {resolution, opaque, max_depth, quality, max_bytes}; }

    kernel::Routine routine(const Cell& c) const {
        kernel::Routine r = routines.routine(routines.shapes[c.shape], c.first_data, whole->program().constants.data());
        r.uses_own_component = c.uses_own_component;
        r.first_component_decides = c.first_component_decides;
        return r;
    }
    /// The faces of a cell that has any.
    trace::FacesOfCell faces_of_cell(const Cell& c, std::span<const kernel::FaceBatch> faces) const {
        const kernel::OutputSlot* outputs = routines.outputs.data() + routines.shapes[c.shape].first_output;
        const auto phase = [&](int i) { return Phase{static_cast<std::uint8_t>(outputs[i].phase)}; };
        return {faces, c.box, phase(0), phase(1)};
    }
    std::uint32_t slots(const Cell& c) const { return routines.shapes[c.shape].slots; }

    /// The arguments of a search along a ray within one cell.
    struct Search {
        const TracedRay& ray;
        float t_min, t_max;
        std::optional<Phase> carried;
        const std::optional<LeavingHint>& leaving_hint;
        Evaluator::Workspace* workspace;  ///< null to use the calling thread's
    };
    /// Defined in search.cpp, and called only there.
    inline std::optional<Crossing> first_crossing(std::size_t cell, const Search&, TraceCounters&) const;

  private:
    /// Whether the cell's program gives the carried phase at the start of a ray that starts in the cell.
    inline bool starts_in_phase(const Cell&, const Search&, TraceCounters&) const;
    /// Whether the ray may be in a phase for which the cell has no bound of curvature, so that the search needs the
    /// certificate.
    inline bool needs_certificate(const Cell&, const kernel::Routine&, const std::optional<Phase>& carried) const;
};

}  // namespace phasetree
