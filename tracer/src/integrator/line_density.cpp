#include "integrator/line_density.hpp"

#include "caustics/emission.hpp"

namespace phasetree::tracer {

float line_density(const Photons& photons, const Ray& ray) {
    return photons ? photons.emission->line_density(ray.origin, ray.direction, ray.phase) : 0.0f;
}

float line_density(const Photons& photons, const Ray& ray, const Surface& emissive) {
    return photons ? photons.emission->line_density(emissive, ray.direction, emissive.distance) : 0.0f;
}

float line_density_in_medium(const Photons& photons, const Ray& ray, float distance) {
    return photons ? photons.emission->line_density_in_medium(ray.origin, ray.direction, ray.phase, distance) : 0.0f;
}

}  // namespace phasetree::tracer
