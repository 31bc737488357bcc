#include "building/budget.hpp"

#include <bit>
#include <cstdint>

#include "phasetree_support/mixed_hash.hpp"

namespace phasetree::building {

namespace {

// A number from 1 to 4 that is another one for each box, by a hash of its centre. Among boxes that are all alike, as
// those of a pattern are, a falling least saving would divide first none and then all; divided by this number, their
// savings differ, and some come before others.
float tie_breaker(const Bounds& box) {
    const glm::vec3 c = box.centre();
    std::uint64_t hash = 0;
    for (int i = 0; i < 3; ++i) hash = support::mixed(hash, std::bit_cast<std::uint32_t>(c[i]));
    return 1 + 3 * static_cast<float>(hash & 0xffff) / 0x10000;
}

}  // namespace

bool CellBudget::is_worth_dividing(const Bounds& box, float saving) {
    if (least_saving_ == 0) return true;
    const float distinct = saving / tie_breaker(box);
    if (distinct >= least_saving_) return true;
    float largest = largest_refused_.load(std::memory_order_relaxed);
    while (largest < distinct &&
           !largest_refused_.compare_exchange_weak(largest, distinct, std::memory_order_relaxed)) {
    }
    return false;
}

}  // namespace phasetree::building
