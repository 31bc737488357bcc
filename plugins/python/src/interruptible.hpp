// Work on many points or rays on all cores, which Ctrl-C can interrupt.
#pragma once

#include <pybind11/pybind11.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "phasetree/math/float_mode.hpp"

namespace phasetree::python {

/// Polls Python for signals at intervals. Only the thread that created it may poll Python and read the time of the last
/// poll. That thread releases the interpreter's lock for the lifetime of the object.
class Interruption {
  public:
    /// Returns true once the work must end. Any thread may call this often.
    bool asked() {
        if (ended_.load(std::memory_order_relaxed)) return true;
        if (std::this_thread::get_id() != caller_) return false;
        const auto now = std::chrono::steady_clock::now();
        if (now - last_ < std::chrono::milliseconds(50)) return false;
        last_ = now;
        const pybind11::gil_scoped_acquire lock;
        if (PyErr_CheckSignals() != 0) {
            error_ = true;
            ended_.store(true, std::memory_order_relaxed);
        }
        return ended_;
    }
    /// Whether a signal handler has raised an exception, which is Python's current error.
    bool has_error() const { return error_; }

  private:
    const std::thread::id caller_ = std::this_thread::get_id();
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
    std::atomic<bool> ended_ = false;
    bool error_ = false;
};

/// Calls f(begin, end) for blocks of `block` of `count` items, on TBB's threads and without the interpreter's lock. The
/// results of f must depend on the block alone. Throws the exception of a signal handler, such as KeyboardInterrupt.
template <class F>
void for_each_block(std::size_t count, std::size_t block, F&& f) {
    bool has_error = false;
    {
        const pybind11::gil_scoped_release unlocked;
        Interruption interruption;
        const std::size_t blocks = (count + block - 1) / block;
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks, 1), [&](const auto& range) {
            const FlushSubnormals flush;
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                if (interruption.asked()) return;
                f(i * block, std::min(count, (i + 1) * block));
            }
        });
        has_error = interruption.has_error();
    }
    if (has_error) throw pybind11::error_already_set();
}

}  // namespace phasetree::python
