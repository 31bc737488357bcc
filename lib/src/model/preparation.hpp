#pragma once

#include <cstdint>
#include <string_view>

namespace phasetree::model {

/// How much work a node may do to derive what it needs: places on a surface, the bound of a slope. It is counted in
/// steps, an instruction run for a batch of points or about as much of other work; 4·10⁸ take about a second.
class Preparation {
  public:
    explicit Preparation(std::string_view node) : node_(node) {}

    /// Before the work is done. Throws ModelError if it is too much for the node, or for the scene that is being read.
    void pay(std::uint64_t steps);
    std::uint64_t left() const { return most - paid_; }

    static constexpr std::uint64_t most = 400'000'000;

  private:
    std::string_view node_;
    std::uint64_t paid_ = 0;
};

/// As long as it exists, all nodes that this thread makes may do so much work together: what reads a scene holds one,
/// because a file of a thousand lines can ask for all that a node may do a thousand times.
class PreparationTogether {
  public:
    PreparationTogether();
    ~PreparationTogether();
    PreparationTogether(const PreparationTogether&) = delete;
    PreparationTogether& operator=(const PreparationTogether&) = delete;

    /// The one that this thread holds, if it does, pays so much; throws ModelError, said of the node.
    static void pay(std::string_view node, std::uint64_t steps);

    static constexpr std::uint64_t most = 10 * Preparation::most;

  private:
    std::uint64_t paid_ = 0;
    PreparationTogether* around_;
};

}  // namespace phasetree::model
