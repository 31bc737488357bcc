#pragma once

#include <cstdint>
#include <set>
#include <string_view>

#include "phasetree/model/preparation_watch.hpp"

namespace phasetree::model {

/// The budget of work that a node may spend to derive data from its parameters, such as points on a surface or the
/// bound of a slope. Work is counted in steps. Running one instruction for a batch of points is one step, and other
/// work is counted in comparable units. 4·10⁸ steps take about a second.
///
/// It also lets the current PreparationWatch cancel the work and see its progress.
class Preparation {
  public:
    /// Work in proportion to the size of a file is allowed in addition to the budget: `granted` steps, once for each
    /// content in a scene.
    explicit Preparation(std::string_view node) : node_(node), watch_(PreparationWatch::current()) {}
    Preparation(std::string_view node, const void* content, std::uint64_t granted);

    /// Pays for work; call it before doing the work. Throws ModelError if the work exceeds the budget of the node or of
    /// the scene being read, and PreparationCancelled.
    void pay(std::uint64_t steps);
    /// The steps that are left.
    std::uint64_t left() const { return granted_ + most - paid_; }

    /// Throws PreparationCancelled if the work is to be cancelled. Thread-safe.
    void poll() const {
        if (watch_ && watch_->cancelled && watch_->cancelled()) throw PreparationCancelled();
    }
    /// Reports the completed share of the work. Throws PreparationCancelled.
    void tell(float share) const {
        poll();
        if (watch_ && watch_->progress) watch_->progress(node_, share);
    }

    static constexpr std::uint64_t most = 400'000'000;

  private:
    std::string_view node_;
    const PreparationWatch::Callbacks* watch_;
    std::uint64_t granted_ = 0, paid_ = 0;
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
    /// Adds steps to this thread's current budget, but only once for each content.
    static void grant(const void* content, std::uint64_t steps);

    /// The steps paid from this budget so far, without those that were granted.
    std::uint64_t paid() const { return paid_; }

    static constexpr std::uint64_t most = 10 * Preparation::most;

  private:
    std::uint64_t paid_ = 0, granted_ = 0;  ///< `granted_` is what is left of it
    std::set<const void*> contents_;        ///< that were granted steps
    PreparationTogether* around_;           ///< this thread's previous budget
};

}  // namespace phasetree::model
