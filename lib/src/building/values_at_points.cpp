#include "building/values_at_points.hpp"

#include "evaluation/batch_of_points.hpp"
#include "evaluation/target.hpp"
#include "rewriting/readable_steps.hpp"

namespace phasetree::building {

using evaluation::active_kernel, evaluation::BatchOfPoints, evaluation::ValuesAtPoint;
using rewriting::readable_steps, rewriting::ReadableSteps, rewriting::Specialisation, rewriting::specialised,
    rewriting::WorkingProgram;

ValuesAtPoint values_at_points(const WorkingProgram& general, std::span<const Specialisation> specialisations,
                               std::span<const glm::vec3> points, Worker& worker) {
    SharedConstants& constants = worker.pool.constants();
    std::size_t count = 0;
    for (const Specialisation& s : specialisations) count += s.data.size();
    worker.specialised.clear();
    const WorkingProgram program = specialised(general, specialisations, worker.specialised, worker.scratch,
                                               constants.first_behind(worker.number, count));
    const ReadableSteps steps = readable_steps(program, worker.scratch);
    const auto batch = BatchOfPoints::of(points);
    const std::span<BatchOfFloats> registers = worker.scratch.allocate<BatchOfFloats>(steps.slots);
    const float* const all = constants.with(worker.specialised, worker.number, worker.constants);
    active_kernel().evaluate(steps.routine(all), batch.x.lane.data(), batch.y.lane.data(), batch.z.lane.data(),
                             registers.data()->lane.data(), nullptr);
    return {registers.data(), steps.slot, 0};
}

}  // namespace phasetree::building
