#pragma once

#include "model/preparation.hpp"
#include "phasetree/evaluation/evaluator.hpp"

namespace phasetree::preparation {

using model::Preparation;

/// A batch of points.
struct BatchOfPoints {
    BatchOfFloats x{}, y{}, z{};

    void set(std::size_t lane, const glm::vec3& p) {
        x[lane] = p.x;
        y[lane] = p.y;
        z[lane] = p.z;
    }
};

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
