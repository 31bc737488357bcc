#pragma once

#include <cstddef>
#include <string>

#include "phasetree/model/handle.hpp"

namespace phasetree {

/// What is wrong within a text that is a node's parameter, and where in it. A reader shows the place in the file.
class TextError : public ModelError {
  public:
    /// `offset` counts bytes from the text's first.
    TextError(const std::string& node, std::string parameter, std::size_t offset, const std::string& message)
        : ModelError(node + ": " + message + ", at character " + std::to_string(offset + 1)),
          parameter_(std::move(parameter)),
          message_(message),
          offset_(offset) {}

    const std::string& parameter() const noexcept { return parameter_; }
    /// Without the node and the place.
    const std::string& message() const noexcept { return message_; }
    std::size_t offset() const noexcept { return offset_; }

  private:
    std::string parameter_, message_;
    std::size_t offset_;
};

}  // namespace phasetree
