#pragma once

#include <stdexcept>

#include "embree_core/embree.hpp"

namespace phasetree::embree {

/// Embree refused to make something: which error it gave, or none if it does not tell.
class EmbreeError : public std::runtime_error {
  public:
    EmbreeError(RTCError code, const char* what);
    RTCError code() const { return code_; }

  private:
    RTCError code_;
};

/// Throws what the thread's last calls of Embree for the device have to complain of.
void throw_device_error(RTCDevice device, const char* what);

}  // namespace phasetree::embree
