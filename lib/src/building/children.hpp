#pragma once

#include <array>
#include <span>

#include "building/candidate.hpp"
#include "building/sub_boxes.hpp"
#include "evaluation/values_at_point.hpp"

namespace phasetree::building {

/// The boxes into which a node's box is divided, each with the part of the program that is left in it. They refer to
/// memory in the workers' arenas and in the node, which must outlive them.
class Children {
  public:
    /// Evaluates the node's program at the centres of the boxes. No child is prepared yet.
    Children(const BuildNode& parent, const BuildContext&, Worker&);

    /// The number of boxes, including those without interfaces.
    std::size_t count() const { return boxes_.count; }
    /// Prepares a child: prunes its program first by the values in a ball around its box, and then in the box. Several
    /// threads may prepare different children, each with its own worker.
    void prepare(std::size_t i, Worker&);
    /// Whether a ray can meet an interface in this child, which must be prepared.
    bool is_left(std::size_t i) const { return is_left_[i]; }
    std::ptrdiff_t left_count() const;
    /// A prepared child for which is_left() is true.
    BuildNode& operator[](std::size_t i) { return nodes_[i]; }
    /// The cost to rays if each child that is left becomes one cell. All must be prepared.
    float cost() const;

  private:
    const BuildNode& parent_;
    const BuildContext& context_;
    SubBoxes boxes_;
    evaluation::ValuesAtPoint values_;  // at the centre of the first box; other lanes hold those of the other boxes
    std::span<BuildNode> nodes_;
    bool has_jumps_;
    std::array<bool, SubBoxes::most> is_left_{};
};

}  // namespace phasetree::building
