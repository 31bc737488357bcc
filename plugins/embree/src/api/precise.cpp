// Phases, safe distances and crossings in double precision.
#include "phasetree/embree/precise.h"

#include <cmath>

#include "api/tree_data.hpp"
#include "phasetree/building/options.hpp"
#include "phasetree/cells/cells.hpp"

namespace phasetree::embree::api {

const PreciseEvaluator& PreciseTree::evaluator(const Phased& object) {
    std::call_once(evaluator_made_, [&] { evaluator_.emplace(object); });
    return *evaluator_;
}
const PreciseTracer& PreciseTree::tracer(const Phased& object) {
    std::call_once(tracer_made_, [&] { tracer_.emplace(object); });
    return *tracer_;
}

namespace {

void copy(const glm::dvec3& from, double* to) {
    for (int i = 0; i < 3; ++i) to[i] = from[i];
}
glm::dvec3 vector_of(const double* from) {
    return {from[0], from[1], from[2]};
}
bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::vector<glm::dvec3> checked_points(const double* points, std::size_t count) {
    if (count > 0) require(points, "points");
    std::vector<glm::dvec3> all(count);
    for (std::size_t i = 0; i < count; ++i) {
        all[i] = vector_of(points + 3 * i);
        if (!is_finite(all[i])) throw invalid("point {} has a coordinate that is not finite", i);
    }
    return all;
}

std::vector<PreciseRay> checked_rays(const PhasetreePreciseRay* rays, std::size_t count, std::size_t phases) {
    if (count > 0) require(rays, "rays");
    std::vector<PreciseRay> all(count);
    for (std::size_t i = 0; i < count; ++i) {
        const PhasetreePreciseRay& r = rays[i];
        all[i] = {vector_of(r.origin), vector_of(r.direction), r.tMax, std::nullopt};
        if (!is_finite(all[i].origin) || !is_finite(all[i].direction))
            throw invalid("ray {} has a number that is not finite", i);
        if (all[i].direction == glm::dvec3(0)) throw invalid("ray {} has a direction of length 0", i);
        if (std::isnan(r.tMax)) throw invalid("ray {} has a tMax that is not a number", i);
        if (r.carried == PHASETREE_UNKNOWN_PHASE) continue;
        if (r.carried >= phases)
            throw invalid("ray {} carries phase {}, which does not exist; the tree has {}", i, r.carried, phases);
        all[i].carried = Phase{static_cast<std::uint8_t>(r.carried)};
    }
    return all;
}

PhasetreePreciseCrossing returned(const std::optional<PreciseCrossing>& found, Phase around) {
    PhasetreePreciseCrossing result{};
    if (!found) {
        result.tFrom = result.tTo = std::numeric_limits<double>::infinity();
        result.from = result.to = around.index;
        return result;
    }
    result.tFrom = found->t_from;
    result.tTo = found->t_to;
    copy(found->p_from, result.pointFrom);
    copy(found->p_to, result.pointTo);
    copy(found->normal, result.normal);
    result.from = found->from.index;
    result.to = found->to.index;
    return result;
}

}  // namespace

}  // namespace phasetree::embree::api

using namespace phasetree;
using namespace phasetree::embree::api;

PhasetreeError phasetreeLocate(PhasetreeTree tree, const double* points, size_t count, unsigned int* phases) {
    return guarded_call(__func__, [&] {
        const TreeData& data = data_of(tree);
        const std::vector<glm::dvec3> at = checked_points(points, count);
        if (count > 0) require(phases, "phases");
        std::vector<Phase> found(count);
        data.precise->evaluator(data.tree.object).locate(at, found);
        for (std::size_t i = 0; i < count; ++i) phases[i] = found[i].index;
    });
}

PhasetreeError phasetreeGetSafeDistances(PhasetreeTree tree, const double* points, size_t count, double* distances) {
    return guarded_call(__func__, [&] {
        const TreeData& data = data_of(tree);
        const std::vector<glm::dvec3> at = checked_points(points, count);
        if (count > 0) require(distances, "distances");
        const Phased& object = data.tree.object;
        const double error = bounds(object).finite() && !bounds(object).empty()
                                 ? data.precise->tracer(object).value_error()
                                 : 0;  // unbounded: rays cannot be traced, but points have distances
        data.precise->evaluator(object).safe_distances(at, std::span(distances, count), error);
    });
}

PhasetreeError phasetreeFindCrossings(PhasetreeTree tree, const PhasetreePreciseRay* rays, size_t count,
                                      PhasetreePreciseCrossing* crossings, bool (*cancelled)(void* user_pointer),
                                      void* cancelled_user_pointer) {
    return guarded_call(__func__, [&] {
        const TreeData& data = data_of(tree);
        const std::vector<PreciseRay> checked = checked_rays(rays, count, data.tree.phases.names.size());
        if (count > 0) require(crossings, "crossings");
        const PreciseTracer& tracer = data.precise->tracer(data.tree.object);
        std::vector<std::optional<PreciseCrossing>> found(count);
        const auto is_cancelled = [&] { return cancelled && cancelled(cancelled_user_pointer); };
        if (!tracer.first_crossings(checked, found, is_cancelled)) throw BuildCancelled();
        for (std::size_t i = 0; i < count; ++i)
            crossings[i] = returned(found[i], found[i]             ? vacuum
                                              : checked[i].carried ? *checked[i].carried
                                                                   : tracer.evaluator().label(checked[i].origin));
    });
}
