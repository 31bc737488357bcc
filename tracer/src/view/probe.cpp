#include "view/probe.hpp"

#include <limits>

#include "phasetree/math/float_mode.hpp"
#include "phasetree/tree/value_source.hpp"

namespace phasetree::tracer::view {

namespace {

// Fills in the ray's crossings of the object.
void follow(const Prepared& prepared, Probed& result) {
    const PhaseNames& names = prepared.scene().phases;
    const InterfaceTracer& tracer = prepared.tracer();
    Evaluator::Workspace& workspace = Evaluator::thread_workspace();
    glm::vec3 from = result.origin;
    Phase phase = tracer.label(from, workspace);
    result.start = names[phase];
    while (const auto crossing =
               tracer.first_crossing(from, result.direction, 0, std::numeric_limits<float>::max(), phase, workspace)) {
        if (result.crossings.size() == Probed::most) {
            result.has_more = true;
            return;
        }
        const float distance = glm::dot(crossing->p_from - result.origin, result.direction);
        result.crossings.push_back({distance, names[crossing->from], names[crossing->to]});
        from = crossing->p_to;
        phase = crossing->to;
    }
}

std::vector<ProbedNode> path_to(const ViewedScene& viewed, const Phased& object, const glm::vec3& p, Phase phase) {
    std::vector<ProbedNode> path;
    for (const NodeOnPath& step : value_source(object, p, phase)) {
        ProbedNode node{.name = std::string(step.name), .file = {}, .pointer = {}};
        if (const auto place = viewed.place_of(step.node)) {
            node.file = place->file;
            node.line = place->line;
            node.column = place->column;
            const auto member = viewed.numbers.members.find(place->offset);
            if (place->file == viewed.scene.file && member != viewed.numbers.members.end())
                node.pointer = member->second;
        }
        path.push_back(node);
    }
    return path;
}

// Fills in what the ray hits first: the object, or a mesh before it.
void meet(const ViewedScene& viewed, const Prepared& prepared, Probed& result) {
    const World& world = prepared.world();
    PathCounters counters;
    const Ray ray{result.origin, result.direction, world.geometry().label(result.origin), {}};
    const Hit hit = world.geometry().intersect(ray, counters);
    const auto* surface = std::get_if<Surface>(&hit);
    if (!surface) return;
    result.point = result.origin + surface->distance * result.direction;
    if (surface->object == 0) {
        const Phase entered = surface->entered.value();
        result.met = prepared.scene().phases[entered];
        try {
            result.path = path_to(viewed, prepared.scene().object, surface->near_side.origin, entered);
        } catch (const ModelError&) {
            // The tree has too many nodes; report the rest.
        }
    } else {
        result.met = prepared.scene().meshes[surface->object - 1].name;
    }
    const Phases<float> phi = prepared.world().geometry().object().whole().distances(surface->near_side.origin,
                                                                                     Evaluator::thread_workspace());
    const std::vector<std::string>& names = prepared.scene().phases.names;
    for (std::size_t i = 0; i < names.size(); ++i)
        if (phi.has(static_cast<int>(i))) result.distances.push_back({names[i], phi[static_cast<int>(i)]});
}

}  // namespace

Probed probe(const Picture& picture, const glm::vec2& place) {
    const FlushSubnormals flush;
    const Camera camera(picture.camera, picture.viewed->scene.film.resolution());
    // The middle of the unit square is the middle of the lens.
    const CameraRay ray = camera.generate(place, glm::vec2(0.5f));
    Probed result;
    result.origin = ray.origin;
    result.direction = ray.direction;
    meet(*picture.viewed, *picture.prepared, result);
    if (picture.prepared->world().geometry().object().size() > 0) follow(*picture.prepared, result);
    return result;
}

}  // namespace phasetree::tracer::view
