// Conversions between Embree's rays and those for tracing.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>

#include "embree_core/embree.hpp"

namespace phasetree::embree {

/// Set up a zero-initialised Embree ray: at time 0, with all bits of its mask set.
inline void set_ray(RTCRay& ray, const glm::vec3& origin, const glm::vec3& direction, float near, float far) {
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.tnear = near;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tfar = far;
    ray.mask = ~0u;
}

inline RTCRay ray_of(const glm::vec3& origin, const glm::vec3& direction, float near = 0,
                     float far = std::numeric_limits<float>::infinity()) {
    RTCRay ray{};
    set_ray(ray, origin, direction, near, far);
    return ray;
}

/// Make a ray with an empty hit. It is written in place because copying a ray right after writing its members stalls
/// until the stores are in the cache, which is measurable per ray.
inline RTCRayHit rayhit_of(const glm::vec3& origin, const glm::vec3& direction, float near = 0,
                           float far = std::numeric_limits<float>::infinity()) {
    RTCRayHit rayhit{};
    set_ray(rayhit.ray, origin, direction, near, far);
    rayhit.hit.primID = rayhit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    for (unsigned& id : rayhit.hit.instID) id = RTC_INVALID_GEOMETRY_ID;
#if defined(RTC_GEOMETRY_INSTANCE_ARRAY)
    for (unsigned& id : rayhit.hit.instPrimID) id = RTC_INVALID_GEOMETRY_ID;
#endif
    return rayhit;
}

/// Whether a ray has hit anything.
inline bool is_hit(const RTCRayHit& rayhit) {
    return rayhit.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

/// The length of a ray's direction, or 0 if the ray cannot hit anything: because numbers are not finite, or the
/// direction is zero.
inline float usable_length(const glm::vec3& origin, const glm::vec3& direction) {
    const float length = glm::length(direction);
    const bool is_finite = std::isfinite(origin.x) && std::isfinite(origin.y) && std::isfinite(origin.z);
    return is_finite && std::isfinite(length) ? length : 0.f;
}

/// Normalise a direction of the given length. A direction that is already a unit vector up to rounding is unchanged.
/// Dividing it by its rounded length would change the points of the ray slightly, so a ray that starts at a crossing
/// would no longer sample the bracket that was found for it (Crossing).
inline glm::vec3 unit_direction(const glm::vec3& direction, float length) {
    return std::abs(length - 1) < 1e-6f ? direction : direction / length;
}

/// A ray with a unit direction, so that its ends are distances.
struct UnitRay {
    glm::vec3 origin{0}, direction{0};
    float near = 0, far = 0;
    /// The length of the original direction. A distance divided by it is in units of the original ray.
    float length = 1;

    /// Make a unit ray; nullopt if the ray cannot hit anything, or ends before it begins.
    static std::optional<UnitRay> of(const glm::vec3& origin, const glm::vec3& direction, float t_near, float t_far) {
        UnitRay ray;
        ray.origin = origin;
        ray.length = usable_length(origin, direction);
        if (ray.length == 0) return std::nullopt;
        ray.direction = unit_direction(direction, ray.length);
        ray.near = t_near * ray.length;
        ray.far = t_far * ray.length;
        if (!(ray.near <= ray.far)) return std::nullopt;
        return ray;
    }
};

}  // namespace phasetree::embree
