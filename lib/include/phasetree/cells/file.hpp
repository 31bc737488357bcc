#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>

#include "phasetree/cells/cells.hpp"

namespace phasetree {

/// Thrown for a file of cells that cannot be written or read, or does not fit the object. what() names the file and
/// says why.
class CellsFileError : public std::runtime_error {
  public:
    enum class Reason {
        missing,    ///< there is no such file
        unusable,   ///< it cannot be opened, read or written
        foreign,    ///< it is not a file of cells
        differing,  ///< it is of another object, other options, another build of the library or another machine
        damaged     ///< it is too short or long, or was changed since it was written
    };
    CellsFileError(Reason reason, const std::filesystem::path&, const std::string& what);
    Reason reason() const { return reason_; }

  private:
    Reason reason_;
};

/// Writes cells to a file, replacing one that is there. The file appears complete or not at all, because it is written
/// under a temporary name in the same directory and renamed. Throws CellsFileError.
///
/// Neither the number of threads that have built the cells nor their instruction set changes the file.
void write_cells(const std::filesystem::path&, const InterfaceCells&);

/// Reads the cells of an object. They are to the last bit those that InterfaceCells(object, options) would build; the
/// functions of the options are not called. The file says of which object it is (by its recorded program: names and
/// materials do not matter), with which resolution, quality, divisions, limit of memory and opaque phases it was built,
/// by which build of the library and for which kind of machine; it is rejected if any of these differs. A file whose
/// size or checksums are wrong is rejected before anything of its size is allocated, and so is one with an index that
/// is out of range.
///
/// The checksums find accidents. Who forges them can make cells that are wrong, but no ray reads memory outside of
/// them, because every index of the file is checked.
///
/// Throws CellsFileError, and ModelError as InterfaceCells does.
std::shared_ptr<const InterfaceCells> read_cells(const std::filesystem::path&, const Phased& object,
                                                 const CellOptions& options = {});

/// Whether cells are those that InterfaceCells(object, options) would build, so that they need not be built again.
/// Compares the same data as read_cells(), in about the time it takes to record the object.
/// Throws ModelError as InterfaceCells does.
bool are_cells_of(const InterfaceCells&, const Phased& object, const CellOptions& options = {});

}  // namespace phasetree
