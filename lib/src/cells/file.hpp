#pragma once

#include <functional>
#include <memory>

#include "cells/tables.hpp"
#include "phasetree/cells/cells.hpp"

namespace phasetree::cells {

/// What cells were made with, beside the object. Others would be made with anything else.
struct CellsMade {
    float resolution = 0;
    PhaseSet opaque;
    int deepest = 0;
    BuildQuality quality{};
    std::size_t most_bytes = 0;  ///< the limit that held, also where none was given
};

/// Takes InterfaceCells apart and puts them together for files.
struct CellsFile {
    struct Contents {
        const CellTables& tables;
        const Program& program;  ///< with the cells' constants behind its own
        CellsMade made;
    };
    static Contents contents(const InterfaceCells&);

    /// Gives the tables, and appends the cells' constants to those of the object's program.
    using Reader = std::function<CellTables(Program&, const CellsMade&)>;
    static std::shared_ptr<const InterfaceCells> read(const Phased&, const CellOptions&, const Reader&);
};

}  // namespace phasetree::cells
