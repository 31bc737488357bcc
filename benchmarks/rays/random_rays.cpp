#include "rays/random_rays.hpp"

#include <stdexcept>

namespace phasetree::bench {

Rays rays_from_inside(const InterfaceCells& cells, std::size_t count, std::uint64_t seed) {
    Random random(seed);
    const Bounds& box = cells.bounds();
    Rays rays;
    rays.reserve(count);
    std::size_t tries = 0;
    while (rays.size() < count) {
        if (++tries > 10'000 * (count + 100)) throw std::runtime_error("the object fills too little of its bounds");
        const glm::vec3 p = box.low + random.in_cube() * box.extent();
        const glm::vec3 direction = random.direction();
        const Phase phase = cells.label(p, Evaluator::thread_workspace());
        if (phase != vacuum) rays.push_back({p, direction, phase});
    }
    return rays;
}

}  // namespace phasetree::bench
