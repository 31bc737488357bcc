#pragma once

#include <atomic>
#include <cstddef>

#include "phasetree/math/bounds.hpp"

namespace phasetree::building {

/// Thrown while cells are found when they would take more memory than they may.
struct BudgetExceeded {};

/// The memory that cells may take, and the least that the division of a box must save so that it is enough.
///
/// Whether the budget is exceeded must not depend on which thread does what and when. So each worker is charged for the
/// most memory that its cells have taken at any time, and nothing is given back when it discards some of them. The sum
/// of these charges is the same for any number of threads: which part of the object a worker gets is fixed by the
/// subdivision, whichever thread runs it, and its charge depends on the cells of that part alone.
class CellBudget {
  public:
    /// `least_saving` is in the unit of the cost model; with 0 every division is worth it.
    explicit CellBudget(std::size_t limit_bytes, float least_saving = 0)
        : limit_bytes_(limit_bytes), least_saving_(least_saving) {}

    /// Charges for memory. Any thread may call it.
    void charge(std::size_t bytes) {
        if (charged_bytes_.fetch_add(bytes, std::memory_order_relaxed) + bytes > limit_bytes_) throw BudgetExceeded();
    }
    std::size_t charged_bytes() const { return charged_bytes_; }

    /// Whether the division of a box, which may save this much, is worth its memory. Any thread may call it.
    bool is_worth_dividing(const Bounds& box, float saving);
    /// The largest saving, divided by its box's tie breaker (budget.cpp), that was rejected. With this as the least
    /// saving one more box would be divided.
    float largest_refused_saving() const { return largest_refused_; }

  private:
    std::size_t limit_bytes_;
    float least_saving_;
    std::atomic<float> largest_refused_{0};
    std::atomic<std::size_t> charged_bytes_{0};
};

/// The memory of one worker's cells, and how much of it was charged to the budget.
class MemoryAccount {
  public:
    void add(std::size_t bytes, CellBudget& budget) {
        bytes_ += bytes;
        if (bytes_ <= charged_) return;
        const std::size_t uncharged = bytes_ - charged_;
        charged_ = bytes_;
        budget.charge(uncharged);
    }
    std::size_t bytes() const { return bytes_; }
    /// Cells were discarded, and the rest takes this much.
    void reset_to(std::size_t bytes) { bytes_ = bytes; }
    /// Takes over the cells of another worker, and what was charged for them.
    void merge(const MemoryAccount& other) {
        bytes_ += other.bytes_;
        charged_ += other.charged_;
    }

  private:
    std::size_t bytes_ = 0, charged_ = 0;
};

}  // namespace phasetree::building
