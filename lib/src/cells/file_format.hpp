#pragma once

#include "cells/cells_file.hpp"
#include "cells/file_header.hpp"

/// The format of cell files: a header, followed by the tables one after another. Cells are stored as StoredCell, and
/// all other tables as they are in memory. The header identifies everything that differs between machines and versions,
/// so numbers need no conversion. The file does not contain the object's program. The reader compiles the object into
/// its program again (record() in program/program.hpp), which takes negligible time compared with the build, and
/// compares the program's fingerprint with the one in the file.
namespace phasetree::cells {

/// An InterfaceCell without padding. Padding bytes are undefined, so the checksum would be, too.
struct StoredCell {
    Bounds box;
    LinearBound bound;
    std::uint32_t shape, first_data;
    std::uint8_t curvature, other_curvature, first_phase, flags;
    std::uint32_t unused;

    static StoredCell of(const InterfaceCell&);
    InterfaceCell cell() const;

  private:
    /// The bits of `flags` for uses_own_component and first_component_decides.
    static constexpr unsigned by_own = 1, by_first = 2;
};

/// The size in bytes of an item of each section, in the order of CellsFileHeader::Section.
inline constexpr std::array<std::uint64_t, CellsFileHeader::sections> item_bytes{
    sizeof(StoredCell),    sizeof(RoutineTables::Shape),
    sizeof(Step),          sizeof(OutputSlot),
    sizeof(std::uint32_t), sizeof(PackedCertificateStep),
    sizeof(std::uint32_t), sizeof(FaceBatch),
    sizeof(std::uint32_t), sizeof(float)};

/// The processor architecture, without its SIMD extensions (SSE, AVX2, …), because the tables are the same for all of
/// them.
std::string_view machine();
/// The text in an array of the header. Control characters and non-ASCII bytes, which could disturb a terminal, become
/// "?".
std::string as_text(const std::array<char, 24>&);

/// The header of a file of these cells, except for the fields known only after the build: counts, checksums and whether
/// the cells are coarser. The first `recorded_constants` constants of the program are the object's.
CellsFileHeader header_of(const Program&, std::size_t recorded_constants, const BuildSettings&);

}  // namespace phasetree::cells
