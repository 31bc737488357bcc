#pragma once

#include <array>
#include <span>

#include "building/candidate.hpp"
#include "building/sub_boxes.hpp"
#include "evaluation/values_at_point.hpp"

namespace phasetree::building {

/// The boxes into which a node's box is divided, with what is left of its program in each. What they refer to lives in
/// the workers' arenas and in the node, which must outlive them.
class Children {
  public:
    /// Evaluates the node's program at the centres of the boxes. None of the children is prepared yet.
    Children(const BuildNode& parent, const BuildContext&, Worker&);

    /// The number of boxes, whether they are left or not.
    std::size_t count() const { return boxes_.count; }
    /// Makes a child ready: its program is pruned by the values in a ball around its box, and then in the box. Several
    /// threads may prepare different children, each with a worker of its own.
    void prepare(std::size_t i, Worker&);
    /// Whether a prepared child is left, that is, whether a ray can meet an interface in it.
    bool is_left(std::size_t i) const { return is_left_[i]; }
    std::ptrdiff_t left_count() const;
    /// A prepared child that is left.
    BuildNode& operator[](std::size_t i) { return nodes_[i]; }
    /// What rays pay if each child that is left becomes one cell, once all are prepared.
    float cost() const;

  private:
    const BuildNode& parent_;
    const BuildContext& context_;
    SubBoxes boxes_;
    evaluation::ValuesAtPoint values_;  // at the centre of the first box; those of the others are in the other lanes
    std::span<BuildNode> nodes_;
    bool has_jumps_;
    std::array<bool, SubBoxes::most> is_left_{};
};

}  // namespace phasetree::building
