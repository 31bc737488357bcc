#pragma once

// oneTBB's parallel_invoke for builds with the thread sanitizer, for the reasons that parallel_for.h has.

#include <cstddef>

#include "parallel_for.h"

namespace tbb {

template <typename First, typename Second>
void parallel_invoke(const First& first, const Second& second) {
    phasetree::thread_sanitizer::deal(2, [&](std::size_t k) {
        if (k == 0)
            first();
        else
            second();
    });
}

}  // namespace tbb
