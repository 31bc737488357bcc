#include "command/streams.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <system_error>

namespace phasetree::tracer {

void guard_standard_streams() {
    for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor) {
        if (::fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
        // open() takes the lowest free descriptor, which is this one. A closed standard output remains unwritable.
        (void)::open("/dev/null", descriptor == STDERR_FILENO ? O_WRONLY : O_RDONLY);
    }
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

void say(std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stderr);
}

StandardOutputError::StandardOutputError(int error_number)
    : std::runtime_error("cannot write standard output: " + std::generic_category().message(error_number)),
      is_broken_pipe_(error_number == EPIPE) {}

void put(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) throw StandardOutputError(errno);
}

void finish_output() {
    if (std::fflush(stdout) != 0) throw StandardOutputError(errno);
}

}  // namespace phasetree::tracer
