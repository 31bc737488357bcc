#include "evaluation/component.hpp"
#include "evaluation/interpret.hpp"
#include "math/dual.hpp"

namespace phasetree::evaluation {

using kernel::OutputSlot;

Component component(const Routine& routine, std::uint32_t slots, const glm::vec3& p, Phase phase) {
    const OutputSlot* output = nullptr;
    for (std::size_t i = 0; i < routine.output_count; ++i)
        if (routine.outputs[i].phase == static_cast<float>(phase.index)) output = &routine.outputs[i];
    if (!output) return {};

    thread_local std::vector<Dual> registers;
    if (registers.size() < slots) registers.resize(slots);
    registers[0] = Dual(p.x, 1, 0, 0);
    registers[1] = Dual(p.y, 0, 1, 0);
    registers[2] = Dual(p.z, 0, 0, 1);
    interpret(
        RoutineSteps(routine), registers.data(),
        []<class P>(std::size_t, const float* constants, const Vec3<Dual>& q, Dual& to) {
            to = program::distance_of<P>(constants, q);
        },
        [](const Dual&) {});
    const Dual& found = registers[output->slot];
    return {found.value() * output->sign, found.gradient() * output->sign};
}

}  // namespace phasetree::evaluation
