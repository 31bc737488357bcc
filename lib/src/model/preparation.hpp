#pragma once

#include <cstdint>
#include <string_view>

namespace phasetree::model {

/// The budget of work that a node may spend to derive what it needs from its parameters, such as points on a surface or
/// the bound of a slope. Work is counted in steps: an instruction that is run for a batch of points is one, and so is
/// about as much of other work. 4·10⁸ steps take about a second.
class Preparation {
  public:
    explicit Preparation(std::string_view node) : node_(node) {}

    /// Pays for work, and must be called before the work is done. Throws ModelError if it is too much for the node, or
    /// for the scene that is being read.
    void pay(std::uint64_t steps);
    /// The steps that are left.
    std::uint64_t left() const { return most - paid_; }

    static constexpr std::uint64_t most = 400'000'000;

  private:
    std::string_view node_;
    std::uint64_t paid_ = 0;
};

/// The budget of all nodes together that this thread makes while the object exists. The reader of scenes holds one,
/// because a file of a thousand lines could ask a thousand times for all that one node may do.
class PreparationTogether {
  public:
    PreparationTogether();
    ~PreparationTogether();
    PreparationTogether(const PreparationTogether&) = delete;
    PreparationTogether& operator=(const PreparationTogether&) = delete;

    /// Pays for work from the budget that this thread holds, if there is one. Throws ModelError, which names the node,
    /// if it is too much.
    static void pay(std::string_view node, std::uint64_t steps);

    /// What was paid so far from this budget.
    std::uint64_t paid() const { return paid_; }

    static constexpr std::uint64_t most = 10 * Preparation::most;

  private:
    std::uint64_t paid_ = 0;
    PreparationTogether* around_;  ///< the budget that the thread held before
};

}  // namespace phasetree::model
