#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <functional>

#include "phasetree/math/float_mode.hpp"

namespace phasetree::evaluation {

/// Calls f(begin, end) for blocks of `block` of `count` items, on the threads of TBB's arena. Polls `cancelled` before
/// each block. Returns false if it returned true; some blocks are then left out.
template <class F>
bool in_blocks(std::size_t count, std::size_t block, const std::function<bool()>& cancelled, F&& f) {
    std::atomic<bool> is_complete{true};
    tbb::parallel_for(std::size_t{0}, (count + block - 1) / block, [&](std::size_t i) {
        if (!is_complete.load(std::memory_order_relaxed)) return;
        if (cancelled && cancelled()) {
            is_complete = false;
            return;
        }
        const FlushSubnormals flush;
        f(i * block, std::min(count, (i + 1) * block));
    });
    return is_complete;
}

}  // namespace phasetree::evaluation
