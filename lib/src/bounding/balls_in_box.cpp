#include "bounding/balls_in_box.hpp"

#include "bounding/convex_in_box.hpp"
#include "bounding/nearly_linear.hpp"
#include "phasetree/nodes/fields/balls.hpp"
#include "phasetree/nodes/fields/sphere.hpp"

namespace phasetree::bounding {

namespace {

// With more balls, enclosing them says little more than their Lipschitz bound.
constexpr std::size_t most_enclosed = 12;

Enclosure enclosed(const float* ball, const Vec3<Enclosure>& q, const Enclosure::Vector& half) {
    const Vec3<Enclosure> offset{q.x - ball[0], q.y - ball[1], q.z - ball[2]};
    const Sphere sphere{ball[3]};
    Enclosure result;
    const std::optional<AffinePoint> affine = AffinePoint::of(offset, half);
    if (!affine || !enclose_convex(sphere, *affine, result)) {
        result = known_to_be_convex(sphere.distance(offset), offset);
        tighten_by_linear_bound(result, half);
    }
    result.tighten(half);
    return result;
}

}  // namespace

std::optional<Enclosure> balls_in_box(const float* list, const Vec3<Enclosure>& q, const Enclosure::Vector& half) {
    const std::size_t count = balls::ShortList::count(list);
    if (count > most_enclosed) return std::nullopt;
    const float* ball = list + balls::ShortList::head;
    Enclosure least = enclosed(ball, q, half);
    for (std::size_t i = 1; i < count; ++i)
        least = min(least, enclosed(ball += balls::ball_floats, q, half)).tightened(half);
    return least;
}

}  // namespace phasetree::bounding

namespace phasetree {

std::optional<enclosure::Enclosure> Balls::Specialised::enclosed(const float* data, const Vec3<enclosure::Enclosure>& q,
                                                                 const std::array<double, 3>& half) {
    return bounding::balls_in_box(data, q, half);
}

}  // namespace phasetree
