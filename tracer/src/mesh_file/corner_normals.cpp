#include "mesh_file/corner_normals.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "phasetree/math/portable.hpp"

namespace phasetree::tracer {

namespace {

constexpr double smooth_cosine = 0.8660254037844387;  // cos 30°

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return portable::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// A triangle at a vertex: its normal, zero if it has none, the triangle's index, and the corner at the vertex.
struct Side {
    glm::dvec3 normal;
    double angle = 0;
    std::uint32_t triangle = 0, corner = 0;
};

}  // namespace

CornerNormals corner_normals(const ClosedMesh& mesh) {
    std::vector<std::vector<Side>> around(mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& t = mesh.triangles[i];
        const glm::dvec3 p[3] = {glm::dvec3(mesh.vertices[t[0]]), glm::dvec3(mesh.vertices[t[1]]),
                                 glm::dvec3(mesh.vertices[t[2]])};
        glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
        const double length = glm::length(normal);
        normal = length > 0 ? normal / length : glm::dvec3(0);
        for (std::uint32_t c = 0; c < 3; ++c)
            around[t[c]].push_back({normal, angle_between(p[(c + 1) % 3] - p[c], p[(c + 2) % 3] - p[c]),
                                    static_cast<std::uint32_t>(i), c});
    }
    CornerNormals result;
    result.of.resize(mesh.triangles.size());
    for (const std::vector<Side>& sides : around) {
        const std::size_t first = result.normals.size();
        for (const Side& own : sides) {
            glm::dvec3 sum(0);
            for (const Side& other : sides)
                // A degenerate triangle has no normal of its own, and takes the mean of all.
                if (own.normal == glm::dvec3(0) || glm::dot(own.normal, other.normal) > smooth_cosine)
                    sum += other.angle * other.normal;
            const double length = glm::length(sum);
            const glm::vec3 normal = length > 0 ? glm::vec3(sum / length) : glm::vec3(0, 0, 1);
            auto found =
                std::find(result.normals.begin() + static_cast<std::ptrdiff_t>(first), result.normals.end(), normal);
            if (found == result.normals.end()) found = result.normals.insert(found, normal);
            result.of[own.triangle][own.corner] = static_cast<std::uint32_t>(found - result.normals.begin());
        }
    }
    return result;
}

}  // namespace phasetree::tracer
