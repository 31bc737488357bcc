// Errors of output.
#pragma once

#include <stdexcept>

namespace phasetree::tracer {

/// An image file cannot be written. The message is one line with the path and the reason.
class OutputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// An unusable colour configuration, display or view. The message is one line, with a suggestion where possible.
class DisplayError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace phasetree::tracer
