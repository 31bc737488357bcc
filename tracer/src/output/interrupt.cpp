#include "output/interrupt.hpp"

#include <unistd.h>

#include <atomic>
#include <stdexcept>
#include <utility>

namespace phasetree::tracer {
namespace {

// The project's only mutable globals. A signal handler is a plain function without a context, so it communicates
// through static storage, and may use only lock-free atomics.
std::atomic<int> signal_arrived{0};
std::atomic<bool> checkpoint_asked{false};
std::atomic<bool> guard_lives{false};
std::atomic<const EndingAtOnce::Told*> ending_at_once{nullptr};
static_assert(std::atomic<const EndingAtOnce::Told*>::is_always_lock_free);
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

constexpr std::array<int, 4> handled_signals{SIGINT, SIGTERM, SIGHUP, SIGUSR1};

// Restricted to what is allowed in a signal handler.
[[noreturn]] void end_at_once(const EndingAtOnce::Told& told, int arrived) {
    // If the message cannot be written, nothing else is affected.
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, told.message.data(), told.message.size());
    ::_exit(arrived == SIGINT ? told.codes.of_person : told.codes.of_others);
}

// Handles the first signal of any kind. It restores the default actions, so the second signal is handled by the system
// and ends the program, however stuck it is, and the shell sees the cause.
extern "C" void phasetree_on_interrupt(int arrived) {
    if (const EndingAtOnce::Told* told = ending_at_once) end_at_once(*told, arrived);
    signal_arrived = arrived;
    for (const int signal : handled_signals) {
        struct sigaction current {};
        sigaction(signal, nullptr, &current);
        if (current.sa_handler == phasetree_on_interrupt) {  // an ignored signal stays ignored
            current.sa_handler = SIG_DFL;
            sigaction(signal, &current, nullptr);
        }
    }
}

extern "C" void phasetree_on_checkpoint(int) {
    checkpoint_asked = true;
}

}  // namespace

InterruptGuard::InterruptGuard() {
    if (guard_lives.exchange(true)) throw std::logic_error("one InterruptGuard at a time");
    signal_arrived = 0;
    struct sigaction action {};
    sigemptyset(&action.sa_mask);
    for (const int signal : handled_signals) sigaddset(&action.sa_mask, signal);  // one at a time
    action.sa_flags = SA_RESTART;  // interrupted reads and writes are restarted
    for (std::size_t i = 0; i < handled_signals.size(); ++i) {
        sigaction(handled_signals[i], nullptr, &previous_[i]);
        action.sa_handler = handled_signals[i] == SIGUSR1 ? phasetree_on_checkpoint : phasetree_on_interrupt;
        if (previous_[i].sa_handler != SIG_IGN) sigaction(handled_signals[i], &action, nullptr);
    }
}

InterruptGuard::~InterruptGuard() {
    for (std::size_t i = 0; i < handled_signals.size(); ++i) sigaction(handled_signals[i], &previous_[i], nullptr);
    signal_arrived = 0;
    guard_lives = false;
}

EndingAtOnce::EndingAtOnce(Codes codes, std::string message) : told_{codes, std::move(message)} {
    const Told* nobody = nullptr;
    if (!ending_at_once.compare_exchange_strong(nobody, &told_)) throw std::logic_error("one EndingAtOnce at a time");
    if (interrupted()) end_at_once(told_, interrupting_signal());
}

EndingAtOnce::~EndingAtOnce() {
    ending_at_once = nullptr;
}

bool interrupted() {
    return interrupting_signal() != 0;
}

int interrupting_signal() {
    return signal_arrived.load(std::memory_order_relaxed);
}

void expect_checkpoint_requests() {
    struct sigaction action {};
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    action.sa_handler = phasetree_on_checkpoint;
    struct sigaction current {};
    sigaction(SIGUSR1, nullptr, &current);
    if (current.sa_handler != SIG_IGN) sigaction(SIGUSR1, &action, nullptr);
}

bool take_checkpoint_request() {
    return checkpoint_asked.exchange(false);
}

}  // namespace phasetree::tracer
