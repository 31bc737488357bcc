#include "output/interrupt.hpp"

#include <atomic>
#include <stdexcept>

namespace phasetree::tracer {
namespace {

// The project's only mutable globals: a signal handler is a plain function without a context, so what it tells must
// have static storage, and only lock-free atomics are allowed inside one.
std::atomic<bool> signal_arrived{false};
std::atomic<bool> guard_lives{false};
static_assert(std::atomic<bool>::is_always_lock_free);

constexpr std::array<int, 3> handled_signals{SIGINT, SIGTERM, SIGHUP};

// The first signal of any kind. With the default actions back, the second ends the program by the system's own hand,
// however stuck it is, and the shell learns why.
extern "C" void phasetree_on_interrupt(int) {
    signal_arrived = true;
    for (const int signal : handled_signals) {
        struct sigaction current {};
        sigaction(signal, nullptr, &current);
        if (current.sa_handler == phasetree_on_interrupt) {  // an ignored one stays ignored
            current.sa_handler = SIG_DFL;
            sigaction(signal, &current, nullptr);
        }
    }
}

}  // namespace

InterruptGuard::InterruptGuard() {
    if (guard_lives.exchange(true)) throw std::logic_error("one InterruptGuard at a time");
    signal_arrived = false;
    struct sigaction action {};
    action.sa_handler = phasetree_on_interrupt;
    sigemptyset(&action.sa_mask);
    for (const int signal : handled_signals) sigaddset(&action.sa_mask, signal);  // one after the other
    action.sa_flags = SA_RESTART;  // no read or write fails because of it
    for (std::size_t i = 0; i < handled_signals.size(); ++i) {
        sigaction(handled_signals[i], nullptr, &previous_[i]);
        if (previous_[i].sa_handler != SIG_IGN) sigaction(handled_signals[i], &action, nullptr);
    }
}

InterruptGuard::~InterruptGuard() {
    for (std::size_t i = 0; i < handled_signals.size(); ++i) sigaction(handled_signals[i], &previous_[i], nullptr);
    signal_arrived = false;
    guard_lives = false;
}

bool interrupted() {
    return signal_arrived.load(std::memory_order_relaxed);
}

}  // namespace phasetree::tracer
