#include "embree_core/line_tracer.hpp"

#include "embree_core/walk.hpp"

namespace phasetree::embree {

LineTracer line_tracer(const CellScene& scene) {
    return [&scene](const glm::vec3& origin, const glm::vec3& direction, float length,
                    std::vector<CrossingOnLine>& found) {
        const std::optional<UnitRay> ray = UnitRay::of(origin, direction, 0, length);
        if (!ray) return;  // too far from the origin for floats, where there are no crossings
        Walk walk(scene, *ray, vacuum);
        while (const auto hit = walk.next()) {
            const Crossing& c = hit->crossing;
            found.push_back(
                {0.5f * (c.t_from + c.t_to), c.from, c.to, scene.cells().normal(hit->cell, c, ray->direction).unit});
        }
    };
}

}  // namespace phasetree::embree
