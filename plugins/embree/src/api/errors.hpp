#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "phasetree/phasetree_embree.h"

namespace phasetree::embree::api {

/// A failed call, until it leaves the library as an error code and a message.
class ApiError : public std::runtime_error {
  public:
    ApiError(PhasetreeError code, const std::string& message) : std::runtime_error(message), code_(code) {}
    PhasetreeError code() const { return code_; }

  private:
    PhasetreeError code_;
};

template <class... Args>
ApiError invalid(fmt::format_string<Args...> text, Args&&... args) {
    return {PHASETREE_ERROR_INVALID_ARGUMENT, fmt::format(text, std::forward<Args>(args)...)};
}

/// Throws if a required pointer is NULL.
inline void require(const void* pointer, const char* name) {
    if (!pointer) throw invalid("{} is NULL", name);
}
/// Throws if the application was compiled for another version of the interface.
void require_version(unsigned api_version);

/// Returns the code of the current exception, and stores its message for the thread.
PhasetreeError report_exception(const char* call) noexcept;

/// Runs a call's body. No exception escapes.
template <class F>
PhasetreeError guarded_call(const char* call, F&& body) noexcept {
    try {
        body();
        return PHASETREE_ERROR_NONE;
    } catch (...) {
        return report_exception(call);
    }
}

}  // namespace phasetree::embree::api
