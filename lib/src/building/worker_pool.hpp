#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "building/budget.hpp"
#include "building/cell_buffer.hpp"

namespace phasetree::building {

using rewriting::Arena, rewriting::Arenas;

class WorkerPool;

/// The constants of an object's program, shared by all workers of a build; they may be millions of balls. After them,
/// each worker has room for the data of specialised instructions, because a routine takes all constants from a single
/// array.
class SharedConstants {
  public:
    explicit SharedConstants(std::span<const float> of_program);

    /// An array of the constants followed by `more`, valid until the worker's next call. If there is too little room,
    /// it is built in `own`.
    const float* with(std::span<const float> more, std::size_t worker, std::vector<float>& own);
    /// The index of the first appended constant in that array.
    std::uint32_t first_behind(std::size_t worker, std::size_t count) const {
        return narrow(fits(worker, count) ? count_ + worker * room : count_);
    }

  private:
    static constexpr std::size_t room = std::size_t{1} << 14, workers_with_room = 512;
    static bool fits(std::size_t worker, std::size_t count) { return worker < workers_with_room && count <= room; }

    std::size_t count_;
    std::unique_ptr<float[]> memory_;
};

/// The memory for finding the cells of one part of the object, and the cells found. It is not a thread: the subdivision
/// determines which part a worker gets, and one thread at a time runs it.
struct Worker {
    WorkerPool& pool;
    Arena programs{}, scratch{};
    CellBuffers cells{};
    MemoryAccount account{};           ///< of these cells
    std::size_t number = 0;            ///< its number among the workers of the build
    std::vector<float> specialised{};  ///< data of the specialised instructions of the program being evaluated
    std::vector<float> constants{};    ///< used only if SharedConstants has no room

    Arenas arenas() { return {programs, scratch}; }
};

/// Reuses workers, because mapping new memory for a small part of an object would take longer than finding its cells.
/// Thread-safe.
class WorkerPool {
  public:
    WorkerPool(CellBudget& budget, std::span<const float> constants) : constants_(constants), budget_(budget) {}
    CellBudget& budget() const { return budget_; }
    SharedConstants& constants() { return constants_; }

    /// A worker that is returned to the pool at the end of a scope.
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

    SharedConstants constants_;
    CellBudget& budget_;
    std::mutex mutex_;
    std::size_t count_ = 0;  ///< the number of workers besides the first
    std::vector<std::unique_ptr<Worker>> idle_;
};

}  // namespace phasetree::building
