// The density of a medium from a field φ of the tree: with a depth d > 0,
//     ρ(p) = min(max(−φ(p)/d, 0), 1).
// It is 0 at the field's surface and outside, and increases linearly to 1 within the depth d. So 1 is a majorant for
// any field, and the medium is empty outside of the field's bounds.
#pragma once

#include <memory>

#include "media/density_contract.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree::tracer {

class FieldDensity {
  public:
    /// The part of a ray segment within the field's bounds.
    class Stretches {
      public:
        Stretches(const Bounds& box, const Way& way);
        std::optional<DensityStretch> next() { return std::exchange(only_, std::nullopt); }
        float length() const { return length_; }

      private:
        std::optional<DensityStretch> only_{};
        float length_ = 0.0f;
    };

    /// Throws ModelError if the field cannot be recorded.
    FieldDensity(const Field& field, float depth);

    /// The field's program takes as long for eight points as for one.
    static constexpr std::size_t together = batch_size;
    BatchOfFloats at(const PointBatch& points, std::size_t count) const;
    const Bounds& bounds() const { return bounds_; }
    Stretches stretches(const Way& way) const { return {bounds_, way}; }

  private:
    std::shared_ptr<const Evaluator> evaluator_;
    Bounds bounds_;
    std::size_t outputs_;
    std::size_t field_output_;  ///< index of φ among the program's outputs
    float inverse_depth_;
};

}  // namespace phasetree::tracer
