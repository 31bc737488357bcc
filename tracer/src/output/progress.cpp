#include "output/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string_view>
#include <utility>

namespace phasetree::tracer {
namespace {

using namespace std::chrono_literals;

constexpr auto redraw_interval = 100ms;
// Time in seconds over which the weight of a past rate falls to 1/e: long compared with a tile, short compared with a
// render.
constexpr double rate_memory = 10.0;
constexpr int narrowest_bar = 10;
constexpr std::string_view to_line_start = "\r";
constexpr std::string_view erase_to_end = "\x1b[K";

double seconds(ProgressOutput::Clock::duration d) {
    return std::chrono::duration<double>(d).count();
}

/// Formats "0:07", "12:34", "1:02:03"; a day or more is shown in hours.
std::string duration_text(double s) {
    const auto whole = static_cast<std::int64_t>(std::min(std::max(s, 0.0) + 0.5, 3.6e9));
    const auto h = whole / 3600;
    const auto m = whole / 60 % 60;
    return h > 0 ? fmt::format("{}:{:02}:{:02}", h, m, whole % 60) : fmt::format("{}:{:02}", m, whole % 60);
}

/// Formats "980", "12.4k", "29.5M", with three or four digits.
std::string count_text(std::uint64_t n) {
    if (n < 1000) return std::to_string(n);
    double scaled = static_cast<double>(n);
    constexpr std::array<char, 6> prefixes{'k', 'M', 'G', 'T', 'P', 'E'};
    std::size_t i = 0;
    for (scaled /= 1000.0; scaled >= 999.95 && i + 1 < prefixes.size(); ++i) scaled /= 1000.0;
    return fmt::format("{:.1f}{}", scaled, prefixes[i]);
}

/// floor(parts · done / total), but `parts` only when everything is done, regardless of rounding.
int share(std::uint64_t done, std::uint64_t total, int parts) {
    if (done >= total) return parts;
    const double exact = static_cast<double>(done) / static_cast<double>(total) * parts;
    // 5 of 100 is one of 20 parts, although 0.05 · 20 may round to just below 1.
    const int rounded = static_cast<int>(exact + 1e-9);
    return std::min(rounded, parts - 1);
}

int terminal_columns() {
    winsize size{};
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace

ProgressOutput ProgressOutput::standard_error(bool quiet) {
    ProgressOutput output;
    if (quiet) return output;
    const char* term = std::getenv("TERM");
    output.stream = &std::cerr;
    output.terminal = isatty(STDERR_FILENO) == 1 && term != nullptr && std::string_view(term) != "dumb";
    output.columns = terminal_columns;
    return output;
}

Progress::Progress(std::uint64_t total, ProgressOutput output, std::string task)
    : total_(total),
      task_(std::move(task)),
      output_(std::move(output)),
      start_(output_.now()),
      next_draw_(start_.time_since_epoch().count()),
      last_draw_(start_) {
    advance(0);
}

Progress::~Progress() {
    finish();
}

void Progress::advance(std::uint64_t n) {
    const std::uint64_t done = done_.fetch_add(n, std::memory_order_relaxed) + n;
    if (output_.stream == nullptr) return;
    if (!output_.terminal) {
        if (share(done, total_, 20) > shown_twentieths_.load(std::memory_order_relaxed)) {
            const std::lock_guard lock(drawing_);
            print_line();
        }
        return;
    }
    const TimePoint now = output_.now();
    if (now.time_since_epoch().count() < next_draw_.load(std::memory_order_relaxed)) return;
    // If another thread is drawing, it also draws this thread's progress.
    const std::unique_lock lock(drawing_, std::try_to_lock);
    if (lock.owns_lock() && now.time_since_epoch().count() >= next_draw_.load(std::memory_order_relaxed)) draw_bar(now);
}

void Progress::finish() {
    if (output_.stream == nullptr) return;
    const std::lock_guard lock(drawing_);
    if (finished_) return;
    if (output_.terminal) {
        *output_.stream << to_line_start << erase_to_end << std::flush;
    } else {
        print_line();
    }
    finished_ = true;
}

void Progress::print_line() {
    const std::uint64_t done = done_.load(std::memory_order_relaxed);
    const int twentieths = share(done, total_, 20);
    if (finished_ || twentieths <= shown_twentieths_.load(std::memory_order_relaxed)) return;
    shown_twentieths_.store(twentieths, std::memory_order_relaxed);
    const TimePoint now = output_.now();
    measure_rate(now, done);
    const double elapsed = seconds(now - start_);
    const std::string at = done >= total_ ? fmt::format(", {} elapsed", duration_text(elapsed))
                           : done > 0     ? ", " + times(done, elapsed)
                                          : "";
    *output_.stream << fmt::format("{}: {}%{}\n", task_.empty() ? "Progress" : task_, 5 * twentieths, at) << std::flush;
}

void Progress::measure_rate(TimePoint now, std::uint64_t done) {
    const double passed = seconds(now - last_draw_);
    const double fading = std::exp(-passed / rate_memory);
    recent_samples_ = recent_samples_ * fading + static_cast<double>(done - last_done_);
    recent_seconds_ = recent_seconds_ * fading + passed;
    last_draw_ = now;
    last_done_ = done;
}

std::string Progress::times(std::uint64_t done, double elapsed) const {
    const double rate = recent_seconds_ > 0.0 ? recent_samples_ / recent_seconds_ : 0.0;
    const std::string left = rate > 0.0 ? duration_text(static_cast<double>(total_ - done) / rate) : "-:--";
    return fmt::format("{} elapsed, ETA {}", duration_text(elapsed), left);
}

void Progress::draw_bar(TimePoint now) {
    if (finished_) return;
    next_draw_.store((now + redraw_interval).time_since_epoch().count(), std::memory_order_relaxed);
    const std::uint64_t done = done_.load(std::memory_order_relaxed);
    measure_rate(now, done);
    const std::string line = bar_line(std::min(done, total_), seconds(now - start_));
    *output_.stream << fmt::format("{}{}{}", to_line_start, line, erase_to_end) << std::flush;
}

std::string Progress::bar_line(std::uint64_t done, double elapsed) const {
    const std::string percent = fmt::format("{:3}%", share(done, total_, 100));
    const std::string at = times(done, elapsed);
    const std::string samples =
        !task_.empty() ? task_ : fmt::format("{}/{} samples", count_text(done), count_text(total_));

    // Leave the last column free, because some terminals wrap as soon as it is filled.
    const int width = output_.columns() - 1;
    const std::string tail = fmt::format("{}, {}", samples, at);
    const int bar = std::min(width - static_cast<int>(percent.size() + tail.size()) - 4, 60);
    if (bar >= narrowest_bar) {
        const int filled = share(done, total_, bar);
        return fmt::format("{} [{}{}] {}", percent, std::string(static_cast<std::size_t>(filled), '='),
                           std::string(static_cast<std::size_t>(bar - filled), ' '), tail);
    }
    // If the line is too narrow, drop the bar, then the samples, then the times.
    for (const std::string& line : {fmt::format("{} {}", percent, tail), fmt::format("{} {}", percent, at)}) {
        if (static_cast<int>(line.size()) <= width) return line;
    }
    return percent;
}

TimeProgress::TimeProgress(ProgressOutput::Clock::time_point end, ProgressOutput output, std::string task)
    : output_(output),
      start_(output_.now()),
      total_(static_cast<std::uint64_t>(
          std::max<std::int64_t>(std::chrono::duration_cast<std::chrono::milliseconds>(end - start_).count(), 1))),
      progress_(total_, std::move(output), std::move(task)) {}

std::uint64_t TimeProgress::milliseconds() const {
    const auto passed = std::chrono::duration_cast<std::chrono::milliseconds>(output_.now() - start_).count();
    return std::min(static_cast<std::uint64_t>(std::max<std::int64_t>(passed, 0)), total_);
}

void TimeProgress::tell() {
    const std::uint64_t now = milliseconds();
    std::uint64_t before = told_.load(std::memory_order_relaxed);
    // Only one thread reports each millisecond.
    while (before < now)
        if (told_.compare_exchange_weak(before, now, std::memory_order_relaxed)) return progress_.advance(now - before);
}

}  // namespace phasetree::tracer
