#include "scene/mesh_tangents.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>

#include "phasetree/math/portable.hpp"

namespace phasetree::tracer {

namespace {

struct Corner {
    glm::vec3 place, normal;
    glm::vec2 uv;
    float side;         // 1, or −1 if the image is mirrored
    glm::vec3 tangent;  // of its own triangle, weighted

    auto key() const { return std::tuple(place.x, place.y, place.z, normal.x, normal.y, normal.z, uv.x, uv.y, side); }
};

glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : glm::dvec3(0);
}

glm::dvec3 without_normal_part(const glm::dvec3& v, const glm::dvec3& normal) {
    return v - normal * glm::dot(v, normal);
}

std::array<Corner, 3> corners_of(const Mesh& mesh, std::size_t triangle) {
    std::array<Corner, 3> corners;
    std::array<glm::dvec3, 3> p;
    std::array<glm::dvec2, 3> uv;
    for (int i = 0; i < 3; ++i) {
        const auto at = static_cast<std::size_t>(i);
        p[at] = corners[at].place = mesh.vertices[mesh.triangles[triangle][i]];
        uv[at] = corners[at].uv = mesh.uv.at(mesh.triangles, triangle, i);
    }
    // In doubles, because the sides of a small triangle far from the origin are differences of large numbers.
    const glm::dvec3 a = p[1] - p[0], b = p[2] - p[0];
    const glm::dvec2 along_a = uv[1] - uv[0], along_b = uv[2] - uv[0];
    const double area = along_a.x * along_b.y - along_b.x * along_a.y;
    const double side = area < 0 ? -1 : 1;
    const glm::dvec3 direction = area == 0 ? glm::dvec3(0) : unit(side * (along_b.y * a - along_a.y * b));
    const glm::dvec3 flat = unit(glm::cross(a, b));
    for (std::size_t i = 0; i < 3; ++i) {
        Corner& corner = corners[i];
        corner.side = static_cast<float>(side);
        const bool has_normal = !mesh.normals.empty();
        corner.normal = has_normal ? mesh.normals.at(mesh.triangles, triangle, static_cast<int>(i)) : glm::vec3(flat);
        const glm::dvec3 n = corner.normal == glm::vec3(0) ? flat : glm::dvec3(corner.normal);
        const glm::dvec3 next = unit(without_normal_part(p[(i + 1) % 3] - p[i], n)),
                         previous = unit(without_normal_part(p[(i + 2) % 3] - p[i], n));
        const double angle = portable::acos(std::clamp(glm::dot(next, previous), -1.0, 1.0));
        corner.tangent = glm::vec3(angle * unit(without_normal_part(direction, n)));
    }
    return corners;
}

}  // namespace

AtCorners<glm::vec4> tangents_of(const Mesh& mesh) {
    std::vector<Corner> corners;
    corners.reserve(3 * mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const Corner& corner : corners_of(mesh, t)) corners.push_back(corner);
    std::vector<std::uint32_t> sorted(corners.size());
    std::iota(sorted.begin(), sorted.end(), 0u);
    // Stable, so that sums do not depend on the sorting algorithm.
    std::ranges::stable_sort(sorted, {}, [&](std::uint32_t i) { return corners[i].key(); });

    AtCorners<glm::vec4> tangents;
    tangents.triangles.resize(mesh.triangles.size());
    for (std::size_t begin = 0, end = 0; begin < sorted.size(); begin = end) {
        const Corner& first = corners[sorted[begin]];
        glm::dvec3 sum(0);
        do {
            sum += glm::dvec3(corners[sorted[end]].tangent);
            tangents.triangles[sorted[end] / 3][static_cast<int>(sorted[end] % 3)] =
                static_cast<std::uint32_t>(tangents.values.size());
        } while (++end < sorted.size() && corners[sorted[end]].key() == first.key());
        tangents.values.emplace_back(glm::vec3(unit(sum)), first.side);
    }
    return tangents;
}

}  // namespace phasetree::tracer
