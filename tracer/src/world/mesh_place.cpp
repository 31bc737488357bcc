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

glm::vec3 MeshPlace::turned(const glm::vec3& stored) const {
    if (!moved) return stored;
    return glm::vec3(moved->matrix * glm::dvec3(stored) / glm::length(moved->matrix[0]));
}

glm::vec3 MeshPlace::point() const {
    return (1 - u - v) * corner(0) + u * corner(1) + v * corner(2);
}

glm::vec3 MeshPlace::point_of_smooth_surface(bool is_behind) const {
    const glm::vec3 p = point();
    const float parts[] = {1 - u - v, u, v};
    glm::vec3 lift(0.0f);
    for (int i = 0; i < 3; ++i) {
        const glm::vec3 n = (is_behind ? -1.0f : 1.0f) * turned(mesh.normals.at(mesh.triangles, triangle, i));
        const float height = glm::dot(corner(i) - p, n);
        if (height > 0.0f) lift += parts[i] * height * n;
    }
    return p + lift;
}

std::optional<MeshCoordinates> MeshPlace::coordinates() const {
    if (mesh.uv.empty() && mesh.colors.empty() && mesh.second_uv.empty() && mesh.alphas.empty()) return std::nullopt;
    const glm::vec3 p = corner(0);
    const glm::mat2x3 dual = dual_basis(corner(1) - p, corner(2) - p);
    MeshCoordinates coordinates;
    const auto fill = [&](const auto& corners, auto& value, auto& gradients) {
        if (corners.empty()) return;
        const auto at = [&](int i) { return corners.at(mesh.triangles, triangle, i); };
        value = mean(corners);
        gradients = gradients_of(at(1) - at(0), at(2) - at(0), dual);
    };
    fill(mesh.uv, coordinates.uv, coordinates.gradients);
    fill(mesh.colors, coordinates.color, coordinates.color_gradients);
    fill(mesh.second_uv, coordinates.second_uv, coordinates.second_gradients);
    if (!mesh.alphas.empty()) coordinates.alpha = mean(mesh.alphas);
    return coordinates;
}

void MeshPlace::add_tangents(MeshCoordinates& coordinates, const glm::vec3& normal, bool is_behind) const {
    const glm::vec4 mean_tangent = mean(mesh.tangents);
    const glm::vec3 tangent = turned(glm::vec3(mean_tangent));
    const glm::vec3 along = tangent - normal * glm::dot(tangent, normal);
    const float length = glm::length(along);
    if (!(length > 0.0f)) return;
    const float turn = is_behind ? -1.0f : 1.0f;
    coordinates.tangent = turn * along / length;
    coordinates.bitangent = turn * std::copysign(1.0f, mean_tangent.w) * glm::cross(normal, coordinates.tangent);
}

}  // namespace phasetree::tracer
