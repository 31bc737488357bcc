#pragma once

#include <cstdint>
#include <string_view>

namespace phasetree::model {

/// The budget of work that a node may spend to derive data from its parameters, such as points on a surface or the
/// bound of a slope. Work is counted in steps. Running one instruction for a batch of points is one step, and other
/// work is counted in comparable units. 4·10⁸ steps take about a second.
class Preparation {
  public:
    explicit Preparation(std::string_view node) : node_(node) {}

    /// Pays for work; call it before doing the work. Throws ModelError if the work exceeds the budget of the node or of
    /// the scene being read.
    void pay(std::uint64_t steps);
    /// The steps that are left.
    std::uint64_t left() const { return most - paid_; }

    static constexpr std::uint64_t most = 400'000'000;

  private:
    std::string_view node_;
    std::uint64_t paid_ = 0;
};

/// The total budget of all nodes that this thread creates while the object exists. The scene reader holds one, because
/// a file of a thousand lines could otherwise demand the maximum work of a node a thousand times.
class PreparationTogether {
  public:
    PreparationTogether();
    ~PreparationTogether();
    PreparationTogether(const PreparationTogether&) = delete;
    PreparationTogether& operator=(const PreparationTogether&) = delete;

    /// Pays for work from this thread's current budget, if there is one. Throws ModelError, naming the node, if the
    /// budget is exceeded.
    static void pay(std::string_view node, std::uint64_t steps);

    /// The steps paid from this budget so far.
    std::uint64_t paid() const { return paid_; }

    static constexpr std::uint64_t most = 10 * Preparation::most;

  private:
    std::uint64_t paid_ = 0;
    PreparationTogether* around_;  ///< this thread's previous budget
};

}  // namespace phasetree::model
