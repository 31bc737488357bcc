// Ctrl-C, SIGTERM and a terminal that goes away (SIGHUP), turned into a question a render loop can ask.
#pragma once

#include <array>
#include <csignal>

namespace phasetree::tracer {

/// While it lives, the first SIGINT, SIGTERM or SIGHUP only makes interrupted() true, so that the image so far can be
/// written; the second ends the program at once. A signal that was ignored (nohup, a background job) stays ignored. The
/// destructor brings back the earlier handlers. One at a time: a second guard while one lives throws std::logic_error.
class InterruptGuard {
  public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

  private:
    std::array<struct sigaction, 3> previous_{};
};

/// Whether a signal has arrived since the living InterruptGuard was made; false without one.
bool interrupted();

}  // namespace phasetree::tracer
