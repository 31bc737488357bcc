#include "phasetree/trace/tracer.hpp"

#include <cmath>
#include <limits>

#include "evaluation/assemble.hpp"
#include "trace/march.hpp"
#include "trace/normal.hpp"

namespace phasetree {

using evaluation::Assembly, evaluation::component;
using kernel::Curvature, kernel::LinearBound, kernel::Routine, kernel::Visit;
using trace::carried_by, trace::NormalOf;

InterfaceTracer::InterfaceTracer(const Phased& object, float resolution) {
    const TraceableObject t = prepare_to_trace(object, resolution);
    bounds_ = t.bounds;
    resolution_ = t.resolution;
    warning_ = t.warning;
    evaluator_ = std::make_shared<const Evaluator>(record(object));
}

InterfaceTracer::InterfaceTracer(const Phased& object, std::vector<HalfSpace> around, float resolution)
    : InterfaceTracer(object, resolution) {
    around_ = std::move(around);
}

namespace {

// What of [near, far] along a ray is within half-spaces, a little moved outward; far < near if nothing is.
void clip(const std::vector<HalfSpace>& around, double outward, const glm::vec3& origin, const glm::vec3& direction,
          float& near, float& far) {
    const glm::dvec3 o(origin), d(direction);
    double from = near, to = far;
    for (const HalfSpace& h : around) {
        const double away = h.distance(o) - outward, slope = glm::dot(h.normal, d);
        if (slope > 0)
            to = std::min(to, -away / slope);
        else if (slope < 0)
            from = std::max(from, -away / slope);
        else if (away > 0)
            to = from - 1;
    }
    // Rounded outward.
    if (from > near) near = std::nextafter(static_cast<float>(from), 0.f);
    if (to < far) far = std::nextafter(static_cast<float>(to), std::numeric_limits<float>::infinity());
    if (to < from) far = near - 1;
}

}  // namespace

std::optional<Crossing> InterfaceTracer::first_crossing(const glm::vec3& origin, const glm::vec3& direction,
                                                        float t_min, float t_max, std::optional<Phase> carried,
                                                        Evaluator::Workspace& w, TraceCounters* counters) const {
    TraceCounters unused;
    TraceCounters& c = counters ? *counters : unused;
    const Assembly& assembly = *evaluator_->assembly_;
    if (!around_.empty() && carried.value_or(vacuum) == vacuum) {
        // A ray in the vacuum meets nothing before it comes to the half-spaces, and none after it has left them.
        clip(around_, 4 * static_cast<double>(resolution_), origin, direction, t_min, t_max);
        if (t_max < t_min) return std::nullopt;
    }
    ++c.visits;
    const Routine routine = assembly.routine(evaluator_->program().constants.data());
    const TracedRay ray(origin, direction);
    const LinearBound none;
    return trace::first_crossing({.box = &bounds_,
                                  .bound = &none,
                                  .routine = &routine,
                                  .ray = &ray,
                                  .registers = w.registers(assembly.slots),
                                  .curvature = {Curvature::unknown, Curvature::unknown},
                                  .t_min = t_min,
                                  .t_max = t_max,
                                  .resolution = resolution_,
                                  .carried = carried_by(carried),
                                  .rise = Visit::no_leaving_hint},
                                 c);
}

glm::vec3 InterfaceTracer::normal(const Crossing& c, const glm::vec3& direction) const {
    const Assembly& assembly = *evaluator_->assembly_;
    const Routine routine = assembly.routine(evaluator_->program().constants.data());
    const auto component_at = [&](const glm::vec3& p, Phase phase) {
        return component(routine, assembly.slots, p, phase);
    };
    return NormalOf(c, direction, resolution_, component_at, [](const glm::vec3&) { return true; })().unit;
}

Phase InterfaceTracer::label(const glm::vec3& p, Evaluator::Workspace& w) const {
    return bounds_.contains(p) ? evaluator_->label(p, w) : vacuum;
}

}  // namespace phasetree
