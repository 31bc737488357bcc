#include "output/interrupt.hpp"

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace test_interrupt {

using namespace phasetree::tracer;

namespace {

// The signal a child dies of that runs f, or 0.
template <class F>
int deadly_signal(F&& f) {
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        const rlimit no_core{0, 0};
        setrlimit(RLIMIT_CORE, &no_core);
        std::signal(SIGINT, SIG_DFL);
        std::signal(SIGTERM, SIG_DFL);
        std::signal(SIGHUP, SIG_DFL);
        f();
        ::_exit(0);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

}  // namespace

TEST_CASE("the first signal is a question, for a guard's life only") {
    CHECK_FALSE(interrupted());
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        {
            const InterruptGuard guard;
            CHECK_FALSE(interrupted());
            std::raise(signal);
            CHECK(interrupted());
            CHECK_THROWS_AS(InterruptGuard{}, std::logic_error);
            CHECK(interrupted());
        }
        CHECK_FALSE(interrupted());
    }
}

TEST_CASE("after the first signal all have their default action, which ends the program") {
    const InterruptGuard guard;
    std::raise(SIGTERM);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction current {};
        sigaction(signal, nullptr, &current);
        const bool is_default = current.sa_handler == SIG_DFL;
        CHECK(is_default);
    }
}

// The thread sanitizer switches itself half off in the child of a process with threads, signals included.
#ifdef __SANITIZE_THREAD__
constexpr bool signals_work_in_children = false;
#else
constexpr bool signals_work_in_children = true;
#endif

TEST_CASE("the second signal ends the program at once" * doctest::skip(!signals_work_in_children)) {
    CHECK(deadly_signal([] {
              const InterruptGuard guard;
              std::raise(SIGINT);
          }) == 0);
    CHECK(deadly_signal([] {
              const InterruptGuard guard;
              std::raise(SIGINT);
              std::raise(SIGINT);
          }) == SIGINT);
    CHECK(deadly_signal([] {
              const InterruptGuard guard;
              std::raise(SIGINT);
              std::raise(SIGTERM);
          }) == SIGTERM);
}

TEST_CASE("afterwards the earlier handlers are back") {
    CHECK(deadly_signal([] {
              { const InterruptGuard guard; }
              std::raise(SIGTERM);
          }) == SIGTERM);
}

TEST_CASE("a signal that was ignored stays ignored") {
    CHECK(deadly_signal([] {
              std::signal(SIGINT, SIG_IGN);
              const InterruptGuard guard;
              std::raise(SIGINT);
              if (interrupted()) ::abort();
              std::raise(SIGINT);
          }) == 0);
}

namespace {

struct Ended {
    int code = -1;
    std::string err;
};

// How a child ends that runs f and then exits with 0.
template <class F>
Ended end_of(F&& f) {
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        ::dup2(ends[1], STDERR_FILENO);
        f();
        ::_exit(0);
    }
    ::close(ends[1]);
    Ended ended;
    char c = 0;
    while (::read(ends[0], &c, 1) == 1) ended.err += c;
    ::close(ends[0]);
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    if (WIFEXITED(status)) ended.code = WEXITSTATUS(status);
    return ended;
}

constexpr EndingAtOnce::Codes codes{7, 8};

}  // namespace

TEST_CASE("where it is said, the first signal ends the program at once, with a code and a message" *
          doctest::skip(!signals_work_in_children)) {
    for (const auto& [signal, code] : {std::pair(SIGINT, 7), std::pair(SIGTERM, 8), std::pair(SIGHUP, 8)}) {
        const int number = signal;  // Clang 14 cannot capture a binding
        CAPTURE(number);
        const Ended ended = end_of([s = signal] {
            const InterruptGuard guard;
            const EndingAtOnce at_once(codes, "as it was said\n");
            std::raise(s);
        });
        CHECK(ended.code == code);
        CHECK(ended.err == "as it was said\n");
    }
    // One that arrived before.
    CHECK(end_of([] {
              const InterruptGuard guard;
              std::raise(SIGTERM);
              const EndingAtOnce at_once(codes, "");
          }).code == 8);
}

TEST_CASE("before and after that it is a question" * doctest::skip(!signals_work_in_children)) {
    const Ended ended = end_of([] {
        const InterruptGuard guard;
        { const EndingAtOnce at_once(codes, "too early\n"); }
        std::raise(SIGINT);
        if (!interrupted()) ::abort();
    });
    CHECK(ended.code == 0);
    CHECK(ended.err.empty());
    const InterruptGuard guard;
    const EndingAtOnce at_once(codes, "");
    CHECK_THROWS_AS(EndingAtOnce(codes, ""), std::logic_error);
}

}  // namespace test_interrupt
