#pragma once

#include <cstddef>
#include <string>

#include "phasetree/model/handle.hpp"

namespace phasetree {

/// An error within a text that is a node's parameter, with its position. A reader translates it to the position in the
/// file.
class TextError : public ModelError {
  public:
    /// `offset` is in bytes from the beginning of the text.
    TextError(const std::string& node, std::string parameter, std::size_t offset, const std::string& message)
        : ModelError(node + ": " + message + ", at character " + std::to_string(offset + 1)),
          parameter_(std::move(parameter)),
          message_(message),
          offset_(offset) {}

    const std::string& parameter() const noexcept { return parameter_; }
    /// The message without the node and the position.
    const std::string& message() const noexcept { return message_; }
    std::size_t offset() const noexcept { return offset_; }

  private:
    std::string parameter_, message_;
    std::size_t offset_;
};

}  // namespace phasetree
