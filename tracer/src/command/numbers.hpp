#pragma once

#include <array>
#include <functional>
#include <iosfwd>
#include <stdexcept>
#include <string>

namespace phasetree::tracer {

// Standard input that is wrong; what() begins with the place, "<stdin>:line:column: ".
class InputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// Reads lines of `count` numbers, separated by blanks or commas; empty lines and lines that begin with # are passed
// over. `use` gets the numbers and the number of the line, from 1. Throws InputError for anything else, so that a
// mistake never becomes a wrong answer.
void for_each_line_of_numbers(std::istream& in, std::size_t count,
                              const std::function<void(const std::array<float, 6>&, std::size_t)>& use);

}  // namespace phasetree::tracer
