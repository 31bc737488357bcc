// Signals as flags to poll: Ctrl-C, SIGTERM and loss of the terminal (SIGHUP) interrupt a render, and SIGUSR1 requests
// a checkpoint.
#pragma once

#include <array>
#include <csignal>
#include <string>

namespace phasetree::tracer {

/// During its lifetime, the first SIGINT, SIGTERM or SIGHUP only makes interrupted() return true, so that the image so
/// far can be written. The second ends the program at once. SIGUSR1 never ends the program. A signal that was ignored
/// (nohup, a background job) stays ignored. The destructor restores the previous handlers. Only one guard may exist at
/// a time; creating a second throws std::logic_error.
class InterruptGuard {
  public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

  private:
    std::array<struct sigaction, 4> previous_{};
};

/// While it exists, within the lifetime of an InterruptGuard, the first signal ends the program at once, as does a
/// signal that has already arrived. Meant for work that leaves nothing behind, such as reading, and that does not poll
/// interrupted(). Only one may exist at a time.
class EndingAtOnce {
  public:
    struct Codes {
        int of_person;  ///< exit code after SIGINT
        int of_others;  ///< exit code after SIGTERM and SIGHUP
    };
    /// The message is written to standard error.
    EndingAtOnce(Codes codes, std::string message);
    ~EndingAtOnce();
    EndingAtOnce(const EndingAtOnce&) = delete;
    EndingAtOnce& operator=(const EndingAtOnce&) = delete;

    /// Data for the signal handler.
    struct Told {
        Codes codes;
        std::string message;
    };

  private:
    Told told_;
};

/// Whether a signal has arrived since the current InterruptGuard was created; false without a guard.
bool interrupted();
/// The signal that arrived, or 0.
int interrupting_signal();
/// From now on SIGUSR1 does not end the program, even if no checkpoint can be written yet.
void expect_checkpoint_requests();
/// Whether SIGUSR1 has arrived since the last call.
bool take_checkpoint_request();

}  // namespace phasetree::tracer
