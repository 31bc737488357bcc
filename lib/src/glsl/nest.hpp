#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "glsl/trace.hpp"

namespace phasetree::glsl {

/// A step of a trace, or a loop of steps. Steps are counted from the beginning of the surrounding iteration.
struct NestItem {
    std::uint32_t offset = 0;      ///< of the first step
    std::uint32_t period = 1;      ///< the number of trace steps per iteration
    std::uint32_t count = 1;       ///< number of iterations
    std::vector<NestItem> body{};  ///< empty for a step

    bool is_step() const { return body.empty(); }
    std::uint32_t span() const { return period * count; }
};

/// A step that is written once, and executed for all values of the counters of its surrounding loops.
struct Leaf {
    std::vector<const NestItem*> loops;  ///< outermost first
    std::uint32_t first = 0;             ///< the step of the trace for which all counters are 0
};

/// A trace, or part of it, with its loops.
class Nest {
  public:
    /// The items must be contiguous.
    Nest(const Trace&, std::vector<NestItem> items);

    const Trace& trace() const { return *trace_; }
    const std::vector<NestItem>& items() const { return items_; }
    const std::vector<Leaf>& leaves() const { return leaves_; }
    /// The index of the leaf to which a step of the trace belongs.
    std::uint32_t leaf_of(std::uint32_t step) const { return leaf_of_[step - first_]; }
    /// The last step before `before` that is an instance of this leaf.
    std::optional<std::uint32_t> latest(const Leaf&, std::uint32_t before) const;

  private:
    void number(const std::vector<NestItem>&, std::uint32_t first, std::vector<const NestItem*>& loops);

    const Trace* trace_;
    std::vector<NestItem> items_;
    std::uint32_t first_;  ///< the first step of the items
    std::vector<Leaf> leaves_;
    std::vector<std::uint32_t> leaf_of_;
};

/// Enumerates the values of the counters of some loops; the innermost varies fastest.
class Counters {
  public:
    explicit Counters(std::vector<std::uint32_t> counts) : counts_(std::move(counts)), now_(counts_.size(), 0) {}
    bool next() {
        for (std::size_t l = counts_.size(); l-- > 0;) {
            if (++now_[l] < counts_[l]) return true;
            now_[l] = 0;
        }
        return false;
    }
    std::uint32_t operator[](std::size_t l) const { return now_[l]; }

  private:
    std::vector<std::uint32_t> counts_, now_;
};

/// The step of the trace for an instance of a leaf.
template <class C>
std::uint32_t step_at(const Leaf& leaf, const C& counters) {
    std::uint32_t step = leaf.first;
    for (std::size_t l = 0; l < leaf.loops.size(); ++l) step += leaf.loops[l]->period * counters[l];
    return step;
}
inline std::vector<std::uint32_t> counts_of(const std::vector<const NestItem*>& loops) {
    std::vector<std::uint32_t> counts;
    for (const NestItem* loop : loops) counts.push_back(loop->count);
    return counts;
}

}  // namespace phasetree::glsl
