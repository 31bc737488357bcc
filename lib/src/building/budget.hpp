#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "phasetree/math/bounds.hpp"

namespace phasetree::building {

/// Thrown by what finds cells when they would take more memory than they may.
struct BudgetExceeded {};

/// The memory that cells may take, and what dividing a box must save so that it is enough. Each worker pays for the
/// most that it has had at once, and for no less when it throws some away. So what all have paid at the end is the same
/// whichever thread did what and when, and because nobody pays back, so is whether that was too much.
class CellBudget {
  public:
    /// `least_saving` in the unit of price.hpp.
    explicit CellBudget(std::size_t most_bytes, float least_saving = 0)
        : most_(most_bytes), least_saving_(least_saving) {}

    /// Any thread may pay.
    void pay(std::size_t bytes) {
        if (paid_.fetch_add(bytes, std::memory_order_relaxed) + bytes > most_) throw BudgetExceeded();
    }
    std::size_t paid() const { return paid_; }

    /// Whether dividing a box may save enough. Any thread may ask.
    bool is_worth_dividing(const Bounds& box, float saving) {
        if (least_saving_ == 0) return true;
        const float thinned = saving / thinning(box);
        if (thinned >= least_saving_) return true;
        float most = most_left_.load(std::memory_order_relaxed);
        while (most < thinned && !most_left_.compare_exchange_weak(most, thinned, std::memory_order_relaxed)) {
        }
        return false;
    }
    /// If dividing a box has to save no more than this, one more is divided.
    float most_left() const { return most_left_; }

  private:
    /// A number from 1 to 4, another for each box. Of boxes that are all alike, as those of a pattern are, a price that
    /// falls would divide none and then all; so some come before others.
    static float thinning(const Bounds& box) {
        const glm::vec3 c = box.centre();
        std::uint64_t hash = 0;
        for (int i = 0; i < 3; ++i) {
            hash = (hash ^ std::bit_cast<std::uint32_t>(c[i])) * 0x9e3779b97f4a7c15u;
            hash ^= hash >> 32;
        }
        return 1 + 3 * static_cast<float>(hash & 0xffff) / 0x10000;
    }

    std::size_t most_;
    float least_saving_;
    std::atomic<float> most_left_{0};
    std::atomic<std::size_t> paid_{0};
};

/// What one worker has, and what it has paid for.
class CellAccount {
  public:
    void add(std::size_t bytes, CellBudget& budget) {
        has_ += bytes;
        if (has_ <= paid_) return;
        const std::size_t more = has_ - paid_;
        paid_ = has_;
        budget.pay(more);
    }
    std::size_t has() const { return has_; }
    /// Some is thrown away, and this is left.
    void keep(std::size_t bytes) { has_ = bytes; }
    /// All that another has, and has paid for.
    void take(const CellAccount& other) {
        has_ += other.has_;
        paid_ += other.paid_;
    }

  private:
    std::size_t has_ = 0, paid_ = 0;
};

}  // namespace phasetree::building
