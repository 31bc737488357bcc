#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "module.hpp"

namespace py = pybind11;

namespace phasetree::python {

namespace {

struct Told {
    const char* stage = "";
    float share = 0;
    bool operator==(const Told&) const = default;
};

// State shared by the work and the thread that waits for it.
class Work {
  public:
    void tell(const char* stage, float share) {
        const std::lock_guard lock(mutex_);
        told_ = {stage, share};
    }
    void end() {
        const std::lock_guard lock(mutex_);
        has_ended_ = true;
        changed_.notify_all();
    }
    // Waits for a short time. Returns whether the work has ended.
    bool wait(Told& told) {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, std::chrono::milliseconds(50), [&] { return has_ended_; });
        told = told_;
        return has_ended_;
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    Told told_;
    bool has_ended_ = false;
};

}  // namespace

void run_beside(const py::object& tell,
                const std::function<void(const std::function<bool()>& cancelled, const Progress& progress)>& work) {
    std::atomic<bool> is_cancelled = false;
    std::exception_ptr thrown;
    std::optional<py::error_already_set> raised;
    Work state;
    {
        const py::gil_scoped_release unlocked;
        std::thread worker([&] {
            try {
                work([&] { return is_cancelled.load(std::memory_order_relaxed); },
                     [&](const char* stage, float share) { state.tell(stage, share); });
            } catch (...) {
                thrown = std::current_exception();
            }
            state.end();
        });
        Told last, told;
        while (!state.wait(told)) {
            if (is_cancelled) continue;
            const py::gil_scoped_acquire lock;
            try {
                if (PyErr_CheckSignals() != 0) throw py::error_already_set();
                if (!tell.is_none() && !(told == last)) tell(told.stage, told.share);
                last = told;
            } catch (py::error_already_set& e) {
                raised.emplace(e);
                is_cancelled = true;
            }
        }
        worker.join();
    }
    if (raised) throw py::error_already_set(*raised);
    if (thrown) std::rethrow_exception(thrown);
}

}  // namespace phasetree::python
