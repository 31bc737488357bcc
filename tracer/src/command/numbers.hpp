#pragma once

#include <array>
#include <functional>
#include <iosfwd>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace phasetree::tracer {

// Standard input that is wrong; what() begins with the place, "<stdin>:line:column: ".
class InputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// Reads lines of numbers, one for each of `columns`, separated by blanks or a comma. Empty lines and what follows a #
// are passed over. If the first line is a header, as CSV files have it, then it must have the columns by their names;
// cells of other columns may hold anything, and what is quoted may hold commas. So the output of `eval` can be its
// input.
//
// `use` gets the numbers and the number of the line, from 1. Throws InputError for anything else, so that a mistake
// never becomes a wrong answer.
void for_each_line_of_numbers(std::istream& in, std::span<const std::string_view> columns,
                              const std::function<void(const std::array<float, 6>&, std::size_t)>& use);

// A cell of a CSV file (RFC 4180): a name, in quotes if it holds what ends a cell.
std::string csv_cell(std::string_view text);

// Zero is written without a sign.
inline float unsigned_zero(float v) {
    return v == 0 ? 0.0f : v;
}

}  // namespace phasetree::tracer
