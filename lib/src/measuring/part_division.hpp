// One part of the bounds, divided depth first; and when to stop.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>

#include "measuring/divide.hpp"
#include "measuring/phase_sums.hpp"
#include "phasetree/measuring/measure.hpp"

namespace phasetree::measuring {

/// Phases are divided further as long as their doubt in a box is above these thresholds.
using Thresholds = std::array<double, Phase::capacity>;

/// A part of the bounds, and the result of its last division.
struct Part {
    ExaminedBox box;
    ObjectSums sums;
    std::size_t boxes = 1;
    bool is_coarse = true;  // whether a smaller threshold would divide it further
    bool is_full = false;   // whether it has been divided into as many boxes as it may be
};

/// Decides when to stop.
class Stop {
  public:
    explicit Stop(const MeasureOptions& options) : options_(options), start_(std::chrono::steady_clock::now()) {}

    bool operator()() {
        if (is_stopped_.load(std::memory_order_relaxed)) return true;
        if (options_.cancelled && options_.cancelled()) {
            end_ = MeasureEnd::cancelled;
            is_stopped_ = true;
        } else if (share_of_time() >= 1) {
            is_stopped_ = true;
        }
        return is_stopped_;
    }
    double share_of_time() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count() / options_.seconds;
    }
    MeasureEnd end() const { return end_; }

  private:
    const MeasureOptions& options_;
    std::chrono::steady_clock::time_point start_;
    std::atomic<bool> is_stopped_{false};
    std::atomic<MeasureEnd> end_{MeasureEnd::seconds};
};

/// Divides one part.
class PartDivision {
  public:
    struct Stopped {};

    PartDivision(const MeasureContext& context, const Thresholds& thresholds, std::size_t max_boxes, Stop& stop,
                 Worker& worker, Part& result)
        : context_(context),
          thresholds_(thresholds),
          most_boxes_(max_boxes),
          stop_(stop),
          worker_(worker),
          result_(result) {}

    // Throws Stopped.
    void run(const ExaminedBox& box) {
        if (!is_divided(box)) return result_.sums.add(box, context_);
        const rewriting::ArenaScope programs(worker_.programs), scratch(worker_.scratch);
        const Division division(box.node, context_, worker_);
        for (std::size_t i = 0; i < division.count(); ++i) {
            constexpr std::size_t boxes_between_polls = 64;
            if (++result_.boxes % boxes_between_polls == 0 && stop_()) throw Stopped();
            const rewriting::ArenaScope of_child(worker_.programs);
            run(division.examine(i));
        }
    }

  private:
    bool is_divided(const ExaminedBox& box) {
        if (box.only || !box.can_be_divided) return false;
        bool is_in_doubt = false;
        for (const PhaseInBox& p : box.phases) {
            if (p.phase == vacuum || !(p.doubt() > 0)) continue;
            is_in_doubt = true;
            if (p.doubt() <= thresholds_[p.phase.index]) continue;
            if (result_.boxes < most_boxes_) return true;
            result_.is_full = true;
        }
        result_.is_coarse = result_.is_coarse || is_in_doubt;
        return false;
    }

    const MeasureContext& context_;
    const Thresholds& thresholds_;
    std::size_t most_boxes_;
    Stop& stop_;
    Worker& worker_;
    Part& result_;
};

/// Reports strictly increasing progress, from one thread at a time.
class Reporter {
  public:
    explicit Reporter(const std::function<void(float)>& callback) : callback_(callback) {}
    void tell(double share) {
        if (!callback_) return;
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock.owns_lock() || !(share > last_ + 1.0 / 1024) || share > 1 - 1.0 / 1024) return;
        last_ = share;
        callback_(static_cast<float>(share));
    }
    void finish() const {
        if (callback_) callback_(1.f);
    }

  private:
    const std::function<void(float)>& callback_;
    std::mutex mutex_;
    double last_ = 0;
};

}  // namespace phasetree::measuring
