#include "world/triangle_hit.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <tuple>

namespace phasetree::tracer {

namespace {

// A ray is at an edge if a barycentric coordinate is less than this.
constexpr double at_edge = 1e-9;
// The relative rounding error of Embree's hits, with a margin.
constexpr float embree_rounding = 4e-6f;

struct Triangle {
    glm::dvec3 first, to_second, to_third;

    Triangle(const Mesh& mesh, unsigned index) {
        const glm::uvec3& corners = mesh.triangles[index];
        first = glm::dvec3(mesh.vertices[corners.x]);
        to_second = glm::dvec3(mesh.vertices[corners.y]) - first;
        to_third = glm::dvec3(mesh.vertices[corners.z]) - first;
    }
};

struct Place {
    double distance, u, v;
    glm::vec3 normal;

    // The least barycentric coordinate: negative if the ray misses the triangle.
    double inside() const { return std::min({u, v, 1 - u - v}); }
};

// Where the ray meets the triangle's plane. The numbers are not finite if it is parallel to it.
Place place_of(const Triangle& triangle, const RTCRay& ray) {
    const glm::dvec3 direction(ray.dir_x, ray.dir_y, ray.dir_z);
    const glm::dvec3 from_first = glm::dvec3(ray.org_x, ray.org_y, ray.org_z) - triangle.first;
    const glm::dvec3 p = glm::cross(direction, triangle.to_third), q = glm::cross(from_first, triangle.to_second);
    const double inverse = 1 / glm::dot(triangle.to_second, p);
    return {glm::dot(triangle.to_third, q) * inverse, glm::dot(from_first, p) * inverse,
            glm::dot(direction, q) * inverse, glm::vec3(glm::cross(triangle.to_second, triangle.to_third))};
}

void write(const Place& place, RTCHit& hit, float& distance) {
    hit.Ng_x = place.normal.x;
    hit.Ng_y = place.normal.y;
    hit.Ng_z = place.normal.z;
    if (!std::isfinite(place.distance)) return;
    const double u = std::clamp(place.u, 0.0, 1.0), v = std::clamp(place.v, 0.0, 1.0 - u);
    hit.u = static_cast<float>(u);
    hit.v = static_cast<float>(v);
    distance = static_cast<float>(std::max(place.distance, 0.0));
}

// The best triangle so far, of those around a point.
struct BestTriangle {
    std::span<const Mesh> meshes;
    unsigned first_id;
    const RTCRay& ray;
    Place place;
    unsigned geometry, triangle;

    // Triangles that contain the ray precede those that it misses, and are ordered by distance; the others, by how far
    // it misses them.
    static auto order(const Place& place, unsigned geometry, unsigned triangle) {
        const bool misses = !(place.inside() >= -at_edge);
        return std::tuple(misses, static_cast<float>(misses ? -place.inside() : place.distance), geometry, triangle);
    }
    void consider(unsigned other_geometry, unsigned other_triangle) {
        const Place other = place_of(Triangle(meshes[other_geometry - first_id], other_triangle), ray);
        if (!std::isfinite(other.distance) || !(other.distance >= 0)) return;
        if (!(order(other, other_geometry, other_triangle) < order(place, geometry, triangle))) return;
        place = other;
        geometry = other_geometry;
        triangle = other_triangle;
    }
};

bool consider_triangle(RTCPointQueryFunctionArguments* arguments) {
    auto& best = *static_cast<BestTriangle*>(arguments->userPtr);
    if (arguments->geomID >= best.first_id) best.consider(arguments->geomID, arguments->primID);
    return false;  // the radius stays
}

}  // namespace

void recompute_hit(const Mesh& mesh, const RTCRay& ray, RTCHit& hit, float& distance) {
    write(place_of(Triangle(mesh, hit.primID), ray), hit, distance);
}

void recompute_hit(RTCScene scene, std::span<const Mesh> meshes, unsigned first_id, const RTCRay& ray, RTCHit& hit,
                   float& distance) {
    BestTriangle best{meshes,     first_id,  ray, place_of(Triangle(meshes[hit.geomID - first_id], hit.primID), ray),
                      hit.geomID, hit.primID};
    if (!(best.place.inside() >= at_edge)) {
        RTCPointQuery query{};
        query.x = ray.org_x + distance * ray.dir_x;
        query.y = ray.org_y + distance * ray.dir_y;
        query.z = ray.org_z + distance * ray.dir_z;
        query.radius =
            embree_rounding * (distance + std::max({std::abs(query.x), std::abs(query.y), std::abs(query.z)}));
        RTCPointQueryContext context;
        rtcInitPointQueryContext(&context);
        rtcPointQuery(scene, &query, &context, consider_triangle, &best);
        hit.geomID = best.geometry;
        hit.primID = best.triangle;
    }
    write(best.place, hit, distance);
}

}  // namespace phasetree::tracer
