// The paper's Figure 21: the step sizes along a ray. Compares three methods for one ray through the glass and the sand
// of the hourglass: steps by the smallest |φᵢ|, as in the paper; steps by the interface distance, the second smallest
// component including the vacuum's; and cells, with eight samples at a time.
//
// The values along the ray are written to the JSON for the plot.
#include <fmt/format.h>

#include "commands/commands.hpp"
#include "objects/scene_file.hpp"
#include "rays/camera_rays.hpp"
#include "trace/field_scene.hpp"

namespace phasetree::bench {

namespace {

struct AtPoint {
    Phase label;
    double least_magnitude = 1e30, interface_distance = 1e30;
};

AtPoint look(const InterfaceCells& cells, const glm::vec3& p, Evaluator::Workspace& workspace) {
    const Phases<float> phi = cells.whole().distances(p, workspace);
    AtPoint at{label(phi), 1e30, 1e30};
    double first = 1e30;
    for_each_phase(phi.present, [&](int i) {
        const auto value = static_cast<double>(phi[i]);
        at.least_magnitude = std::min(at.least_magnitude, std::abs(value));
        at.interface_distance = std::min(at.interface_distance, std::max(first, value));
        first = std::min(first, value);
    });
    return at;
}

struct Walk {
    std::vector<double> steps;  // distances from the origin at which the field was evaluated
    std::size_t crossings = 0;
};

// Sphere tracing from phase to phase: no step is shorter than the resolution, and a change of label is a crossing.
Walk walked(const InterfaceCells& cells, const Ray& ray, double until, double AtPoint::*step) {
    Walk walk;
    Evaluator::Workspace workspace;
    std::optional<Phase> phase;
    for (double t = 0; t < until;) {
        const AtPoint at = look(cells, ray.origin + static_cast<float>(t) * ray.direction, workspace);
        walk.steps.push_back(t);
        walk.crossings += phase && *phase != at.label;
        phase = at.label;
        t += std::max(at.*step, static_cast<double>(cells.resolution()));
    }
    return walk;
}

}  // namespace

Report march(const Settings&) {
    Report report("march", "one ray through the hourglass, from phase to phase (Figure 21)");
    const tracer::Scene scene = scene_file("hourglass");
    const FieldScene field(scene.object);
    const InterfaceCells& cells = field.cells();
    const Bounds& box = cells.bounds();
    // From the left, slightly above the neck, through both walls of the bulb and the sand, past a rod.
    const Ray ray{glm::vec3(box.low.x - 0.3f, -0.12f, 0.3f), glm::normalize(glm::vec3(1, 0.06f, 0.02f)), vacuum};
    const double until = static_cast<double>(box.extent().x) + 0.6;
    report.say("evaluations: of all components at one point, or of eight points together for cells");

    Walk by_cells;
    std::size_t batches = 0;
    Ray at = ray;
    Table crossings({{"t", "t", "{:.6f}"}, {"from", "from", "{:.0f}"}, {"to", "to", "{:.0f}"}});
    double from = 0;
    while (const auto hit = field.intersect(at)) {
        batches += field.counters(std::span(&at, 1)).batches;
        ++by_cells.crossings;
        from += static_cast<double>(hit->t_to);
        crossings.row({from, double(hit->from.index), double(hit->to.index)});
        at.origin = hit->p_to;
        at.carried = hit->to;
    }
    batches += field.counters(std::span(&at, 1)).batches;
    const Walk paper = walked(cells, ray, until, &AtPoint::least_magnitude),
               ours = walked(cells, ray, until, &AtPoint::interface_distance);
    Table table({{"way", "way", ""}, {"evaluations", "evaluations", "{:.0f}"}, {"crossings", "crossings", "{:.0f}"}});
    table.row({std::string("least |φᵢ|"), double(paper.steps.size()), double(paper.crossings)});
    table.row({std::string("interface distance"), double(ours.steps.size()), double(ours.crossings)});
    table.row({std::string("cells, batches of eight"), double(batches), double(by_cells.crossings)});
    report.table("ways", table);
    report.table("crossings", crossings);

    Table profile({{"t", "t", "{:.4f}"},
                   {"phase", "phase", "{:.0f}"},
                   {"least", "least |φᵢ|", "{:.5f}"},
                   {"interface", "s", "{:.5f}"}});
    Evaluator::Workspace workspace;
    for (int i = 0; i <= 800; ++i) {
        const double t = until * i / 800;
        const AtPoint p = look(cells, ray.origin + static_cast<float>(t) * ray.direction, workspace);
        profile.row({t, double(p.label.index), p.least_magnitude, p.interface_distance});
    }
    report.keep("profile", profile);
    Table steps({{"way", "way", ""}, {"t", "t", "{:.5f}"}});
    for (const double t : paper.steps) steps.row({std::string("least"), t});
    for (const double t : ours.steps) steps.row({std::string("interface"), t});
    report.keep("steps", steps);
    report.check("all three find the same crossings",
                 paper.crossings == ours.crossings && ours.crossings == by_cells.crossings,
                 fmt::format("{}, {} and {}", paper.crossings, ours.crossings, by_cells.crossings));
    return report;
}

}  // namespace phasetree::bench
