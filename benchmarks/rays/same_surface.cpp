#include "rays/same_surface.hpp"

#include <cmath>

#include "rays/random.hpp"

namespace phasetree::bench {

namespace {

constexpr float resolutions = 10;  // both brackets, and rounding of two different sequences of operations

Samples sampled(const InterfaceCells& cells, const glm::vec3* p) {
    BatchOfFloats x{}, y{}, z{};
    for (std::size_t i = 0; i < batch_size; ++i) {
        x[i] = p[i].x;
        y[i] = p[i].y;
        z[i] = p[i].z;
    }
    Samples samples;
    cells.whole().sample(x, y, z, samples, Evaluator::thread_workspace());
    return samples;
}

}  // namespace

Sameness same_surface(const FieldScene& a, const FieldScene& b, const Rays& camera, std::size_t points,
                      std::uint64_t seed) {
    const FlushSubnormals flush;
    Sameness found;
    const Bounds box = unite(a.cells().bounds(), b.cells().bounds());
    const float tolerance = resolutions * std::max(a.cells().resolution(), b.cells().resolution());
    std::vector<glm::vec3> surface;
    for (const Ray& ray : camera) {
        const auto hit = a.intersect(ray), other = b.intersect(ray);
        ++found.rays;
        found.hits += hit ? 1 : 0;
        if (hit) surface.push_back(hit->p_from);
        if (hit.has_value() != other.has_value() || (hit && std::abs(hit->t_from - other->t_from) > tolerance))
            ++found.rays_apart;
    }
    Random random(seed);
    std::vector<glm::vec3> batch(batch_size);
    while (found.points < points) {
        for (std::size_t i = 0; i < batch_size; ++i) {
            glm::vec3 p = box.low + random.in_cube() * box.extent();
            if (i % 2 == 1 && !surface.empty()) {
                const auto n = static_cast<float>(surface.size());
                p = surface[std::min(static_cast<std::size_t>(random.next() * n), surface.size() - 1)];
                p += random.direction() * (random.next() * (i % 4 == 1 ? 1e-3f : 3e-2f) * box.diagonal());
            }
            batch[i] = p;
        }
        const Samples in_a = sampled(a.cells(), batch.data()), in_b = sampled(b.cells(), batch.data());
        for (std::size_t i = 0; i < batch_size; ++i) {
            ++found.points;
            const bool same = (in_a.label[i] == 0) == (in_b.label[i] == 0);
            if (!same && in_a.distance[i] > tolerance && in_b.distance[i] > tolerance) ++found.points_apart;
        }
    }
    return found;
}

}  // namespace phasetree::bench
