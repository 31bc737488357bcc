// The value of a field of the tree at a point, such as the distance to another phase.
#pragma once

#include <glm/vec3.hpp>
#include <memory>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree::tracer {

class FieldValue {
  public:
    /// Without a field: 0 everywhere.
    FieldValue() = default;
    /// Throws ModelError if the field cannot be recorded.
    explicit FieldValue(const Field& field);

    float at(const glm::vec3& p) const;

  private:
    std::shared_ptr<const Evaluator> evaluator_;
};

}  // namespace phasetree::tracer
