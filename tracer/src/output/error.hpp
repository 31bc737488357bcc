// What output can fail with.
#pragma once

#include <stdexcept>

namespace phasetree::tracer {

/// An image file that cannot be written. The message names the path and the reason, in one line.
class OutputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A colour configuration, display or view that cannot be used. One line, with what was meant where it can be guessed.
class DisplayError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace phasetree::tracer
