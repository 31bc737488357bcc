#pragma once

#include "evaluation/batch_of_points.hpp"
#include "model/preparation.hpp"
#include "phasetree/evaluation/evaluator.hpp"

namespace phasetree::preparation {

using evaluation::BatchOfPoints;
using model::Preparation;

/// A field that a node evaluates to derive data. It is evaluated through its program; a walk through the tree could
/// take exponential time, because it visits a shared shape once per use. A Preparation pays for the work.
class PreparedField {
  public:
    /// Throws ModelError, naming the node, if the field has too many instructions.
    PreparedField(std::string_view node, const Field&, Preparation&);

    BatchOfFloats operator()(const BatchOfPoints&);
    /// The cost of one evaluation.
    std::uint64_t steps() const { return steps_; }

  private:
    Preparation& preparation_;
    Evaluator evaluator_;
    std::vector<BatchOfFloats> out_;
    Evaluator::Workspace registers_;
    std::uint64_t steps_;
};

}  // namespace phasetree::preparation
