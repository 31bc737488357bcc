#include "media/field_density.hpp"

#include <algorithm>
#include <array>

#include "phasetree/program/program.hpp"

namespace phasetree::tracer {

FieldDensity::Stretches::Stretches(const Bounds& box, const Way& way) {
    const auto [from, to] = part_within(box, way);
    if (!(from < to)) return;
    only_ = {from, to, 1.0f};
    length_ = to - from;
}

FieldDensity::FieldDensity(const Field& field, float depth)
    : evaluator_(std::make_shared<const Evaluator>(record(field))),
      bounds_(phasetree::bounds(field)),
      inverse_depth_(1.0f / depth) {
    const std::vector<Output>& outputs = evaluator_->program().outputs;
    outputs_ = outputs.size();
    field_output_ = static_cast<std::size_t>(
        std::ranges::find_if(outputs, [](const Output& o) { return o.phase != vacuum; }) - outputs.begin());
}

BatchOfFloats FieldDensity::at(const PointBatch& points, std::size_t) const {
    // A recorded field has two outputs: its phase and the vacuum.
    std::array<BatchOfFloats, 2> values;
    evaluator_->evaluate(points.x, points.y, points.z, std::span(values).first(outputs_),
                         Evaluator::thread_workspace());
    BatchOfFloats density = values[field_output_];
    for (std::size_t i = 0; i < batch_size; ++i) density[i] = std::clamp(-density[i] * inverse_depth_, 0.0f, 1.0f);
    return density;
}

}  // namespace phasetree::tracer
