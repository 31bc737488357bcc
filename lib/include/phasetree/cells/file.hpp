#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>

#include "phasetree/cells/cells.hpp"

namespace phasetree {

/// Thrown if a cell file cannot be written or read, or does not match the object. what() names the file and the reason.
class CellsFileError : public std::runtime_error {
  public:
    enum class Reason {
        missing,    ///< the file does not exist
        unusable,   ///< it cannot be opened, read or written
        foreign,    ///< it is not a cell file
        differing,  ///< it was written for another object, options, build of the library or processor architecture
        damaged     ///< its size is wrong, or its content has changed since it was written
    };
    CellsFileError(Reason reason, const std::filesystem::path&, const std::string& what);
    Reason reason() const { return reason_; }

  private:
    Reason reason_;
};

/// Write cells to a file, replacing an existing one. The file is written under a temporary name in the same folder and
/// then renamed, so it appears complete or not at all. Its content does not depend on the number of threads or
/// the SIMD instructions with which the cells were built. Throws CellsFileError.
void write_cells(const std::filesystem::path&, const InterfaceCells&);

/// Read the cells of an object. They are identical, to the last bit, to those that InterfaceCells(object, options)
/// would build. The callbacks in the options are not called.
///
/// The file identifies the object by a fingerprint of its program; names and materials do not matter. It records the
/// resolution, quality, divisions, memory limit and opaque phases for which the cells were built, the build of the
/// library, and the processor architecture. It is rejected if any of these differ, with one exception: a memory limit
/// that had no effect may be raised. Files with a wrong size, a wrong checksum or an index out of range are rejected,
/// too. The size and the header's checksum are verified before memory for the content is allocated, and the content's
/// checksum before the content is used.
///
/// Checksums detect accidents, not forgery. A forged file can describe wrong cells, but no ray reads memory outside
/// them, because every index in the file is checked.
///
/// Throws CellsFileError, and ModelError like InterfaceCells.
std::shared_ptr<const InterfaceCells> read_cells(const std::filesystem::path&, const Phased& object,
                                                 const CellOptions& options = {});

/// Whether these are the cells that InterfaceCells(object, options) would build, so that they need not be rebuilt.
/// Compares the same data as read_cells(), in about the time that it takes to compile the object into its program
/// (record() in program/program.hpp). Throws ModelError like InterfaceCells.
bool are_cells_of(const InterfaceCells&, const Phased& object, const CellOptions& options = {});

}  // namespace phasetree
