// The base of nodes that place copies of one child in many places. The child is stored once in memory. In the program
// each copy has its own instructions, so that pruning can remove copies that do not matter. Copies of a field are
// united. Copies of an object are combined as by `under`: each replaces those before it. Copies may therefore overlap
// without a seam.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <optional>
#include <vector>

#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/nodes/warps/translate.hpp"

namespace phasetree {

/// p ↦ R(−a)(p − v)/s about the z axis: the inverse of scaling by s, then rotating by a, then moving by v.
struct PlacementMap {
    glm::vec3 by{0};
    float cosine = 1;  ///< cos a / s
    float sine = 0;    ///< sin a / s
    float inverse = 1;

    template <class T>
    Vec3<T> operator()(const Vec3<T>& p) const {
        const Vec3<T> q = p - by;
        return {q.x * cosine + q.y * sine, q.y * cosine - q.x * sine, q.z * inverse};
    }
    AffineMap affine() const { return {.row = {{cosine, sine, 0}, {-sine, cosine, 0}, {0, 0, inverse}}, .before = by}; }
};

/// p ↦ R⁻¹(p − v)/s for any rotation R, such as that of a copy that stands on a slope.
struct StandingMap {
    glm::vec3 by{0};
    glm::vec3 row[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< the columns of R, divided by s

    template <class T>
    Vec3<T> operator()(const Vec3<T>& p) const {
        const Vec3<T> q = p - by;
        return {dot(q, row[0]), dot(q, row[1]), dot(q, row[2])};
    }
    AffineMap affine() const { return {.row = {row[0], row[1], row[2]}, .before = by}; }
};

/// The position, rotation and size of a copy.
struct Placement {
    PlacementMap map;
    float scale = 1;
    std::optional<glm::mat3> frame{};  ///< R of a copy that is rotated about other axes than z

    /// A placement that is rotated about the z axis, by degrees.
    static Placement at(const glm::vec3& by, double turn, float scale) {
        const double a = glm::radians(turn), s = scale;
        Placement result{{by, static_cast<float>(std::cos(a) / s), static_cast<float>(std::sin(a) / s), 1 / scale},
                         scale};
        if (!std::isfinite(result.map.inverse)) throw ModelError("a copy's scale is too small");
        return result;
    }
    /// A placement whose z axis is a unit vector `normal`, rotated about it by `turn` degrees.
    static Placement standing(const glm::vec3& by, const glm::dvec3& normal, double turn, float scale);
    StandingMap standing_map() const {
        const glm::mat3& r = *frame;
        return {map.by, {r[0] * map.inverse, r[1] * map.inverse, r[2] * map.inverse}};
    }
    /// The linear map from the child's points to the copy's.
    glm::dmat3 matrix() const {
        if (frame) return glm::dmat3(*frame) * static_cast<double>(scale);
        const double s = scale, c = s * s * static_cast<double>(map.cosine), t = s * s * static_cast<double>(map.sine);
        return {c, t, 0, -t, c, 0, 0, 0, s};
    }
    bool is_moved_only() const { return map.cosine == 1 && map.sine == 0 && scale == 1; }
    Bounds image(const Bounds& b) const {
        if (b.empty()) return b;
        if (!frame && map.sine == 0 && map.cosine > 0) return {b.low * scale + map.by, b.high * scale + map.by};
        const float c = map.cosine * scale * scale, s = map.sine * scale * scale;
        const Bounds turned = image_of(b, frame ? *frame * scale : glm::mat3(c, s, 0, -s, c, 0, 0, 0, scale));
        const float far = glm::length(map.by);
        return Bounds{turned.low + map.by, turned.high + map.by}.inflated(1e-6f * far);
    }
};

/// Copies of a field or an object. This is the base of a node of type Node, which provides many(), the number of
/// copies, and placement(i). Placements are computed on demand, so a thousand copies take no more memory than one.
template <class Node, class Child>
struct Copies {
    static constexpr bool has_copies = true;  ///< with_levels_of_detail() leaves the levels below it unchanged
    using Parts = TypeList<PlacementMap, StandingMap>;
    Child of;

    template <class D>
    auto evaluate(D& d, const typename D::Point& p) const {
        const Node& node = static_cast<const Node&>(*this);
        auto result = one(d, node.placement(0), p);
        for (std::size_t i = 1, n = node.many(); i < n; ++i) {
            if constexpr (std::is_same_v<Child, Field>)
                result = min(result, one(d, node.placement(i), p));
            else
                result = detail::under(result, one(d, node.placement(i), p));
        }
        return result;
    }
    Bounds bounds(BoundsQuery& q, float level) const {
        const Node& node = static_cast<const Node&>(*this);
        Bounds all;
        const std::size_t n = node.many();
        for (std::size_t i = 0; i < n; ++i) {
            const Placement at = node.placement(i);
            if (q.is_by_boxes()) {
                all = unite(all, at.image(q(of, level / at.scale)));
                continue;
            }
            // With many copies, each is small, so its axis-aligned box is tight enough and need not be bounded by
            // directions.
            const auto copy = [&] {
                return n <= 64 || at.is_moved_only() ? q(of, level / at.scale)
                                                     : q.placed(q.own_box(of, level / at.scale));
            };
            all = unite(all, q.through(at.matrix(), glm::dvec3(at.map.by), copy));
        }
        return all;
    }

  private:
    template <class D>
    auto one(D& d, const Placement& at, const typename D::Point& p) const {
        const float stretch = at.map.inverse * (1 + 2e-7f);
        const typename D::Point q = at.frame             ? d.map(at.standing_map(), p, stretch * (1 + 2e-7f))
                                    : at.is_moved_only() ? d.map(Translate::Map{at.map.by}, p, 1.f)
                                                         : d.map(at.map, p, stretch);
        if constexpr (std::is_same_v<Child, Field>) {
            const auto f = d.field(of, q);
            return at.scale == 1 ? f : f * at.scale;
        } else {
            auto a = d.phases(of, q);
            if (at.scale != 1) for_each_phase(a.present, [&](int i) { a.set(i, a[i] * at.scale); });
            return a;
        }
    }
};

namespace detail {
inline constexpr Parameter copied{"of", "", "The field or object to copy."};
/// More copies would exceed the limit of instructions anyway.
inline constexpr int max_copies = 500'000;
}  // namespace detail

}  // namespace phasetree
