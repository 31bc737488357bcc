#include "building/worker_pool.hpp"

namespace phasetree::building {

WorkerPool::Borrowed WorkerPool::borrow() {
    std::unique_ptr<Worker> worker;
    {
        const std::scoped_lock lock(mutex_);
        if (idle_.empty()) {
            idle_.reserve(++count_);  // There must be room for it already when it is given back, which may not fail.
        } else {
            worker = std::move(idle_.back());
            idle_.pop_back();
        }
    }
    if (!worker) worker = std::make_unique<Worker>(Worker{*this});
    worker->programs.release({});
    worker->scratch.release({});
    worker->cells = {};
    worker->account = {};
    return {*this, std::move(worker)};
}

void WorkerPool::give_back(std::unique_ptr<Worker> worker) {
    const std::scoped_lock lock(mutex_);
    idle_.push_back(std::move(worker));
}

}  // namespace phasetree::building
