// Standard input, output and error, of which any may be closed, full or gone: what is lost is said where it can be, and
// nothing else is lost with it.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

namespace phasetree::tracer {

// To be called first of all. Opens those of the three that are closed on /dev/null, so that no file that is opened
// later gets their number, and is written to by messages; and has a pipe without a reader and a file that may not grow
// fail as any write does, and not end the program.
void guard_standard_streams();

// Says something to a person, on standard error. Where that cannot be written there is nobody to tell it to.
void say(std::string_view text);
template <class... T>
void say(fmt::format_string<T...> format, T&&... values) {
    say(std::string_view(fmt::format(format, std::forward<T>(values)...)));
}

// Standard output that cannot be written.
class StandardOutputError : public std::runtime_error {
  public:
    explicit StandardOutputError(int error_number);
    // Nobody reads on, as with `| head -1`: that is how it is meant, and nothing to speak of.
    bool is_broken_pipe() const { return is_broken_pipe_; }

  private:
    bool is_broken_pipe_;
};

// Writes results to standard output. Throws StandardOutputError; what is kept back for a while may fail only later, so
// that finish_output() is to be called at the end.
void put(std::string_view text);
template <class... T>
void put(fmt::format_string<T...> format, T&&... values) {
    put(std::string_view(fmt::format(format, std::forward<T>(values)...)));
}
void finish_output();

}  // namespace phasetree::tracer
