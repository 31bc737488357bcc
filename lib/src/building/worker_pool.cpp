#include "building/worker_pool.hpp"

#include <algorithm>

namespace phasetree::building {

SharedConstants::SharedConstants(std::span<const float> of_program)
    : count_(of_program.size()),
      // The unused part of this room costs no memory, because it is never written.
      memory_(std::make_unique_for_overwrite<float[]>(of_program.size() + room * workers_with_room)) {
    std::ranges::copy(of_program, memory_.get());
}

const float* SharedConstants::with(std::span<const float> more, std::size_t worker, std::vector<float>& own) {
    if (fits(worker, more.size())) {
        std::ranges::copy(more, memory_.get() + count_ + worker * room);
        return memory_.get();
    }
    own.assign(memory_.get(), memory_.get() + count_);
    own.insert(own.end(), more.begin(), more.end());
    return own.data();
}

WorkerPool::Borrowed WorkerPool::borrow() {
    std::unique_ptr<Worker> worker;
    std::size_t number = 0;
    {
        const std::scoped_lock lock(mutex_);
        if (idle_.empty()) {
            number = ++count_;
            idle_.reserve(count_);  // Reserve room now, because giving a worker back must not fail.
        } else {
            worker = std::move(idle_.back());
            idle_.pop_back();
        }
    }
    if (!worker) {
        worker = std::make_unique<Worker>(Worker{*this});
        worker->number = number;
    }
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
