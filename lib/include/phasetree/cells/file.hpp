#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>

#include "phasetree/cells/cells.hpp"

namespace phasetree {

/// A file of cells that cannot be written or read, or does not fit; what() has its name and says why.
class CellsFileError : public std::runtime_error {
  public:
    enum class Reason {
        missing,    ///< there is none
        unusable,   ///< it cannot be opened, read or written
        foreign,    ///< it is something else, not a file of cells
        differing,  ///< of another object, of other options, or by another library or machine
        damaged     ///< too short or long, or changed since it was written
    };
    CellsFileError(Reason reason, const std::filesystem::path&, const std::string& what);
    Reason reason() const { return reason_; }

  private:
    Reason reason_;
};

/// Writes cells to a file that appears complete or not at all: under a temporary name in the same directory, and
/// renamed. What was there before is replaced. Throws CellsFileError.
///
/// Cells do not depend on how many threads have built them nor on their instruction set, so neither does the file.
void write_cells(const std::filesystem::path&, const InterfaceCells&);

/// Reads cells of an object, to the last bit those that InterfaceCells(object, options) would build; the options'
/// functions are not called. The file says which object it is of (by its recorded program: names and materials do not
/// matter), which resolution, quality, divisions, limit of memory and opaque phases it was built with, by which version
/// of the library and for which kind of machine; if any of these differs, it is refused. So is a file whose size or
/// checksums are not right, before anything of its size is allocated, and one whose indices lead nowhere.
///
/// The checksums find accidents. Whoever forges them can make cells that are wrong, but every index of a file is
/// checked, and rays read no memory that they should not.
///
/// Throws CellsFileError; ModelError as InterfaceCells does.
std::shared_ptr<const InterfaceCells> read_cells(const std::filesystem::path&, const Phased& object,
                                                 const CellOptions& options = {});

}  // namespace phasetree
