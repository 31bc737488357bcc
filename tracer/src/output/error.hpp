// Errors of output.
#pragma once

#include <stdexcept>

namespace phasetree::tracer {

/// A file cannot be written. The message is one line with the path and the reason.
class OutputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A file name that no output can have, such as one with an unknown extension. Unlike other output errors, the user
/// fixes it on the command line.
class OutputNameError : public OutputError {
  public:
    using OutputError::OutputError;
};

/// An unusable colour configuration, display or view. The message is one line, with a suggestion where possible.
class DisplayError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace phasetree::tracer
