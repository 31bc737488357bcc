#pragma once

#include <functional>
#include <memory>

#include "cells/tables.hpp"
#include "phasetree/cells/cells.hpp"

namespace phasetree::cells {

/// The settings that determine, together with the object, which cells are built.
struct BuildSettings {
    float resolution = 0;
    PhaseSet opaque;
    int max_depth = 0;
    BuildQuality quality{};
    std::size_t max_bytes = 0;  ///< the memory limit in effect, whether given or the default
};

/// Access to the parts of InterfaceCells that read_cells(), write_cells() and are_cells_of() need.
struct CellsFile {
    struct Contents {
        const CellTables& tables;
        const Program& program;  ///< with the constants that the cells add after its own
        BuildSettings settings;
    };
    static Contents contents(const InterfaceCells&);
    /// The settings with which the cells of this object would be built. Throws ModelError.
    static BuildSettings settings(const Phased&, const CellOptions&);

    /// Returns the tables, and appends the cells' constants to those of the object's program.
    using Reader = std::function<CellTables(Program&, const BuildSettings&)>;
    /// Creates the cells of an object from tables that are read instead of built.
    static std::shared_ptr<const InterfaceCells> read(const Phased&, const CellOptions&, const Reader&);
};

}  // namespace phasetree::cells
