#pragma once

#include "cells/cells_file.hpp"
#include "cells/file_header.hpp"

/// The format of files of cells: a header, and behind it the tables one after another, as they lie in the machine's
/// memory. What differs from machine to machine or from version to version is in the header, so that nothing needs to
/// be converted. The object's program is not in the file: it is recorded again, which takes no time beside the build,
/// and its fingerprint must be that in the file.
namespace phasetree::cells {

/// An InterfaceCell without gaps between its members, whose bytes would be undefined.
struct StoredCell {
    Bounds box;
    LinearBound bound;
    std::uint32_t shape, first_data;
    std::uint8_t curvature, other_curvature, first_phase, flags;
    std::uint32_t unused;

    static StoredCell of(const InterfaceCell&);
    InterfaceCell cell() const;

  private:
    static constexpr unsigned by_own = 1, by_first = 2;  ///< the bits of `flags`
};

/// How many bytes an item of each section has, in the order of CellsFileHeader::Section.
inline constexpr std::array<std::uint64_t, CellsFileHeader::sections> item_bytes{
    sizeof(StoredCell),    sizeof(RoutineTables::Shape),  sizeof(Step),          sizeof(OutputSlot),
    sizeof(std::uint32_t), sizeof(PackedCertificateStep), sizeof(std::uint32_t), sizeof(float)};

/// The kind of machine, which does not include its instruction set: tables are the same with any.
std::string_view machine();
/// The text in an array of the header. Control characters and bytes beyond ASCII, which could disturb a terminal, are
/// replaced by "?".
std::string as_text(const std::array<char, 24>&);

/// The header of a file of these cells, without what is known only when they are built: counts, checksums and whether
/// they are coarser. The first `own_constants` constants of the program are the object's.
CellsFileHeader header_of(const Program&, std::size_t own_constants, const BuildSettings&);

}  // namespace phasetree::cells
