#pragma once

#include <stdexcept>

#include "embree_core/embree.hpp"

namespace phasetree::embree {

/// Embree failed to create an object. Has Embree's error code, or none if Embree did not report one.
class EmbreeError : public std::runtime_error {
  public:
    EmbreeError(RTCError code, const char* what);
    RTCError code() const { return code_; }

  private:
    RTCError code_;
};

/// Throws if Embree recorded an error for the device in the calling thread.
void throw_device_error(RTCDevice device, const char* what);

}  // namespace phasetree::embree
