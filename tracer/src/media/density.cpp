#include "media/density.hpp"

#include <algorithm>
#include <array>

#include "phasetree/program/program.hpp"

namespace phasetree::tracer {

Density::Density(const Field& field, float depth)
    : evaluator_(std::make_shared<const Evaluator>(record(field))),
      bounds_(phasetree::bounds(field)),
      inverse_depth_(1.0f / depth) {
    const std::vector<Output>& outputs = evaluator_->program().outputs;
    outputs_ = outputs.size();
    field_output_ = static_cast<std::size_t>(
        std::ranges::find_if(outputs, [](const Output& o) { return o.phase != vacuum; }) - outputs.begin());
}

BatchOfFloats Density::along(const glm::vec3& origin, const glm::vec3& direction, const BatchOfFloats& t) const {
    BatchOfFloats x, y, z;
    for (std::size_t i = 0; i < batch_size; ++i) {
        x[i] = origin.x + t[i] * direction.x;
        y[i] = origin.y + t[i] * direction.y;
        z[i] = origin.z + t[i] * direction.z;
    }
    return at(x, y, z);
}

BatchOfFloats Density::at(const BatchOfFloats& x, const BatchOfFloats& y, const BatchOfFloats& z) const {
    // Those of a recorded field are two: its phase and the vacuum.
    std::array<BatchOfFloats, 2> values;
    evaluator_->evaluate(x, y, z, std::span(values).first(outputs_), Evaluator::thread_workspace());
    BatchOfFloats density = values[field_output_];
    for (std::size_t i = 0; i < batch_size; ++i) density[i] = std::clamp(-density[i] * inverse_depth_, 0.0f, 1.0f);
    return density;
}

}  // namespace phasetree::tracer
