#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "building/budget.hpp"
#include "building/cell_buffer.hpp"

namespace phasetree::building {

using rewriting::Arena;

class Workers;

/// What finds the cells of a part: memory of its own, and what it has found.
struct Worker {
    Workers& others;
    Arena programs{}, scratch{};
    CellBuffers found{};
    CellAccount account{};           ///< for what was found
    std::vector<float> constants{};  ///< of the object, and for a while what local values want
};

/// Workers that come back with their memory and go out again: to map it anew for each part takes longer than many of
/// its cells do. Any thread may borrow.
class Workers {
  public:
    explicit Workers(CellBudget& budget) : budget_(budget) {}
    CellBudget& budget() const { return budget_; }

    class Borrowed {
      public:
        Borrowed(Workers& from, std::unique_ptr<Worker> worker) : from_(&from), worker_(std::move(worker)) {}
        Borrowed(Borrowed&&) noexcept = default;
        Borrowed(const Borrowed&) = delete;
        Borrowed& operator=(const Borrowed&) = delete;
        Borrowed& operator=(Borrowed&&) = delete;
        ~Borrowed() {
            if (worker_) from_->give_back(std::move(worker_));
        }
        Worker& operator*() const { return *worker_; }
        Worker* operator->() const { return worker_.get(); }

      private:
        Workers* from_;
        std::unique_ptr<Worker> worker_;
    };

    /// One that has found nothing yet.
    Borrowed borrow() {
        std::unique_ptr<Worker> worker;
        {
            const std::scoped_lock lock(mutex_);
            if (idle_.empty()) {
                idle_.reserve(++count_);  // so that giving back never fails
            } else {
                worker = std::move(idle_.back());
                idle_.pop_back();
            }
        }
        if (!worker) worker = std::make_unique<Worker>(Worker{*this});
        worker->programs.release({});
        worker->scratch.release({});
        worker->found = {};
        worker->account = {};
        return {*this, std::move(worker)};
    }

  private:
    void give_back(std::unique_ptr<Worker> worker) {
        const std::scoped_lock lock(mutex_);
        idle_.push_back(std::move(worker));
    }

    CellBudget& budget_;
    std::mutex mutex_;
    std::size_t count_ = 0;
    std::vector<std::unique_ptr<Worker>> idle_;
};

}  // namespace phasetree::building
