#include "rays/random_rays.hpp"

#include <stdexcept>

#include "rays/random.hpp"

namespace phasetree::bench {

namespace {

// The phase at a point, by a ray that comes to it through the object: the whole program of a hundred thousand
// instructions would take long. Vacuum too where the point is in an interface's bracket, or close behind.
Phase phase_at(const FieldScene& scene, const glm::vec3& p) {
    const float start = scene.cells().bounds().low.x - 0.01f * scene.cells().bounds().diagonal();
    Ray ray{{start, p.y, p.z}, {1, 0, 0}, vacuum};
    while (true) {
        const auto crossing = scene.intersect(ray);
        if (!crossing || crossing->p_from.x > p.x) return ray.carried;
        if (crossing->p_to.x + scene.cells().resolution() > p.x) return vacuum;
        ray.origin = crossing->p_to;
        ray.carried = crossing->to;
    }
}

}  // namespace

Rays rays_from_inside(const FieldScene& scene, std::size_t count, std::uint64_t seed) {
    const FlushSubnormals flush;
    Random random(seed);
    const Bounds& box = scene.cells().bounds();
    Rays rays;
    rays.reserve(count);
    std::size_t tries = 0;
    while (rays.size() < count) {
        if (++tries > 10'000 * (count + 100)) throw std::runtime_error("the object fills too little of its bounds");
        const glm::vec3 p = box.low + random.in_cube() * box.extent();
        const glm::vec3 direction = random.direction();
        const Phase phase = phase_at(scene, p);
        if (phase != vacuum) rays.push_back({p, direction, phase});
    }
    return rays;
}

Ray back_from(const FieldScene::HitWithNormal& hit) {
    const Crossing& c = hit.crossing;
    return {c.p_from, -hit.normal.unit, c.from, hit.cell, c.from, hit.normal.gradient};
}

Rays rays_from_hits(const FieldScene& scene, std::span<const Ray> camera, std::uint64_t seed) {
    const FlushSubnormals flush;
    Random random(seed);
    Rays starts, rays;
    for (const Ray& ray : camera)
        if (const auto f = scene.intersect_with_normal(ray)) starts.push_back(back_from(*f));
    if (starts.empty()) throw std::runtime_error("the camera sees nothing of the object");
    rays.reserve(camera.size());
    while (rays.size() < camera.size()) {
        Ray ray = starts[random.below(starts.size())];
        const glm::vec3 direction = random.direction();
        if (!(glm::dot(direction, ray.direction) > 0)) continue;
        ray.direction = direction;
        rays.push_back(ray);
    }
    return rays;
}

}  // namespace phasetree::bench
