#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "phasetree_support/checksum.hpp"

namespace phasetree::cells {

using support::Checksum;

/// The header of a cell file. The sections follow in order, and the file ends after the last one.
struct CellsFileHeader {
    enum Section : std::size_t {
        cells,
        shapes,
        steps,
        outputs,
        data,
        certificates,
        first_certificates,
        faces,
        first_faces,
        constants,
        sections
    };
    static constexpr std::array<char, 8> known_magic{'p', 'h', 't', 'c', 'e', 'l', 'l', 's'};
    static constexpr std::uint32_t known_format = 2, own_byte_order = 0x01020304, other_byte_order = 0x04030201;

    std::array<char, 8> magic;
    std::uint32_t format, byte_order;
    std::array<char, 24> library;  ///< the build of the library: build_id()
    std::array<char, 24> machine;
    std::uint64_t layout;   ///< layout_of_tables() in file_format.cpp
    std::uint64_t program;  ///< fingerprint() of the object's program
    std::uint64_t opaque, max_bytes;
    float resolution;
    std::int32_t max_depth;
    std::uint32_t quality, is_coarser;
    std::uint64_t routines;                      ///< CellTables::routine_count
    std::array<std::uint64_t, sections> counts;  ///< the number of items in each section
    std::uint64_t tables_checksum, header_checksum;

    std::uint64_t own_checksum() const {
        Checksum sum;
        sum.put(this, offsetof(CellsFileHeader, header_checksum));
        return sum.get();
    }
};
static_assert(sizeof(CellsFileHeader) == 8 + 2 * 4 + 2 * 24 + 4 * 8 + 4 * 4 + (1 + CellsFileHeader::sections + 2) * 8,
              "no gaps between the members");

}  // namespace phasetree::cells
