// Lets Ctrl-C, and any other signal with a Python handler, stop the preparation of nodes.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "phasetree/model/preparation_watch.hpp"

namespace phasetree::python {

/// Returns f(), which creates nodes. Polls for signals meanwhile, and throws what a signal's handler raises. The
/// calling thread holds the interpreter's lock.
template <class F>
auto while_watching_signals(F&& f) {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds interval{50};
    const std::thread::id caller = std::this_thread::get_id();
    std::atomic<bool> is_raised = false;
    Clock::time_point next = Clock::now() + interval;
    const auto poll = [&] {
        // Only the thread that holds the lock may run handlers.
        if (std::this_thread::get_id() == caller && !is_raised && Clock::now() >= next) {
            next = Clock::now() + interval;
            if (PyErr_CheckSignals() != 0) is_raised = true;
        }
        return is_raised.load();
    };
    const PreparationWatch watch({.cancelled = poll, .progress = {}});
    try {
        return f();
    } catch (const PreparationCancelled&) {
        throw pybind11::error_already_set();
    }
}

}  // namespace phasetree::python
