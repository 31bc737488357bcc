#include "phasetree/evaluation/evaluator.hpp"

#include "evaluation/assemble.hpp"
#include "evaluation/batch_of_points.hpp"
#include "evaluation/component.hpp"
#include "evaluation/target.hpp"

namespace phasetree {

using evaluation::active_kernel, evaluation::assemble, evaluation::Assembly, evaluation::component;
using kernel::OutputSlot, kernel::Step;
using program::outputs_of;

Evaluator::Evaluator(Program program)
    : program_(std::move(program)),
      assembly_(std::make_shared<const Assembly>(assemble(program_.instructions, outputs_of(program_)))) {}

void Evaluator::evaluate(const BatchOfFloats& x, const BatchOfFloats& y, const BatchOfFloats& z,
                         std::span<BatchOfFloats> out, Workspace& w) const {
    active_kernel().evaluate(assembly_->routine(program_.constants.data()), x.lane.data(), y.lane.data(), z.lane.data(),
                             w.registers(assembly_->slots), out.data()->lane.data());
}

void Evaluator::sample(const BatchOfFloats& x, const BatchOfFloats& y, const BatchOfFloats& z, Samples& out,
                       Workspace& w) const {
    active_kernel().sample(assembly_->routine(program_.constants.data()), x.lane.data(), y.lane.data(), z.lane.data(),
                           w.registers(assembly_->slots), out.label.lane.data(), out.distance.lane.data());
}

void Evaluator::sample_ray(const glm::vec3& origin, const glm::vec3& direction, const BatchOfFloats& t, Samples& out,
                           Workspace& w) const {
    active_kernel().sample_ray(assembly_->routine(program_.constants.data()), &origin.x, &direction.x, t.lane.data(),
                               w.registers(assembly_->slots), out.label.lane.data(), out.distance.lane.data());
}

Phases<float> Evaluator::distances(const glm::vec3& p, Workspace& w) const {
    const auto [x, y, z] = evaluation::BatchOfPoints::all_at(p);
    std::vector<BatchOfFloats> out(program_.outputs.size());
    evaluate(x, y, z, out, w);
    Phases<float> result;
    for (std::size_t i = 0; i < out.size(); ++i) result.set(program_.outputs[i].phase.index, out[i][0]);
    return result;
}

Phase Evaluator::label(const glm::vec3& p, Workspace& w) const {
    return phasetree::label(distances(p, w));
}

glm::vec3 Evaluator::gradient(const glm::vec3& p, Phase phase) const {
    return component(assembly_->routine(program_.constants.data()), assembly_->slots, p, phase).gradient;
}

std::size_t Evaluator::bytes() const {
    return program_.bytes() + assembly_->steps.size() * (sizeof(Step) + sizeof(std::uint32_t)) +
           assembly_->outputs.size() * sizeof(OutputSlot) + sizeof(*this);
}

Evaluator::Workspace& Evaluator::thread_workspace() {
    thread_local Workspace w;
    return w;
}

}  // namespace phasetree
