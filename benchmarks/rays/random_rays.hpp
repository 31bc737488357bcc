#pragma once

#include "phasetree/cells/cells.hpp"
#include "rays/random.hpp"
#include "rays/ray.hpp"

namespace phasetree::bench {

// From points spread evenly over all that is not vacuum, in all directions; each carries the phase that it starts in.
Rays rays_from_inside(const InterfaceCells&, std::size_t count, std::uint64_t seed);

// From where some of `towards` hit the object, back into the vacuum: all directions of the hemisphere alike.
template <class Scene>
Rays rays_from_surface(const Scene& scene, const Rays& towards, std::size_t count, std::uint64_t seed) {
    Random random(seed);
    Rays starts;
    for (const Ray& ray : towards) {
        const auto hit = scene.intersect_with_normal(ray);
        if (hit && hit->crossing.from == ray.carried)
            starts.push_back({hit->crossing.p_in, hit->normal, hit->crossing.from});
    }
    Rays rays;
    if (starts.empty()) return rays;
    while (rays.size() < count) {
        Ray ray = starts[std::min(static_cast<std::size_t>(random.next() * static_cast<float>(starts.size())),
                                  starts.size() - 1)];
        const glm::vec3 into = ray.direction;
        do ray.direction = random.direction();
        while (!(glm::dot(ray.direction, into) < 0));
        rays.push_back(ray);
    }
    return rays;
}

}  // namespace phasetree::bench
