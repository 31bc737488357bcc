// Progress of rendering on standard error: a bar on a terminal, otherwise (a log or a pipe) lines "Progress: 15%, 0:12
// elapsed, ETA 1:07".
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <mutex>
#include <string>

namespace phasetree::tracer {

/// Where and how to show progress.
struct ProgressOutput {
    using Clock = std::chrono::steady_clock;  ///< monotonic: setting the computer's time must not move the estimate

    std::ostream* stream = nullptr;  ///< null for no output
    bool terminal = false;
    std::function<int()> columns = [] { return 80; };
    std::function<Clock::time_point()> now = [] { return Clock::now(); };  ///< called from any thread

    /// Standard error, with a bar if it is a terminal that can erase lines. No output if `quiet`.
    static ProgressOutput standard_error(bool quiet);
};

class Progress {
  public:
    /// `total` is the number of samples to render. With a `task`, it counts something else, and the bar shows the task
    /// instead of the count.
    Progress(std::uint64_t total, ProgressOutput output, std::string task = {});
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Reports n more completed samples. Thread-safe. Cheap enough to call per tile, but not per sample.
    void advance(std::uint64_t n);

    /// Removes the bar, or, if everything is done, ends the lines with 100 %. After an interruption the last line shows
    /// how far the work got. Call this before other text is printed on the terminal; the destructor calls it too.
    void finish();

  private:
    using TimePoint = ProgressOutput::Clock::time_point;

    void draw_bar(TimePoint now);
    void print_line();
    void measure_rate(TimePoint now, std::uint64_t done);
    std::string times(std::uint64_t done, double elapsed) const;
    std::string bar_line(std::uint64_t done, double elapsed) const;

    const std::uint64_t total_;
    const std::string task_;
    const ProgressOutput output_;
    const TimePoint start_;
    std::atomic<std::uint64_t> done_{0};
    std::atomic<TimePoint::rep> next_draw_;
    std::atomic<int> shown_twentieths_{-1};
    std::mutex drawing_;  ///< guards everything below, and the stream
    bool finished_ = false;
    TimePoint last_draw_;
    std::uint64_t last_done_ = 0;
    double recent_samples_ = 0.0;  ///< exponentially decaying sums; their quotient is the rate
    double recent_seconds_ = 0.0;
};

/// Progress of work with a deadline: shows the elapsed time.
class TimeProgress {
  public:
    TimeProgress(ProgressOutput::Clock::time_point end, ProgressOutput output, std::string task);

    /// Updates the display. Thread-safe, and as cheap as Progress::advance.
    void tell();

  private:
    std::uint64_t milliseconds() const;

    const ProgressOutput output_;
    const ProgressOutput::Clock::time_point start_;
    const std::uint64_t total_;
    std::atomic<std::uint64_t> told_{0};
    Progress progress_;
};

}  // namespace phasetree::tracer
