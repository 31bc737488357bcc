#include "phasetree/trace/tracer.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "evaluation/assemble.hpp"
#include "math/clip_line.hpp"
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

// Clips [t_min, t_max] to the part of a ray within half-spaces, which are moved outwards slightly.
void clip(std::span<const HalfSpace> around, float outward, const glm::vec3& origin, const glm::vec3& direction,
          float& t_min, float& t_max) {
    double near = static_cast<double>(t_min), far = static_cast<double>(t_max);
    clip_line(around, glm::dvec3(origin), glm::dvec3(direction), near, far, static_cast<double>(outward));
    // Move outwards by more than the error of rounding to floats.
    t_min = std::max(t_min, static_cast<float>(near - 1.2e-7 * std::abs(near)));
    t_max = std::min(t_max, static_cast<float>(far + 1.2e-7 * std::abs(far)));
}

}  // namespace

std::optional<Crossing> InterfaceTracer::first_crossing(const glm::vec3& origin, const glm::vec3& direction,
                                                        float t_min, float t_max, std::optional<Phase> carried,
                                                        Evaluator::Workspace& w, TraceCounters* counters) const {
    TraceCounters unused;
    TraceCounters& c = counters ? *counters : unused;
    const Assembly& assembly = *evaluator_->assembly_;
    if (!around_.empty() && carried.value_or(vacuum) == vacuum) {
        // A ray in the vacuum meets nothing before it enters the half-spaces, and nothing after it leaves them.
        clip(around_, 8 * resolution_, origin, direction, t_min, t_max);
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
