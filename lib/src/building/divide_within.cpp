// Cells within a budget. First without a thought of it. If they exceed it, again, and from the coarse side: one cell;
// then such boxes are divided as cost rays much, then such as cost less, as long as the memory will do. Each division
// takes about twice the memory and time of the one before, so all together as much time as two of the last; and each
// tells about what the next will take, so that few are in vain.
#include "building/divide_within.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace phasetree::building {

namespace {

/// By what the least saving is divided from one division to the next.
class Finer {
  public:
    /// Such that the memory about doubles, as far as the last step tells.
    void learn(double growth) {
        const double aimed = growth > 1.01 ? std::pow(factor_, std::numbers::ln2 / std::log(growth)) : most;
        growth_ = growth;
        last_ = factor_;
        factor_ = std::clamp(aimed, least, most);
    }
    bool can_be_less() const { return factor_ > least; }
    void be_least() { factor_ = least; }
    double factor() const { return factor_; }
    /// What the memory will grow by.
    double growth() const { return std::pow(std::max(growth_, 1.0), std::log(factor_) / std::log(last_)); }

  private:
    static constexpr double least = std::numbers::sqrt2, most = 4;
    double factor_ = 2, last_ = 2, growth_ = 2;
};

}  // namespace

CellsWithinBudget divide_within(std::size_t bytes, const Bounds& box, const WorkingProgram& program,
                                const BuildContext& d) {
    try {
        CellBudget budget(bytes);
        return {divide_into_cells(box, program, d, budget)};
    } catch (const BudgetExceeded&) {
    }
    constexpr auto infinity = std::numeric_limits<float>::infinity();
    CellBudget one_cell(std::numeric_limits<std::size_t>::max(), infinity);
    CellBuffers best = divide_into_cells(box, program, d, one_cell);
    float saving = one_cell.most_left();
    double paid = static_cast<double>(one_cell.paid());
    Finer step;
    constexpr double enough = 0.7;
    while (saving > 0 && paid < enough * static_cast<double>(bytes)) {
        if (paid * step.growth() > static_cast<double>(bytes) && step.can_be_less()) step.be_least();
        const double expected = paid * step.growth();
        if (expected > static_cast<double>(bytes)) break;
        d.progress.start_again(expected / static_cast<double>(bytes));
        CellBudget budget(bytes, saving / static_cast<float>(step.factor()));
        try {
            best = divide_into_cells(box, program, d, budget);
        } catch (const BudgetExceeded&) {
            if (!step.can_be_less()) break;
            step.be_least();
            continue;
        }
        step.learn(static_cast<double>(budget.paid()) / paid);
        paid = static_cast<double>(budget.paid());
        saving = budget.most_left();
    }
    return {std::move(best), true};
}

}  // namespace phasetree::building
