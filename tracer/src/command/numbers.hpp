#pragma once

#include <array>
#include <functional>
#include <iosfwd>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "phasetree/io/number_table.hpp"

namespace phasetree::tracer {

// What is wrong with the command's input or options; what() begins with where, "<stdin>: " or "--option: ".
class InputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// Reads a table with these columns, at most six, and calls `use` with the numbers of each row and with the table, which
// makes errors at a cell. The output of `eval` can be its input. Throws SceneError, with the place in "<stdin>", for
// anything that is no such table.
void for_each_row(std::istream& in, std::span<const NumberTable::Column> columns,
                  const std::function<void(const std::array<float, 6>&, const NumberTable&)>& use);

// A cell of a CSV file (RFC 4180): a name, in quotes if it holds what ends a cell.
std::string csv_cell(std::string_view text);

// Zero is written without a sign.
inline float unsigned_zero(float v) {
    return v == 0 ? 0.0f : v;
}

}  // namespace phasetree::tracer
