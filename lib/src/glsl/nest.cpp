#include "glsl/nest.hpp"

#include <algorithm>

namespace phasetree::glsl {

Nest::Nest(const Trace& trace, std::vector<NestItem> items)
    : trace_(&trace), items_(std::move(items)), first_(items_.empty() ? 0 : items_.front().offset) {
    if (items_.empty()) return;
    leaf_of_.resize(items_.back().offset + items_.back().span() - first_);
    std::vector<const NestItem*> loops;
    number(items_, 0, loops);
    for (std::uint32_t i = 0; i < leaves_.size(); ++i) {
        Counters counters(counts_of(leaves_[i].loops));
        do leaf_of_[step_at(leaves_[i], counters) - first_] = i;
        while (counters.next());
    }
}

void Nest::number(const std::vector<NestItem>& items, std::uint32_t first, std::vector<const NestItem*>& loops) {
    for (const NestItem& item : items) {
        if (item.is_step()) {
            leaves_.push_back({loops, first + item.offset});
            continue;
        }
        loops.push_back(&item);
        number(item.body, first + item.offset, loops);
        loops.pop_back();
    }
}

std::optional<std::uint32_t> Nest::latest(const Leaf& leaf, std::uint32_t before) const {
    // Find the largest counters, from the outermost loop inwards, for which the step is still before the limit if all
    // inner counters are 0.
    std::uint32_t step = leaf.first;
    if (step >= before) return std::nullopt;
    for (const NestItem* loop : leaf.loops)
        step += loop->period * std::min((before - 1 - step) / loop->period, loop->count - 1);
    return step;
}

}  // namespace phasetree::glsl
