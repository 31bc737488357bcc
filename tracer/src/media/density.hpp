// How dense a medium is at each point, from 0 to 1, by a field φ of the tree: with a depth d > 0
//     ρ(p) = min(max(−φ(p)/d, 0), 1).
// It is 0 at the field's surface and outside, and rises evenly to 1 within the depth d. So 1 is a majorant by itself,
// whatever the field is, and outside of the field's bounds there is nothing.
#pragma once

#include <memory>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/math/bounds.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree::tracer {

class Density {
  public:
    /// Throws ModelError for a field that cannot be recorded.
    Density(const Field& field, float depth);

    /// ρ at eight points.
    BatchOfFloats at(const BatchOfFloats& x, const BatchOfFloats& y, const BatchOfFloats& z) const;
    /// ρ at eight points of a ray, by one run of the field's program.
    BatchOfFloats along(const glm::vec3& origin, const glm::vec3& direction, const BatchOfFloats& t) const;
    /// A box outside of which ρ is 0.
    const Bounds& bounds() const { return bounds_; }

  private:
    std::shared_ptr<const Evaluator> evaluator_;
    Bounds bounds_;
    std::size_t outputs_;
    std::size_t field_output_;  ///< which of the program's outputs φ is
    float inverse_depth_;
};

}  // namespace phasetree::tracer
