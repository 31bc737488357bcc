// Numbers that `eval` and `trace` read and write.
#pragma once

#include <array>
#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>

#include "phasetree/io/number_table.hpp"

namespace phasetree::tracer {

// Reads a table with these columns, at most six. Calls `use` with the numbers of each row, and with the table, which
// can create errors located at a cell. The input may be output of `eval`. Throws SceneError located in "<stdin>" if the
// table is malformed.
void for_each_row(std::istream& in, std::span<const NumberTable::Column> columns,
                  const std::function<void(const std::array<float, 6>&, const NumberTable&)>& use);

// Formats a name as a cell of a CSV file (RFC 4180), quoted if it contains special characters.
std::string csv_cell(std::string_view text);

// Replaces −0 by 0.
inline float unsigned_zero(float v) {
    return v == 0 ? 0.0f : v;
}

}  // namespace phasetree::tracer
