#include "shading/texture/field_value.hpp"

#include "phasetree/program/program.hpp"

namespace phasetree::tracer {

FieldValue::FieldValue(const Field& field) : evaluator_(std::make_shared<const Evaluator>(record(field))) {}

float FieldValue::at(const glm::vec3& p) const {
    if (evaluator_ == nullptr) return 0.0f;
    // A field is recorded as the object with phase 1.
    return evaluator_->distances(p, Evaluator::thread_workspace())[1];
}

}  // namespace phasetree::tracer
