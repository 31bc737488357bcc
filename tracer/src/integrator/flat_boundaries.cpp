#include "integrator/flat_boundaries.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "integrator/world.hpp"
#include "shading/frame.hpp"

namespace phasetree::tracer {

namespace {

constexpr int rows = 32, rays_of_a_lamp = rows * rows;

// Of those that enter a flat side takes so many at least, and this share; a cylinder sends a hundredth of them in
// one direction.
constexpr int fewest_rays = 4;
constexpr float least_share = 1.0f / 40;
constexpr std::size_t most_directions = 256;

struct Side {
    FlatBoundary as;
    int rays = 0;
};

class Sides {
  public:
    explicit Sides(const Scene& scene) : scene_(scene) {}

    bool is_bending(Phase phase) const {
        const Clear* medium = std::get_if<Clear>(&scene_.materials[phase.index]);
        return medium && medium->ior != 1.0f;
    }
    // Of a ray from outside.
    void met(const Surface& surface) {
        if (surface.near_phase == surface.far_phase || is_bending(surface.near_phase) || !is_bending(surface.far_phase))
            return;
        ++entered_;
        const auto same = std::ranges::find_if(
            sides_, [&](const Side& s) { return glm::dot(s.as.normal, surface.normal) > one_direction; });
        const Bounds here{surface.near_origin, surface.near_origin};
        if (same != sides_.end()) {
            ++same->rays;
            same->as.lit = unite(same->as.lit, here);
        } else if (sides_.size() < most_directions) {
            sides_.push_back({{surface.normal, here}, 1});
        }
    }
    std::vector<FlatBoundary> flat(float rays_apart) {
        const float fewest = std::max(static_cast<float>(fewest_rays), least_share * static_cast<float>(entered_));
        std::erase_if(sides_, [&](const Side& s) { return static_cast<float>(s.rays) < fewest; });
        std::ranges::stable_sort(sides_, std::greater<>(), &Side::rays);
        std::vector<FlatBoundary> flat;
        for (const Side& s : sides_)
            if (flat.size() < most_flat_boundaries) flat.push_back({s.as.normal, s.as.lit.inflated(rays_apart)});
        return flat;
    }

  private:
    const Scene& scene_;
    std::vector<Side> sides_;
    int entered_ = 0;
};

}  // namespace

std::vector<FlatBoundary> flat_boundaries(const World& world, const Scene& scene) {
    Sides sides(scene);
    const Bounds& bounds = world.object().bounds();
    bool is_bending = false;
    for (std::uint8_t i = 0; i < scene.materials.size(); ++i) is_bending |= sides.is_bending(Phase{i});
    if (!is_bending || bounds.empty() || !bounds.finite()) return {};
    std::vector<glm::vec3> lamps;
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {-1.0f, 1.0f}) {
            glm::vec3 up(0.0f);
            up[axis] = sign;
            const glm::vec3 lamp = scene.lights.towards_brightest(bounds.centre(), up);
            if (lamp != up && std::ranges::find(lamps, lamp) == lamps.end()) lamps.push_back(lamp);
        }
    PathCounters uncounted;
    const float radius = 0.5f * bounds.diagonal();
    for (const glm::vec3& lamp : lamps) {
        const Frame frame(lamp);
        for (int i = 0; i < rays_of_a_lamp; ++i) {
            // Points of the R₂ sequence (Roberts 2018).
            const auto spread = [&](double step) {
                const double x = 0.5 + step * i;
                return static_cast<float>(2 * (x - std::floor(x)) - 1);
            };
            const glm::vec3 from = bounds.centre() + radius * frame.to_world({spread(0.7548776662466927),
                                                                              spread(0.5698402909980532), 1.001f});
            const auto surface = world.intersect(from, -lamp, std::numeric_limits<float>::infinity(), phasetree::vacuum,
                                                 {}, Purpose::path, uncounted);
            if (surface && surface->optics) sides.met(*surface);
        }
    }
    return sides.flat(2 * radius / rows);
}

}  // namespace phasetree::tracer
