// Changes to a geometry: its tree, its shown phases, and its motion.

#include <algorithm>
#include <cmath>

#include "api/build.hpp"
#include "api/tree_data.hpp"

namespace phasetree::embree::api {

namespace {

// Whether a geometry's time range overlaps the shutter. If it does not, Embree cannot build the scene: version 3.13
// ends the program or builds forever. An overlap that rounding may eliminate counts as none.
bool meets_shutter(float start, float end) {
    constexpr double least = 1e-6;  // as a fraction of the range
    const double length = static_cast<double>(end) - static_cast<double>(start);
    return (1.0 - static_cast<double>(start)) / length > least && static_cast<double>(end) / length > least;
}

Motion motion_of(const float* transforms, unsigned count, float start, float end) {
    if (count == 0) return {};
    require(transforms, "transforms");
    if (count > RTC_MAX_TIME_STEP_COUNT)
        throw invalid("timeStepCount is {}; Embree allows at most {}", count, RTC_MAX_TIME_STEP_COUNT);
    if (count > 1 && !(std::isfinite(start) && std::isfinite(end) && start < end))
        throw invalid("startTime {} must be before endTime {}", start, end);
    if (count > 1 && !meets_shutter(start, end))
        throw invalid("the interval from startTime {} to endTime {} does not meet the shutter interval, 0 to 1", start,
                      end);
    std::vector<Motion::Step> steps;
    for (unsigned i = 0; i < count; ++i) {
        const float* m = transforms + 12 * i;
        if (!std::all_of(m, m + 12, [](float v) { return std::isfinite(v); }))
            throw invalid("the transform of time step {} has an entry that is not finite", i);
        const auto placement = Placement::of(m);
        if (!placement) throw invalid("the transform of time step {} has no inverse", i);
        steps.push_back({placement->linear, placement->translation});
    }
    return {std::move(steps), start, end};
}

}  // namespace

Placement placement_at(const GeometryData& data, float time) {
    const auto placement = data.motion.at(time);
    if (!placement) throw not_now(fmt::format("at time {} the interpolated transform has no inverse", time));
    return *placement;
}

}  // namespace phasetree::embree::api

using namespace phasetree;
using namespace phasetree::embree;
using namespace phasetree::embree::api;

PhasetreeError phasetreeSetGeometryTree(PhasetreeGeometry geometry, PhasetreeTree tree,
                                        const PhasetreeGeometryOptions* options) {
    return guarded_call(__func__, [&] {
        GeometryData& data = api::data_of(geometry);
        const PhasetreeGeometryOptions o = checked(options);
        if (data.has_cell_primitives()) require_all_shown(o.shownPhases);
        data.set_object(build_object(data.device, api::data_of(tree).tree.object, o, data.flags));
        data.shown = {o.shownPhases};
    });
}

PhasetreeError phasetreeSetGeometryShownPhases(PhasetreeGeometry geometry, PhasetreePhaseSet shown) {
    return guarded_call(__func__, [&] {
        GeometryData& data = api::data_of(geometry);
        require_shown(data.object->cells().opaque().bits, shown);
        if (data.has_cell_primitives() && !shows_all({shown}))
            throw not_now("a geometry with PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES shows all phases");
        data.shown = {shown};
    });
}

PhasetreeError phasetreeSetGeometryMotion(PhasetreeGeometry geometry, const float* transforms, unsigned int count,
                                          float start, float end) {
    return guarded_call(__func__, [&] {
        GeometryData& data = api::data_of(geometry);
        if (data.has_cell_primitives())
            throw not_now("a geometry with PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES cannot move; put it in an instance");
        data.motion = motion_of(transforms, count, start, end);
        rtcSetGeometryTimeStepCount(data.handle, data.motion.steps());
        rtcSetGeometryTimeRange(data.handle, count > 1 ? start : 0.0f, count > 1 ? end : 1.0f);
    });
}
