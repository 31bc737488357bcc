#pragma once

#include <array>
#include <functional>
#include <iosfwd>
#include <string>

namespace phasetree::tracer {

// Reads lines of `count` numbers, separated by blanks or commas; empty lines and lines that begin with # are passed
// over. Throws std::runtime_error naming the line for anything else, so that a mistake never becomes a wrong answer.
void for_each_line_of_numbers(std::istream& in, std::size_t count,
                              const std::function<void(const std::array<float, 6>&)>& use);

}  // namespace phasetree::tracer
