#include "world/kept_cells.hpp"

#include "phasetree/cells/file.hpp"

namespace phasetree::tracer {

std::shared_ptr<const InterfaceCells> kept_cells(const std::filesystem::path& file, const Phased& object,
                                                 const CellOptions& options) {
    try {
        return read_cells(file, object, options);
    } catch (const CellsFileError& e) {
        if (e.reason() == CellsFileError::Reason::foreign || e.reason() == CellsFileError::Reason::unusable) throw;
    }
    auto built = std::make_shared<const InterfaceCells>(object, options);
    write_cells(file, *built);
    return built;
}

}  // namespace phasetree::tracer
