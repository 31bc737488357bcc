#pragma once

#include <optional>
#include <span>

#include "building/sub_boxes.hpp"
#include "building/worker_pool.hpp"
#include "measuring/cut_box.hpp"
#include "pruning/prune.hpp"
#include "rewriting/specialise.hpp"

namespace phasetree::measuring {

using building::SubBoxes, building::Worker;
using rewriting::ProgramContext, rewriting::RequiredOfLocal, rewriting::Specialisation, rewriting::WorkingProgram;

/// Constant data of a measurement.
struct MeasureContext {
    ProgramContext program;
    std::array<double, 3> origin{};  ///< from which coordinates are measured
    float resolution = 0;            ///< in the scene's unit of length
};

/// A box, with the part of the object's program that is left in it after pruning.
struct Node {
    Bounds box;
    WorkingProgram program;
    std::span<const Specialisation> specialisations{};  ///< for this box; until it is examined, for its parent
    std::span<const RequiredOfLocal> required{};        ///< limits up to which values of local primitives matter here
};

/// A phase that may be in a box: the part of the box that it certainly contains, and the part that may contain it.
struct PhaseInBox {
    Phase phase;
    PartOfBox certain, possible;
    /// A linear function near the phase's component φₖ, and an upper bound of the difference; infinite if unknown.
    LinearInBox component;
    double slack = 0;
    /// Directions in which the component does not rise anywhere in the box: bit 2i towards lower coordinates along axis
    /// i, bit 2i + 1 towards higher ones.
    std::uint8_t falls = 0;
    /// The least value of the component at the sampled points in the phase, and the number of the point where it
    /// occurs.
    double deepest = 0;
    std::uint8_t deepest_at = 0;

    double doubt() const { return std::max(0.0, possible.moments[0] - certain.moments[0]); }
    /// Whether the phase may be in the box: false if its component is certainly positive in all of it.
    bool is_possible() const;
};

/// The points of a box at which its components are sampled.
std::array<glm::vec3, batch_size> sampled_points(const Bounds& box);

/// What is known about a box.
struct ExaminedBox {
    Node node;
    std::optional<Phase> only{};         ///< the phase that contains all of the box, if it is known
    std::span<PhaseInBox> phases{};      ///< otherwise, those that may be there
    std::span<double> mean_component{};  ///< for each of these, an estimate of the mean of its component in the box
    std::span<int> votes{};              ///< for each of these, how many of eight points in the box are in it
    bool can_be_divided = true;          ///< whether smaller boxes may say more
};

/// The boxes into which a node's box is divided. It refers to memory in the worker's arenas.
class Division {
  public:
    /// Evaluates the node's program at the centres of the boxes.
    Division(const Node&, const MeasureContext&, Worker&);

    std::size_t count() const { return boxes_.count; }
    /// Prunes the program for box i, first by the ranges of its values in the ball around the box, then by enclosures
    /// of its values in the box itself. The result is in the worker's arena of programs.
    ExaminedBox examine(std::size_t i) const;

  private:
    std::optional<Phase> phase_at_centre(std::size_t i) const;

    const Node& parent_;
    const MeasureContext& context_;
    Worker& worker_;
    SubBoxes boxes_;
    evaluation::ValuesAtPoint values_;  // at the centre of the first box; other lanes hold those of the other boxes
    bool has_jumps_;
};

}  // namespace phasetree::measuring
