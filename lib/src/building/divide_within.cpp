// Builds cells within a memory budget. The first attempt divides without restriction. If it exceeds the budget, the
// cells are built again from coarse to fine: first a single cell; then only boxes whose division saves a lot are
// divided; then also boxes that save less, as long as memory suffices. Each attempt takes about twice the memory and
// time of the previous one, so all of them together take about twice the time of the last. Each attempt also predicts
// the needs of the next, so that few fail.
#include "building/divide_within.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace phasetree::building {

namespace {

// The factor by which the least saving falls from one attempt to the next.
class ReductionFactor {
  public:
    // Chooses the factor so that memory about doubles. With the last factor, it grew by `growth`.
    void adapt(double growth) {
        const double doubling = growth > 1.01 ? std::pow(factor_, std::numbers::ln2 / std::log(growth)) : largest;
        last_growth_ = growth;
        last_factor_ = factor_;
        factor_ = std::clamp(doubling, smallest, largest);
    }
    bool is_smallest() const { return !(factor_ > smallest); }
    void set_smallest() { factor_ = smallest; }
    double get() const { return factor_; }
    // The expected growth of memory with this factor, as a power of the factor.
    double expected_growth() const {
        return std::pow(std::max(last_growth_, 1.0), std::log(factor_) / std::log(last_factor_));
    }

  private:
    static constexpr double smallest = std::numbers::sqrt2, largest = 4;
    double factor_ = 2, last_factor_ = 2, last_growth_ = 2;
};

}  // namespace

CellsWithinBudget divide_within(std::size_t limit_bytes, const Bounds& box, const WorkingProgram& program,
                                const BuildContext& context) {
    try {
        CellBudget budget(limit_bytes);
        return {divide_into_cells(box, program, context, budget)};
    } catch (const BudgetExceeded&) {
    }
    const auto limit = static_cast<double>(limit_bytes);
    constexpr auto infinity = std::numeric_limits<float>::infinity();
    CellBudget one_cell(std::numeric_limits<std::size_t>::max(), infinity);
    CellBuffers best = divide_into_cells(box, program, context, one_cell);
    float saving = one_cell.largest_refused_saving();
    double bytes = static_cast<double>(one_cell.charged_bytes());
    ReductionFactor factor;
    constexpr double enough = 0.7;
    while (saving > 0 && bytes < enough * limit) {
        if (bytes * factor.expected_growth() > limit && !factor.is_smallest()) factor.set_smallest();
        const double expected = bytes * factor.expected_growth();
        if (expected > limit) break;
        context.progress.start_attempt(expected / limit);
        CellBudget budget(limit_bytes, saving / static_cast<float>(factor.get()));
        try {
            best = divide_into_cells(box, program, context, budget);
        } catch (const BudgetExceeded&) {
            if (factor.is_smallest()) break;
            factor.set_smallest();
            continue;
        }
        factor.adapt(static_cast<double>(budget.charged_bytes()) / bytes);
        bytes = static_cast<double>(budget.charged_bytes());
        saving = budget.largest_refused_saving();
    }
    return {std::move(best), true};
}

}  // namespace phasetree::building
