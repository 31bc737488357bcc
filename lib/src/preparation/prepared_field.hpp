#pragma once

#include "model/preparation.hpp"
#include "phasetree/evaluation/evaluator.hpp"

namespace phasetree::preparation {

using model::Preparation;

/// Points, one in each lane.
struct BatchOfPoints {
    BatchOfFloats x{}, y{}, z{};

    void set(std::size_t lane, const glm::vec3& p) {
        x[lane] = p.x;
        y[lane] = p.y;
        z[lane] = p.z;
    }
};

/// A field as a node evaluates it to prepare itself: by its program, in which a shared shape counts once a place, where
/// a walk through the tree might never end. What it does is paid for.
class PreparedField {
  public:
    /// Throws ModelError, said of the node, if the field takes too many instructions.
    PreparedField(std::string_view node, const Field&, Preparation&);

    BatchOfFloats operator()(const BatchOfPoints&);
    /// Of one evaluation.
    std::uint64_t steps() const { return steps_; }

  private:
    Preparation& preparation_;
    Evaluator evaluator_;
    std::vector<BatchOfFloats> out_;
    Evaluator::Workspace registers_;
    std::uint64_t steps_;
};

}  // namespace phasetree::preparation
