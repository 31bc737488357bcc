// The exit codes of `phasetree`. The help and the manual page print this list; the reference repeats it, and a test
// compares them.
#pragma once

#include <array>
#include <csignal>
#include <string_view>

#include "output/interrupt.hpp"

namespace phasetree::tracer {

namespace exit_code {

inline constexpr int success = 0;
inline constexpr int failure = 1;
inline constexpr int usage = 2;
inline constexpr int tree_only = 3;
inline constexpr int refuted = 4;
inline constexpr int undecided = 5;
// EX_TEMPFAIL of sysexits.h, by which batch systems recognise that the job may be retried.
inline constexpr int resumable = 75;
// What shells report for a program ended by SIGINT.
inline constexpr int interrupted = 130;

}  // namespace exit_code

struct ExitCode {
    int code;
    std::string_view meaning;
};

inline constexpr std::array exit_codes{
    ExitCode{exit_code::success, "success"},
    ExitCode{exit_code::failure,
             "output cannot be written, memory or threads ran out, or SIGTERM or SIGHUP ended the command"},
    ExitCode{exit_code::usage, "the scene, another input or an option is wrong"},
    ExitCode{exit_code::tree_only, "check: the scene is valid but has no camera"},
    ExitCode{exit_code::refuted, "check --prove: a statement is refuted"},
    ExitCode{exit_code::undecided, "check --prove: a statement is undecided, and none is refuted"},
    ExitCode{exit_code::resumable, "SIGTERM or SIGHUP ended a render that --resume can continue"},
    ExitCode{exit_code::interrupted, "Ctrl-C"}};

// The exit code of a command ended by a signal. `can_resume` says whether running it again continues its work.
inline int code_of_interruption(bool can_resume) {
    if (interrupting_signal() == SIGINT) return exit_code::interrupted;
    return can_resume ? exit_code::resumable : exit_code::failure;
}

}  // namespace phasetree::tracer
