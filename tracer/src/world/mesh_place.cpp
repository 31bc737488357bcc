#include "world/mesh_place.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace phasetree::tracer {

namespace {

// Two vectors in the plane of a triangle with the sides `a` and `b`: the first has the dot product 1 with a and 0 with
// b, the second 0 with a and 1 with b. A linear function in the triangle that increases by α along a and by β along b
// has the gradient α times the first plus β times the second.
glm::mat2x3 dual_basis(const glm::vec3& a, const glm::vec3& b) {
    const float aa = glm::dot(a, a), ab = glm::dot(a, b), bb = glm::dot(b, b), determinant = aa * bb - ab * ab;
    if (!(determinant > 0.0f)) return glm::mat2x3(0.0f);
    return {(bb * a - ab * b) / determinant, (aa * b - ab * a) / determinant};
}

// Column i is the gradient of component i in the triangle's plane.
template <int count>
glm::mat<count, 3, float> gradients_of(const glm::vec<count, float>& along_a, const glm::vec<count, float>& along_b,
                                       const glm::mat2x3& dual) {
    glm::mat<count, 3, float> gradients;
    for (int i = 0; i < count; ++i) gradients[i] = along_a[i] * dual[0] + along_b[i] * dual[1];
    return gradients;
}

}  // namespace

glm::vec3 MeshPlace::point() const {
    const glm::uvec3& t = mesh.triangles[triangle];
    return (1 - u - v) * mesh.vertices[t.x] + u * mesh.vertices[t.y] + v * mesh.vertices[t.z];
}

glm::vec3 MeshPlace::point_of_smooth_surface(bool is_behind) const {
    const glm::uvec3& t = mesh.triangles[triangle];
    const glm::vec3 p = point();
    const float parts[] = {1 - u - v, u, v};
    glm::vec3 lift(0.0f);
    for (int i = 0; i < 3; ++i) {
        const glm::vec3 n = (is_behind ? -1.0f : 1.0f) * mesh.normals.at(mesh.triangles, triangle, i);
        const float height = glm::dot(mesh.vertices[t[i]] - p, n);
        if (height > 0.0f) lift += parts[i] * height * n;
    }
    return p + lift;
}

std::optional<MeshCoordinates> MeshPlace::coordinates() const {
    if (mesh.uv.empty() && mesh.colors.empty() && mesh.second_uv.empty() && mesh.alphas.empty()) return std::nullopt;
    const glm::uvec3& t = mesh.triangles[triangle];
    const glm::vec3& p = mesh.vertices[t.x];
    const glm::mat2x3 dual = dual_basis(mesh.vertices[t.y] - p, mesh.vertices[t.z] - p);
    MeshCoordinates coordinates;
    const auto fill = [&](const auto& corners, auto& value, auto& gradients) {
        if (corners.empty()) return;
        const auto corner = [&](int i) { return corners.at(mesh.triangles, triangle, i); };
        value = mean(corners);
        gradients = gradients_of(corner(1) - corner(0), corner(2) - corner(0), dual);
    };
    fill(mesh.uv, coordinates.uv, coordinates.gradients);
    fill(mesh.colors, coordinates.color, coordinates.color_gradients);
    fill(mesh.second_uv, coordinates.second_uv, coordinates.second_gradients);
    if (!mesh.alphas.empty()) coordinates.alpha = mean(mesh.alphas);
    return coordinates;
}

void MeshPlace::add_tangents(MeshCoordinates& coordinates, const glm::vec3& normal, bool is_behind) const {
    const glm::vec4 tangent = mean(mesh.tangents);
    const glm::vec3 along = glm::vec3(tangent) - normal * glm::dot(glm::vec3(tangent), normal);
    const float length = glm::length(along);
    if (!(length > 0.0f)) return;
    const float turn = is_behind ? -1.0f : 1.0f;
    coordinates.tangent = turn * along / length;
    coordinates.bitangent = turn * std::copysign(1.0f, tangent.w) * glm::cross(normal, coordinates.tangent);
}

}  // namespace phasetree::tracer
