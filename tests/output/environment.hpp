#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace phasetree::tracer::test {

/// $OCIO as given (nullopt: unset) while it lives; whoever runs the tests may have one.
class OcioVariable {
  public:
    explicit OcioVariable(const std::optional<std::string>& value = std::nullopt) {
        if (const char* old = std::getenv("OCIO")) previous_ = old;
        set(value);
    }
    ~OcioVariable() { set(previous_); }
    OcioVariable(const OcioVariable&) = delete;
    OcioVariable& operator=(const OcioVariable&) = delete;

  private:
    static void set(const std::optional<std::string>& value) {
        if (value) {
            ::setenv("OCIO", value->c_str(), 1);
        } else {
            ::unsetenv("OCIO");
        }
    }
    std::optional<std::string> previous_;
};

/// The message of the exception of type Error that f throws; a note where it throws none or another.
template <class Error, class F>
std::string message_of(F&& f) {
    try {
        f();
    } catch (const Error& error) {
        return error.what();
    } catch (...) {
        return "(an exception of another type)";
    }
    return "(no exception)";
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace phasetree::tracer::test
