#pragma once

#include <functional>
#include <memory>

#include "cells/tables.hpp"
#include "phasetree/cells/cells.hpp"

namespace phasetree::cells {

/// What decides, besides the object, which cells are built. Cells of other settings would be others.
struct BuildSettings {
    float resolution = 0;
    PhaseSet opaque;
    int deepest = 0;
    BuildQuality quality{};
    std::size_t most_bytes = 0;  ///< the limit of memory that held, also where none was given
};

/// A door to what of InterfaceCells only reading, writing and comparing of files of cells may see.
struct CellsFile {
    struct Contents {
        const CellTables& tables;
        const Program& program;  ///< with the cells' constants behind its own
        BuildSettings settings;
    };
    static Contents contents(const InterfaceCells&);
    /// What building the cells of an object with these options would have. Throws ModelError.
    static BuildSettings settings(const Phased&, const CellOptions&);

    /// Returns the tables, and appends the cells' constants to those of the object's program.
    using Reader = std::function<CellTables(Program&, const BuildSettings&)>;
    /// The cells of an object, whose tables are read and not built.
    static std::shared_ptr<const InterfaceCells> read(const Phased&, const CellOptions&, const Reader&);
};

}  // namespace phasetree::cells
