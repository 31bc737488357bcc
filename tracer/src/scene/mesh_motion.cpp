#include "scene/mesh_motion.hpp"

#include <algorithm>

#include "parameters/world_limits.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree::tracer {

namespace {

Transform transform_of(const Placement& placement) {
    return {glm::dmat3(placement.linear()), glm::dvec3(placement.translate())};
}

bool is_within_limits(const Bounds& box) {
    for (int i = 0; i < 3; ++i)
        if (!(box.low[i] >= -farthest) || !(box.high[i] <= farthest)) return false;
    return true;
}

}  // namespace

std::optional<MeshMotion> motion_through(const std::vector<PlacementMoment>& moments, const Placement& of_vertices,
                                         const Bounds& vertices) {
    const auto is_first = [&](const PlacementMoment& moment) {
        return transform_of(moment.placement) == transform_of(moments.front().placement);
    };
    if (std::ranges::all_of(moments, is_first)) return std::nullopt;
    const auto fail = [] {
        return ModelError("the mesh would become too small, too large or too far away while the shutter is open");
    };
    const Transform of = transform_of(of_vertices);
    if (!of.is_usable()) throw fail();
    std::vector<MovingTransform::Moment> poses;
    for (const PlacementMoment& moment : moments) {
        const Transform placement = transform_of(moment.placement);
        if (!placement.is_usable()) throw fail();
        poses.push_back({moment.time, Pose::of(placement)});
    }
    MeshMotion motion(MovingTransform(std::move(poses)), of);
    if (!is_within_limits(motion.swept(vertices))) throw fail();
    return motion;
}

}  // namespace phasetree::tracer
