#include "io/face_triangles.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numeric>
#include <utility>

namespace phasetree::io {

namespace {

// Twice the area of a triangle, positive if it is counter-clockwise.
double area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The corners on that plane of two axes on which the face is largest, counter-clockwise.
std::vector<glm::dvec2> flattened(std::span<const glm::vec3> corners) {
    // Newell's normal, which any corner that is off the plane, or on a line with its neighbours, hardly changes.
    glm::dvec3 normal(0);
    for (std::size_t i = 0; i < corners.size(); ++i)
        normal += glm::cross(glm::dvec3(corners[i]), glm::dvec3(corners[(i + 1) % corners.size()]));
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::vector<glm::dvec2> flat;
    flat.reserve(corners.size());
    for (const glm::vec3& p : corners) {
        const glm::dvec2 q(p[(axis + 1) % 3], p[(axis + 2) % 3]);
        flat.push_back(normal[axis] < 0 ? glm::dvec2(q.y, q.x) : q);
    }
    return flat;
}

// Tells whether a polygon never turns right, and once around in all.
bool is_convex(const std::vector<glm::dvec2>& p) {
    const std::size_t n = p.size();
    int turns = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (area(p[i], p[(i + 1) % n], p[(i + 2) % n]) < 0) return false;
        // A convex polygon changes once from sides that go up to sides that do not.
        turns += (p[(i + 1) % n].y > p[i].y) && !(p[(i + 2) % n].y > p[(i + 1) % n].y) ? 1 : 0;
    }
    return turns <= 1;
}

// Ears are found after a few corners in most faces, which takes about n² comparisons for all of n corners, but there
// are faces for which it takes n³. After so many times n² any corner is cut off.
constexpr std::size_t most_comparisons = 16;

class Ears {
  public:
    explicit Ears(std::vector<glm::dvec2> corners)
        : at_(std::move(corners)), left_(at_.size()), budget_(most_comparisons * at_.size() * at_.size()) {
        std::iota(left_.begin(), left_.end(), 0u);
    }

    std::vector<glm::uvec3> clip_all() {
        std::vector<glm::uvec3> triangles;
        std::size_t i = 0;
        while (left_.size() > 3) {
            // A face that crosses itself may have no ear; any corner is cut off then.
            std::size_t tried = 0;
            while (tried < left_.size() && budget_ > 0 && !is_ear(i)) {
                i = next(i);
                ++tried;
            }
            triangles.emplace_back(left_[previous(i)], left_[i], left_[next(i)]);
            left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(i));
            i %= left_.size();
        }
        triangles.emplace_back(left_[0], left_[1], left_[2]);
        return triangles;
    }

  private:
    std::size_t next(std::size_t i) const { return (i + 1) % left_.size(); }
    std::size_t previous(std::size_t i) const { return (i + left_.size() - 1) % left_.size(); }

    bool is_ear(std::size_t i) {
        budget_ -= std::min(budget_, left_.size());
        const glm::dvec2 &a = at_[left_[previous(i)]], &b = at_[left_[i]], &c = at_[left_[next(i)]];
        if (!(area(a, b, c) > 0)) return false;
        for (const std::uint32_t other : left_) {
            const glm::dvec2& p = at_[other];
            if (p == a || p == b || p == c) continue;
            if (area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0) return false;
        }
        return true;
    }

    std::vector<glm::dvec2> at_;
    std::vector<std::uint32_t> left_;  // the corners that are not cut off yet
    std::size_t budget_;
};

}  // namespace

std::vector<glm::uvec3> face_triangles(std::span<const glm::vec3> corners) {
    if (corners.size() == 3) return {{0, 1, 2}};
    std::vector<glm::dvec2> flat = flattened(corners);
    if (corners.size() <= most_corners_to_clip && !is_convex(flat)) return Ears(std::move(flat)).clip_all();
    std::vector<glm::uvec3> fan;
    fan.reserve(corners.size() - 2);
    for (std::uint32_t i = 2; i < corners.size(); ++i) fan.emplace_back(0, i - 1, i);
    return fan;
}

}  // namespace phasetree::io
