// What standard error shows of a render: first how much is learned, where the scene asks for guiding, then how many
// samples are done, or with a deadline how much time has passed.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "output/late_progress.hpp"
#include "output/progress.hpp"

namespace phasetree::tracer {

class RenderProgress {
  public:
    using TimePoint = ProgressOutput::Clock::time_point;

    /// `total` is the number of samples to come; `samples_begin` is called when nothing is left to be learned.
    RenderProgress(ProgressOutput output, std::uint64_t total, std::optional<TimePoint> deadline, bool learns,
                   std::function<void()> samples_begin)
        : output_(std::move(output)), total_(total), deadline_(deadline), samples_begin_(std::move(samples_begin)) {
        if (learns)
            learning_.emplace(output_, "learning where light comes from");
        else
            begin();
    }

    /// For RenderJob::learned.
    void learned(double share) {
        learning_->tell(share);
        if (share < 1) return;
        learning_.reset();
        begin();
    }
    /// For RenderJob::advance.
    void advance(std::uint64_t samples) {
        if (progress_)
            progress_->advance(samples);
        else if (time_progress_)
            time_progress_->tell();
        else
            done_before_ += samples;
    }

  private:
    void begin() {
        if (deadline_)
            time_progress_.emplace(*deadline_, output_, "rendering");
        else
            progress_.emplace(total_, output_).advance(done_before_);
        samples_begin_();
    }

    ProgressOutput output_;
    std::uint64_t total_;
    std::optional<TimePoint> deadline_;
    std::function<void()> samples_begin_;
    std::optional<LateProgress> learning_;
    // Samples that need not be made, which are told before there is a progress that counts them; by one thread.
    std::uint64_t done_before_ = 0;
    std::optional<Progress> progress_;
    std::optional<TimeProgress> time_progress_;
};

}  // namespace phasetree::tracer
