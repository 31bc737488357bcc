#pragma once

#include <atomic>
#include <cstddef>

#include "phasetree/math/bounds.hpp"

namespace phasetree::building {

/// Thrown during a build whose cells would exceed their memory limit.
struct BudgetExceeded {};

/// The memory that cells may take, and the least saving for which a box is divided so that they fit.
///
/// Whether the budget is exceeded must not depend on thread scheduling. So each worker is charged for the peak memory
/// of its cells, and gets nothing back when it discards some of them. The sum of these charges is the same for any
/// number of threads: the subdivision determines which part of the object a worker gets, whichever thread runs it, and
/// its charge depends only on the cells of that part.
class CellBudget {
  public:
    /// `least_saving` is in the unit of the cost model; with 0, every division is worth its memory.
    explicit CellBudget(std::size_t limit_bytes, float least_saving = 0)
        : limit_bytes_(limit_bytes), least_saving_(least_saving) {}

    /// Charges for memory. Thread-safe.
    void charge(std::size_t bytes) {
        if (charged_bytes_.fetch_add(bytes, std::memory_order_relaxed) + bytes > limit_bytes_) throw BudgetExceeded();
    }
    std::size_t charged_bytes() const { return charged_bytes_; }

    /// Requests the memory for dividing a box, which may save this much. Returns false, and records the saving for
    /// largest_refused_saving(), if that is not worth the memory. Request only the division of boxes that would be
    /// divided if memory were unlimited. Thread-safe.
    [[nodiscard]] bool request_division(const Bounds& box, float saving);
    /// The largest refused saving, divided by its box's tie breaker (budget.cpp). If this were the least saving, one
    /// more box would be divided.
    float largest_refused_saving() const { return largest_refused_; }

  private:
    std::size_t limit_bytes_;
    float least_saving_;
    std::atomic<float> largest_refused_{0};
    std::atomic<std::size_t> charged_bytes_{0};
};

/// The memory of one worker's cells, and how much of it has been charged to the budget.
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
    /// Records that cells were discarded, and that the rest takes this much.
    void reset_to(std::size_t bytes) { bytes_ = bytes; }
    /// Takes over the cells of another worker, and their charges.
    void merge(const MemoryAccount& other) {
        bytes_ += other.bytes_;
        charged_ += other.charged_;
    }

  private:
    std::size_t bytes_ = 0, charged_ = 0;
};

}  // namespace phasetree::building
