#include "building/budget.hpp"

#include <bit>
#include <cstdint>

#include "phasetree_support/mixed_hash.hpp"

namespace phasetree::building {

namespace {

// A number from 1 to 4 that differs from box to box: a hash of the box's centre. Where boxes are all alike, as in a
// pattern, lowering the least saving would first divide none of them and then all. Divided by this number, their
// savings differ, so that only some are divided.
float tie_breaker(const Bounds& box) {
    const glm::vec3 c = box.centre();
    std::uint64_t hash = 0;
    for (int i = 0; i < 3; ++i) hash = support::mixed(hash, std::bit_cast<std::uint32_t>(c[i]));
    return 1 + 3 * static_cast<float>(hash & 0xffff) / 0x10000;
}

}  // namespace

bool CellBudget::request_division(const Bounds& box, float saving) {
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
