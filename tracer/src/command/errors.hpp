// Errors that the user can fix on the command line.
#pragma once

#include <stdexcept>

namespace phasetree::tracer {

// A wrong option or argument. what() begins with the option where there is one.
class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// An error in what a command reads from standard input. what() begins with "<stdin>: ".
class InputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace phasetree::tracer
