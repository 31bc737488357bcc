#include "phasetree/math/convex_polyhedron.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "phasetree/math/portable.hpp"

namespace phasetree {

namespace {

// Distances below this fraction of the size are treated as rounding errors.
constexpr double relative_error = 1e-11;

glm::dvec3 across(const glm::dvec3& n) {
    const glm::dvec3 axis = std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return glm::normalize(glm::cross(n, axis));
}

// The points in counter-clockwise order about their centre, as seen against the normal, without duplicates.
std::vector<glm::dvec3> in_order(std::vector<glm::dvec3> points, const glm::dvec3& normal, double apart) {
    if (points.size() < 3) return {};
    glm::dvec3 middle(0);
    for (const glm::dvec3& p : points) middle += p / static_cast<double>(points.size());
    const glm::dvec3 u = across(normal), v = glm::cross(normal, u);
    const auto angle = [&](const glm::dvec3& p) {
        return portable::atan2(glm::dot(p - middle, v), glm::dot(p - middle, u));
    };
    std::sort(points.begin(), points.end(),
              [&](const glm::dvec3& a, const glm::dvec3& b) { return angle(a) < angle(b); });
    const auto is_same = [&](const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b) <= apart; };
    points.erase(std::unique(points.begin(), points.end(), is_same), points.end());
    while (points.size() > 1 && is_same(points.front(), points.back())) points.pop_back();
    return points.size() < 3 ? std::vector<glm::dvec3>() : points;
}

// The part of a polygon within a half-space. Points on its plane are appended to `cut`.
std::vector<glm::dvec3> clipped(const std::vector<glm::dvec3>& corners, const HalfSpace& half, double apart,
                                std::vector<glm::dvec3>& cut) {
    std::vector<glm::dvec3> kept;
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < n; ++i) {
        const glm::dvec3 &a = corners[i], &b = corners[(i + 1) % n];
        const double at_a = half.distance(a), at_b = half.distance(b);
        if (at_a <= apart) kept.push_back(a);
        if (std::abs(at_a) <= apart) cut.push_back(a);
        if ((at_a < -apart && at_b > apart) || (at_a > apart && at_b < -apart)) {
            kept.push_back(a + (b - a) * (at_a / (at_a - at_b)));
            cut.push_back(kept.back());
        }
    }
    return kept;
}

}  // namespace

ConvexPolyhedron::ConvexPolyhedron(const Bounds& box, std::span<const HalfSpace> half_spaces) {
    if (box.empty()) return;
    size_ = static_cast<double>(box.diagonal());
    for (int side = 0; side < 6; ++side) {
        const int axis = side % 3, u = (axis + 1) % 3, v = (axis + 2) % 3;
        const bool is_high = side >= 3;
        Face face{{}, static_cast<std::size_t>(side)};
        for (int i = 0; i < 4; ++i) {
            const bool first = i == 1 || i == 2, second = i >= 2;
            glm::dvec3 p;
            p[axis] = is_high ? box.high[axis] : box.low[axis];
            p[u] = (is_high ? first : second) ? box.high[u] : box.low[u];
            p[v] = (is_high ? second : first) ? box.high[v] : box.low[v];
            face.corners.push_back(p);
        }
        faces_.push_back(std::move(face));
    }
    for (std::size_t i = 0; i < half_spaces.size(); ++i) clip(half_spaces[i], 6 + i);
}

void ConvexPolyhedron::clip(const HalfSpace& half, std::size_t plane) {
    const double apart = relative_error * size_;
    std::vector<glm::dvec3> cut;
    bool is_whole = true;
    for (const Face& face : faces_)
        for (const glm::dvec3& p : face.corners) is_whole = is_whole && half.distance(p) <= apart;
    if (is_whole) return;
    std::vector<Face> kept;
    for (const Face& face : faces_) {
        Face rest{clipped(face.corners, half, apart, cut), face.plane};
        // A face that lies within the cutting plane is replaced by the new face.
        const bool lies_within = std::all_of(rest.corners.begin(), rest.corners.end(),
                                             [&](const glm::dvec3& p) { return std::abs(half.distance(p)) <= apart; });
        if (rest.corners.size() >= 3 && !lies_within) kept.push_back(std::move(rest));
    }
    Face lid{in_order(std::move(cut), half.normal, 10 * apart), plane};
    if (lid.corners.size() >= 3 && !kept.empty()) kept.push_back(std::move(lid));
    faces_ = std::move(kept);
    if (faces_.size() < 4) faces_.clear();
}

// Both are sums over triangle fans about each face's first corner.
double ConvexPolyhedron::volume() const {
    if (empty()) return 0;
    const glm::dvec3 apex = faces_.front().corners.front();
    double sum = 0;
    for (const Face& face : faces_)
        for (std::size_t i = 1; i + 1 < face.corners.size(); ++i)
            sum += glm::dot(face.corners[0] - apex, glm::cross(face.corners[i] - apex, face.corners[i + 1] - apex));
    return sum / 6;
}
double ConvexPolyhedron::area() const {
    double sum = 0;
    for (const Face& face : faces_)
        for (std::size_t i = 1; i + 1 < face.corners.size(); ++i)
            sum += glm::length(glm::cross(face.corners[i] - face.corners[0], face.corners[i + 1] - face.corners[0]));
    return sum / 2;
}

ConvexPolyhedron::Mesh ConvexPolyhedron::mesh() const {
    Mesh mesh;
    const double apart = 1e3 * relative_error * size_;
    for (const Face& face : faces_) {
        std::vector<std::uint32_t>& indices = mesh.faces.emplace_back();
        for (const glm::dvec3& p : face.corners) {
            std::size_t i = 0;
            while (i < mesh.corners.size() && glm::distance(mesh.corners[i], p) > apart) ++i;
            if (i == mesh.corners.size()) mesh.corners.push_back(p);
            const auto index = static_cast<std::uint32_t>(i);
            if (indices.empty() || indices.back() != index) indices.push_back(index);
        }
        while (indices.size() > 1 && indices.front() == indices.back()) indices.pop_back();
        if (indices.size() < 3) mesh.faces.pop_back();
    }
    return mesh;
}

std::vector<std::array<std::uint32_t, 2>> ConvexPolyhedron::Mesh::edges() const {
    std::vector<std::array<std::uint32_t, 2>> all;
    for (const auto& face : faces)
        for (std::size_t i = 0; i < face.size(); ++i) {
            const std::uint32_t a = face[i], b = face[(i + 1) % face.size()];
            all.push_back({std::min(a, b), std::max(a, b)});
        }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

}  // namespace phasetree
