#include "rays/beside_mesh.hpp"

#include <cmath>

#include "rays/random.hpp"
#include "rays/random_rays.hpp"

namespace phasetree::bench {

Agreement compare(const FieldScene& field, const MeshScene& mesh, const Rays& rays) {
    const FlushSubnormals flush;
    Agreement a;
    for (const Ray& ray : rays) {
        const auto f = field.intersect(ray);
        const auto m = mesh.intersect(ray);
        a.either += f || m ? 1 : 0;
        if (!f || !m) continue;
        ++a.both;
        const double d = std::abs(static_cast<double>(f->t_from) - static_cast<double>(m->distance));
        a.difference += d;
        a.largest = std::max(a.largest, d);
    }
    return a;
}

SurfaceRays leaving(const FieldScene& field, const MeshScene& mesh, const Rays& camera, std::uint64_t seed) {
    const FlushSubnormals flush;
    const float hair = 1e-5f * field.cells().bounds().diagonal();
    Random random(seed);
    SurfaceRays starts, rays;
    for (const Ray& ray : camera) {
        const auto f = field.intersect_with_normal(ray);
        const auto m = mesh.intersect(ray);
        // Past an edge the two may see different parts of the object: those rays would not be comparable.
        if (!f || !m || std::abs(f->crossing.t_from - m->distance) > 300 * hair) continue;
        glm::vec3 flat = glm::normalize(m->normal);
        if (glm::dot(flat, ray.direction) > 0) flat = -flat;
        starts.of_field.push_back(back_from(*f));
        starts.of_mesh.push_back({ray.origin + m->distance * ray.direction + hair * flat, flat, f->crossing.from});
    }
    if (starts.of_field.empty()) return rays;
    while (rays.of_field.size() < camera.size()) {
        const std::size_t i = random.below(starts.of_field.size());
        Ray f = starts.of_field[i], m = starts.of_mesh[i];
        const glm::vec3 direction = random.direction();
        if (!(glm::dot(direction, f.direction) > 0 && glm::dot(direction, m.direction) > 0)) continue;
        f.direction = m.direction = direction;
        rays.of_field.push_back(f);
        rays.of_mesh.push_back(m);
    }
    return rays;
}

}  // namespace phasetree::bench
