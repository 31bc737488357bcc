#pragma once

#include <stdexcept>

#include "embree_core/embree.hpp"

namespace phasetree::embree {

/// Thrown if Embree fails. The code is Embree's, or RTC_ERROR_NONE if it reports none.
class EmbreeError : public std::runtime_error {
  public:
    EmbreeError(RTCError code, const char* what);
    RTCError code() const { return code_; }

  private:
    RTCError code_;
};

/// Throw the error, if any, of the thread's last Embree calls for the device.
void throw_device_error(RTCDevice device, const char* what);

}  // namespace phasetree::embree
