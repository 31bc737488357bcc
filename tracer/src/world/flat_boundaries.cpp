#include "world/flat_boundaries.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "shading/frame.hpp"
#include "world/traced_geometry.hpp"

namespace phasetree::tracer {

namespace {

constexpr int rows = 32, rays_per_light = rows * rows;

// A side is flat if at least this many rays, and this share of all rays that enter, meet it. On the curved side of a
// cylinder, about a hundredth of the rays meet normals that count as equal.
constexpr int least_rays = 4;
constexpr float least_share = 1.0f / 40;
constexpr std::size_t max_directions = 256;

bool bends_light(const Scene& scene, Phase phase) {
    const Clear* clear = std::get_if<Clear>(&scene.materials[phase.index]);
    return clear && clear->ior != 1.0f;
}

// The normals at which rays from outside enter refractive media, and the number of rays for each.
class EnteredSides {
  public:
    void add(const Surface& surface) {
        ++entered_;
        const auto same = std::ranges::find_if(sides_, [&](const Side& side) {
            return glm::dot(side.boundary.normal, surface.normal) > same_normal_cosine;
        });
        const Bounds here{surface.near_side.origin, surface.near_side.origin};
        if (same != sides_.end()) {
            ++same->rays;
            same->boundary.lit = unite(same->boundary.lit, here);
        } else if (sides_.size() < max_directions) {
            sides_.push_back({{surface.normal, here}, 1});
        }
    }
    std::vector<FlatBoundary> flat(float distance_between_rays) {
        const float least = std::max(static_cast<float>(least_rays), least_share * static_cast<float>(entered_));
        std::erase_if(sides_, [&](const Side& side) { return static_cast<float>(side.rays) < least; });
        std::ranges::stable_sort(sides_, std::greater<>(), &Side::rays);
        std::vector<FlatBoundary> flat;
        for (const Side& side : sides_)
            if (flat.size() < max_flat_boundaries)
                flat.push_back({side.boundary.normal, side.boundary.lit.inflated(distance_between_rays)});
        return flat;
    }

  private:
    struct Side {
        FlatBoundary boundary;
        int rays = 0;
    };
    std::vector<Side> sides_;
    int entered_ = 0;
};

// The directions towards the brightest lights above the six sides of the object, without duplicates.
std::vector<glm::vec3> directions_to_lights(const Lights& lights, const glm::vec3& centre) {
    std::vector<glm::vec3> directions;
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {-1.0f, 1.0f}) {
            glm::vec3 up(0.0f);
            up[axis] = sign;
            const std::optional<glm::vec3> light = lights.towards_brightest(centre, up);
            if (light && std::ranges::find(directions, *light) == directions.end()) directions.push_back(*light);
        }
    return directions;
}

// Point i of the R₂ sequence (Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018) in [-1, 1)².
glm::vec2 spread_over_square(int i) {
    const auto component = [&](double step) {
        const double x = 0.5 + step * i;
        return static_cast<float>(2 * (x - std::floor(x)) - 1);
    };
    return {component(0.7548776662466927), component(0.5698402909980532)};
}

}  // namespace

std::vector<FlatBoundary> flat_boundaries(const TracedGeometry& geometry, const Scene& scene) {
    const Bounds& bounds = geometry.bounds();
    bool any_bends_light = false;
    for (std::uint8_t i = 0; i < scene.materials.size(); ++i) any_bends_light |= bends_light(scene, Phase{i});
    if (!any_bends_light || bounds.empty() || !bounds.finite()) return {};
    EnteredSides sides;
    PathCounters uncounted;
    const float radius = 0.5f * bounds.diagonal();
    for (const glm::vec3& light : directions_to_lights(scene.lights, bounds.centre())) {
        const Frame frame(light);
        for (int i = 0; i < rays_per_light; ++i) {
            const glm::vec2 across = spread_over_square(i);
            const glm::vec3 origin = bounds.centre() + radius * frame.to_world({across.x, across.y, 1.001f});
            const Hit hit = geometry.intersect({origin, -light, phasetree::vacuum, {}}, uncounted);
            const Surface* surface = std::get_if<Surface>(&hit);
            if (surface && surface->far_side && !bends_light(scene, surface->near_side.phase) &&
                bends_light(scene, surface->far_side->phase))
                sides.add(*surface);
        }
    }
    return sides.flat(2 * radius / rows);
}

}  // namespace phasetree::tracer
