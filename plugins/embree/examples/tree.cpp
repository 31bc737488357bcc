// Builds and traces a bottle of water with the C++ library alone, and prints the phases along a ray.
#include <cstdio>
#include <optional>
#include <phasetree/phasetree.hpp>

int main() {
    using namespace phasetree;
    const Phase glass{1}, water{2};
    const Field bottle = SmoothUnion{
        .of = {Sphere{.radius = 1}, Capsule{.from = {0, 0, 0}, .to = {0, 0, 1.5f}, .radius = 0.3f}}, .radius = 0.4f};
    const Phased filled = ThinShell{.of = bottle, .shell = glass, .inside = water, .half_thickness = 0.03f};
    // Ends the water at z = 0.2, without changing the glass.
    const Phased object =
        IntersectShape{.of = filled, .shape = Plane{.offset = 0.2f}, .phases_cut = PhaseSet::of(water)};

    const InterfaceTracer tracer(object);
    Evaluator::Workspace workspace;
    const glm::vec3 origin(0, 0, 3), direction(0, 0, -1);
    std::optional<Phase> phase;  // initially the phase at the origin
    float t = 0;
    while (const auto crossing = tracer.first_crossing(origin, direction, t, 100, phase, workspace)) {
        // p_from is just before the interface, and t_to just past it.
        std::printf("z = %6.3f: from phase %d to phase %d\n", static_cast<double>(crossing->p_from.z),
                    crossing->from.index, crossing->to.index);
        phase = crossing->to;
        t = crossing->t_to;
    }
}
