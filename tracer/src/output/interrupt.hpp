// Ctrl-C, SIGTERM and a terminal that goes away (SIGHUP), turned into a question a render loop can ask; and SIGUSR1,
// which asks for a checkpoint.
#pragma once

#include <array>
#include <csignal>
#include <string>

namespace phasetree::tracer {

/// While it lives, the first SIGINT, SIGTERM or SIGHUP only makes interrupted() true, so that the image so far can be
/// written; the second ends the program at once. SIGUSR1 ends nothing. A signal that was ignored (nohup, a background
/// job) stays ignored. The destructor brings back the earlier handlers. One at a time: a second guard while one lives
/// throws std::logic_error.
class InterruptGuard {
  public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

  private:
    std::array<struct sigaction, 4> previous_{};
};

/// While it lives, within the life of an InterruptGuard, the first signal ends the program at once, as does one that
/// has arrived before: for work that leaves nothing behind, such as reading, and need not ask interrupted(). One at a
/// time.
class EndingAtOnce {
  public:
    struct Codes {
        int of_person;  ///< the exit code after SIGINT
        int of_others;  ///< after the other two
    };
    /// The message is written to standard error.
    EndingAtOnce(Codes codes, std::string message);
    ~EndingAtOnce();
    EndingAtOnce(const EndingAtOnce&) = delete;
    EndingAtOnce& operator=(const EndingAtOnce&) = delete;

    /// What the signal handler needs.
    struct Told {
        Codes codes;
        std::string message;
    };

  private:
    Told told_;
};

/// Whether a signal has arrived since the living InterruptGuard was made; false without one.
bool interrupted();
/// That signal, or 0.
int interrupting_signal();
/// From now on SIGUSR1 does not end the program, whether it can be followed yet or not.
void expect_checkpoint_requests();
/// Whether SIGUSR1 has arrived since this was asked last.
bool take_checkpoint_request();

}  // namespace phasetree::tracer
