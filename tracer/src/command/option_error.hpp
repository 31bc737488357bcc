#pragma once

#include <stdexcept>

namespace phasetree::tracer {

// An option that is wrong by itself, with other options or for the scene. The message is one line that names it.
class OptionError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace phasetree::tracer
