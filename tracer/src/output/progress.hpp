// How far the rendering is, on standard error: a bar on a terminal, otherwise (a log, a pipe) lines
// "Progress: 15%, 0:12 elapsed, ETA 1:07".
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <mutex>
#include <string>

namespace phasetree::tracer {

/// Where and how progress is shown.
struct ProgressOutput {
    using Clock = std::chrono::steady_clock;  ///< monotonic: setting the computer's time must not move the estimate

    std::ostream* stream = nullptr;  ///< null: silence
    bool terminal = false;
    std::function<int()> columns = [] { return 80; };
    std::function<Clock::time_point()> now = [] { return Clock::now(); };  ///< called from every thread

    /// Standard error; a bar where it is a terminal that can erase a line. Silent if quiet.
    static ProgressOutput standard_error(bool quiet);
};

class Progress {
  public:
    /// total: the number of samples to come; or of something else, of which the bar tells the `task` and not how many.
    Progress(std::uint64_t total, ProgressOutput output, std::string task = {});
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// n more samples are done. Any thread; cheap enough for every tile, not for every sample.
    void advance(std::uint64_t n);

    /// Removes the bar, or ends the lines with 100 % if all is done. To be called before other text goes to the
    /// terminal; the destructor does it too. After an interruption the lines end where the work ended.
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
    std::mutex drawing_;  ///< guards all below, and the stream
    bool finished_ = false;
    TimePoint last_draw_;
    std::uint64_t last_done_ = 0;
    double recent_samples_ = 0.0;  ///< both with exponentially fading weight; their quotient is the rate
    double recent_seconds_ = 0.0;
};

/// The progress of something that ends with its time: of the time that has passed.
class TimeProgress {
  public:
    TimeProgress(ProgressOutput::Clock::time_point end, ProgressOutput output, std::string task);

    /// Any thread; as cheap as Progress::advance.
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
