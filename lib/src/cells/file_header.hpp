#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "cells/checksum.hpp"

namespace phasetree::cells {

/// What a file of cells begins with; the sections follow one after another, and nothing behind them.
struct CellsFileHeader {
    enum Section : std::size_t {
        cells,
        shapes,
        steps,
        outputs,
        data,
        certificates,
        first_certificates,
        constants,
        sections
    };
    static constexpr std::array<char, 8> known_magic{'p', 'h', 't', 'c', 'e', 'l', 'l', 's'};
    static constexpr std::uint32_t known_format = 1, own_byte_order = 0x01020304, other_byte_order = 0x04030201;

    std::array<char, 8> magic;
    std::uint32_t format, byte_order;
    std::array<char, 24> library;  ///< its version
    std::array<char, 24> machine;
    std::uint64_t layout;   ///< of all that is in the tables, and the list of operations: a hash
    std::uint64_t program;  ///< of the object: a hash
    std::uint64_t opaque, most_bytes;
    float resolution;
    std::int32_t deepest;
    std::uint32_t quality, is_coarser;
    std::uint64_t routines;
    std::array<std::uint64_t, sections> counts;  ///< how many items each has
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
