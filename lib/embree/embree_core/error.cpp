#include "embree_core/error.hpp"

#include <string>

namespace phasetree::embree {

namespace {

const char* name_of(RTCError code) {
    switch (code) {
        case RTC_ERROR_INVALID_ARGUMENT:
            return "RTC_ERROR_INVALID_ARGUMENT";
        case RTC_ERROR_INVALID_OPERATION:
            return "RTC_ERROR_INVALID_OPERATION";
        case RTC_ERROR_OUT_OF_MEMORY:
            return "RTC_ERROR_OUT_OF_MEMORY";
        case RTC_ERROR_UNSUPPORTED_CPU:
            return "RTC_ERROR_UNSUPPORTED_CPU";
        case RTC_ERROR_CANCELLED:
            return "RTC_ERROR_CANCELLED";
        default:
            return "RTC_ERROR_UNKNOWN";
    }
}

}  // namespace

EmbreeError::EmbreeError(RTCError code, const char* what)
    : std::runtime_error(std::string(what) + ": " + name_of(code)), code_(code) {}

void throw_device_error(RTCDevice device, const char* what) {
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE) throw EmbreeError(error, what);
}

}  // namespace phasetree::embree
