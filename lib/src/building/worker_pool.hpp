#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "building/budget.hpp"
#include "building/cell_buffer.hpp"

namespace phasetree::building {

using rewriting::Arena, rewriting::Arenas;

class WorkerPool;

/// The memory with which one thread finds the cells of a part of the object, and the cells that it has found.
struct Worker {
    WorkerPool& pool;
    Arena programs{}, scratch{};
    CellBuffers cells{};
    MemoryAccount account{};         ///< of these cells
    std::vector<float> constants{};  ///< of the object; behind them, at times, the data of specialised instructions

    Arenas arenas() { return {programs, scratch}; }
};

/// Workers that are used again and again, because the system takes longer to map new memory for a small part of an
/// object than its cells take. Any thread may borrow one.
class WorkerPool {
  public:
    explicit WorkerPool(CellBudget& budget) : budget_(budget) {}
    CellBudget& budget() const { return budget_; }

    /// A worker that is given back at the end of a scope.
    class Borrowed {
      public:
        Borrowed(WorkerPool& pool, std::unique_ptr<Worker> worker) : pool_(&pool), worker_(std::move(worker)) {}
        Borrowed(Borrowed&&) noexcept = default;
        Borrowed(const Borrowed&) = delete;
        Borrowed& operator=(const Borrowed&) = delete;
        Borrowed& operator=(Borrowed&&) = delete;
        ~Borrowed() {
            if (worker_) pool_->give_back(std::move(worker_));
        }
        Worker& operator*() const { return *worker_; }
        Worker* operator->() const { return worker_.get(); }

      private:
        WorkerPool* pool_;
        std::unique_ptr<Worker> worker_;
    };

    /// A worker without cells.
    Borrowed borrow();

  private:
    void give_back(std::unique_ptr<Worker>);

    CellBudget& budget_;
    std::mutex mutex_;
    std::size_t count_ = 0;  ///< how many workers there are
    std::vector<std::unique_ptr<Worker>> idle_;
};

}  // namespace phasetree::building
