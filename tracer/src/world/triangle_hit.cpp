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

    // As stored.
    Triangle(const Mesh& mesh, unsigned index) {
        const glm::uvec3& corners = mesh.triangles[index];
        first = glm::dvec3(mesh.vertices[corners.x]);
        to_second = glm::dvec3(mesh.vertices[corners.y]) - first;
        to_third = glm::dvec3(mesh.vertices[corners.z]) - first;
    }
    Triangle moved(const Transform& by) const {
        Triangle there = *this;
        there.first = by(first);
        there.to_second = by.matrix * to_second;
        there.to_third = by.matrix * to_third;
        return there;
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

Place place_in(const MeshesInEmbree& in, unsigned geometry, unsigned index, const RTCRay& ray) {
    const Triangle triangle(in.meshes[geometry - in.first_id], index);
    const auto& moving = in.moving[geometry - in.first_id];
    return place_of(moving ? triangle.moved(moving->at(ray.time)) : triangle, ray);
}

// The best triangle so far, of those around a point.
struct BestTriangle {
    const MeshesInEmbree& in;
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
        const Place other = place_in(in, other_geometry, other_triangle, ray);
        if (!std::isfinite(other.distance) || !(other.distance >= 0)) return;
        if (!(order(other, other_geometry, other_triangle) < order(place, geometry, triangle))) return;
        place = other;
        geometry = other_geometry;
        triangle = other_triangle;
    }
};

bool consider_triangle(RTCPointQueryFunctionArguments* arguments) {
    static_cast<BestTriangle*>(arguments->userPtr)->consider(arguments->geomID, arguments->primID);
    return false;  // the radius stays
}

void query_triangles(RTCScene scene, const glm::dvec3& centre, double radius, RTCPointQueryFunction each,
                     BestTriangle& best) {
    RTCPointQuery query{};
    query.x = static_cast<float>(centre.x);
    query.y = static_cast<float>(centre.y);
    query.z = static_cast<float>(centre.z);
    query.radius = static_cast<float>(radius);
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene, &query, &context, each, &best);
}

// A triangle of a mesh that stands still, or the whole of a mesh that moves.
bool consider_geometry(RTCPointQueryFunctionArguments* arguments) {
    auto& best = *static_cast<BestTriangle*>(arguments->userPtr);
    if (arguments->geomID < best.in.first_id) return false;
    const auto& moving = best.in.moving[arguments->geomID - best.in.first_id];
    if (!moving) return consider_triangle(arguments);
    const RTCPointQuery& query = *arguments->query;
    const Transform inward = moving->at(best.ray.time).inverse();
    query_triangles(moving->scene(), inward({query.x, query.y, query.z}),
                    static_cast<double>(query.radius) * inward.stretch(), consider_triangle, best);
    return false;
}

}  // namespace

void recompute_hit(const Mesh& mesh, const RTCRay& ray, RTCHit& hit, float& distance) {
    write(place_of(Triangle(mesh, hit.primID), ray), hit, distance);
}

void recompute_hit(const MeshesInEmbree& in, const RTCRay& ray, RTCHit& hit, float& distance) {
    BestTriangle best{in, ray, place_in(in, hit.geomID, hit.primID, ray), hit.geomID, hit.primID};
    if (!(best.place.inside() >= at_edge)) {
        const glm::vec3 p{ray.org_x + distance * ray.dir_x, ray.org_y + distance * ray.dir_y,
                          ray.org_z + distance * ray.dir_z};
        const float radius = embree_rounding * (distance + std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}));
        query_triangles(in.scene, glm::dvec3(p), static_cast<double>(radius), consider_geometry, best);
        hit.geomID = best.geometry;
        hit.primID = best.triangle;
    }
    write(best.place, hit, distance);
}

}  // namespace phasetree::tracer
