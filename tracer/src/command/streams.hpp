// Standard input, output and error, any of which may be closed, full or disconnected. Lost output is reported where
// possible, and nothing else is lost with it.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

namespace phasetree::tracer {

// Call this first. Opens closed standard streams on /dev/null, so that files opened later do not get their descriptors
// and receive messages. Makes writing to a pipe without a reader, or past the file size limit, fail like any other
// write instead of ending the program.
void guard_standard_streams();

// Prints a message to the user on standard error. Failures are ignored.
void say(std::string_view text);
template <class... T>
void say(fmt::format_string<T...> format, T&&... values) {
    say(std::string_view(fmt::format(format, std::forward<T>(values)...)));
}

// Standard output could not be written.
class StandardOutputError : public std::runtime_error {
  public:
    explicit StandardOutputError(int error_number);
    // Whether the reader has gone, as with `| head -1`. This is intended and not reported.
    bool is_broken_pipe() const { return is_broken_pipe_; }

  private:
    bool is_broken_pipe_;
};

// Writes results to standard output. Throws StandardOutputError. Buffered output may fail later, so call
// finish_output() at the end.
void put(std::string_view text);
template <class... T>
void put(fmt::format_string<T...> format, T&&... values) {
    put(std::string_view(fmt::format(format, std::forward<T>(values)...)));
}
void finish_output();

}  // namespace phasetree::tracer
