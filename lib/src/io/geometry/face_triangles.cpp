#include "io/geometry/face_triangles.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <utility>

namespace phasetree::io {

namespace {

// Twice the area of a triangle; positive if it is counter-clockwise.
double area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The corners, counter-clockwise, projected onto the coordinate plane in which the face is largest.
std::vector<glm::dvec2> flattened(std::span<const glm::vec3> corners) {
    // Newell's normal is a sum over all sides, so it tolerates corners slightly off the plane and three corners in a
    // line.
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

// Whether a polygon never turns right, and goes around once.
bool is_convex(const std::vector<glm::dvec2>& p) {
    const std::size_t n = p.size();
    int turns = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (area(p[i], p[(i + 1) % n], p[(i + 2) % n]) < 0) return false;
        // A convex polygon changes exactly once from sides that go up to sides that do not.
        turns += (p[(i + 1) % n].y > p[i].y) && !(p[(i + 2) % n].y > p[(i + 1) % n].y) ? 1 : 0;
    }
    return turns <= 1;
}

// In most faces, an ear is found after testing a few corners. But some faces of n corners need about n³ comparisons in
// total. After 16 n² comparisons, any corner is cut off.
constexpr std::size_t comparisons_per_square = 16;
// The first comparisons of a face, 16 per corner, are free: ordinary faces need fewer.
constexpr std::size_t free_comparisons = 16;

class Ears {
  public:
    explicit Ears(std::vector<glm::dvec2> corners)
        : at_(std::move(corners)), next_(at_.size()), previous_(at_.size()), place_in_dents_(at_.size(), none) {
        const std::uint32_t n = size();
        for (std::uint32_t i = 0; i < n; ++i) {
            next_[i] = (i + 1) % n;
            previous_[i] = (i + n - 1) % n;
        }
        for (std::uint32_t i = 0; i < n; ++i) note(i);
    }

    std::vector<glm::uvec3> clip_all() {
        const std::size_t most = comparisons_per_square * at_.size() * at_.size();
        std::vector<glm::uvec3> triangles;
        triangles.reserve(at_.size() - 2);
        std::uint32_t i = 0;
        for (std::uint32_t left = size(); left > 3; --left) {
            // A self-intersecting face may have no ear. Then any corner is cut off.
            for (std::uint32_t tried = 0; tried < left && comparisons_ < most && !is_ear(i); ++tried) i = next_[i];
            triangles.emplace_back(previous_[i], i, next_[i]);
            i = cut(i);
        }
        // Start with the lowest remaining corner of the face.
        std::array<std::uint32_t, 3> last{i, next_[i], previous_[i]};
        std::ranges::sort(last);
        triangles.emplace_back(last[0], last[1], last[2]);
        return triangles;
    }
    std::size_t comparisons() const { return comparisons_; }

  private:
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    std::uint32_t size() const { return static_cast<std::uint32_t>(at_.size()); }

    bool is_dent(std::uint32_t i) const { return !(area(at_[previous_[i]], at_[i], at_[next_[i]]) > 0); }
    // Adds a corner to the dents or removes it from them, whichever applies.
    void note(std::uint32_t i) {
        const bool is_now = is_dent(i);
        if (is_now == (place_in_dents_[i] != none)) return;
        if (is_now) {
            place_in_dents_[i] = static_cast<std::uint32_t>(dents_.size());
            dents_.push_back(i);
        } else {
            take_from_dents(i);
        }
    }
    void take_from_dents(std::uint32_t i) {
        const std::uint32_t place = place_in_dents_[i], last = dents_.back();
        dents_[place] = last;
        place_in_dents_[last] = place;
        place_in_dents_[i] = none;
        dents_.pop_back();
    }
    // Cuts off a corner. Returns the next one.
    std::uint32_t cut(std::uint32_t i) {
        if (place_in_dents_[i] != none) take_from_dents(i);
        next_[previous_[i]] = next_[i];
        previous_[next_[i]] = previous_[i];
        note(previous_[i]);
        note(next_[i]);
        return next_[i];
    }

    bool is_ear(std::uint32_t i) {
        ++comparisons_;
        if (place_in_dents_[i] != none) return false;
        const glm::dvec2 &a = at_[previous_[i]], &b = at_[i], &c = at_[next_[i]];
        // If the triangle contains any corners, the one farthest from the side from a to c is a dent. So testing the
        // dents is enough.
        for (const std::uint32_t other : dents_) {
            ++comparisons_;
            const glm::dvec2& p = at_[other];
            if (p == a || p == b || p == c) continue;
            if (area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0) return false;
        }
        return true;
    }

    std::vector<glm::dvec2> at_;
    // For the corners that are left: their neighbours, and the corners at which the face is not convex.
    std::vector<std::uint32_t> next_, previous_, dents_;
    std::vector<std::uint32_t> place_in_dents_;  // for each corner: its index in dents_, or none
    std::size_t comparisons_ = 0;
};

}  // namespace

std::optional<std::vector<glm::uvec3>> FaceDivider::triangles(std::span<const glm::vec3> corners) {
    using Triangles = std::vector<glm::uvec3>;
    if (corners.size() == 3) return Triangles{{0, 1, 2}};
    std::vector<glm::dvec2> flat = flattened(corners);
    if (corners.size() <= most_corners_to_clip && !is_convex(flat)) {
        Ears ears(std::move(flat));
        Triangles clipped = ears.clip_all();
        const std::size_t free = free_comparisons * corners.size();
        const std::size_t counted = ears.comparisons() - std::min(ears.comparisons(), free);
        if (counted > comparisons_left_) return std::nullopt;
        comparisons_left_ -= counted;
        return clipped;
    }
    Triangles fan;
    fan.reserve(corners.size() - 2);
    for (std::uint32_t i = 2; i < corners.size(); ++i) fan.emplace_back(0, i - 1, i);
    return fan;
}

}  // namespace phasetree::io
