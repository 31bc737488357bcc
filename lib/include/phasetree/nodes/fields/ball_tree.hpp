// Many balls as the data of one primitive: a list, and a hierarchy of boxes over it. The distance to their union is the
// minimum of |p − c| − r. In a small box few balls matter.
#pragma once

#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "phasetree/math/bounds.hpp"
#include "phasetree/math/point_range.hpp"
#include "phasetree/math/vec3.hpp"

namespace phasetree::balls {

/// A ball is four floats: its centre and radius.
inline constexpr std::size_t ball_floats = 4;

/// The signed distance to a ball, |p − c| − r.
template <class T>
T distance_to(const float* ball, const Vec3<T>& p) {
    return length(Vec3<T>{p.x - ball[0], p.y - ball[1], p.z - ball[2]}) - ball[3];
}

/// A list of balls: their number, then the balls. Among equally near balls the first one counts.
struct ShortList {
    static constexpr std::size_t head = 1;

    static std::size_t count(const float* data) { return static_cast<std::size_t>(data[0]); }
    static std::size_t floats(const float* data) { return head + count(data) * ball_floats; }

    template <class T>
    static T distance(const float* data, const Vec3<T>& p) {
        const float* ball = data + head;
        T least = distance_to(ball, p);
        for (std::size_t left = count(data); left > 1; --left) least = min(least, distance_to(ball += ball_floats, p));
        return least;
    }
};

/// All balls with a hierarchy: a ShortList, followed by the maximum of their coordinates and radii, the number of
/// nodes, and the nodes, each parent before its children.
struct Tree {
    /// Layout of a node: the box around the centres below it, the maximum radius below it, the number of its balls, and
    /// a link. For a leaf the link is the index of its first ball. For an inner node the number is 0 and the link is
    /// the index of its second child; the first child follows the node.
    static constexpr std::size_t low = 0, high = 3, radius = 6, count = 7, link = 8, node_floats = 9;

    /// The nearest ball; the first of equally near ones. Distances are compared as floats, so the result is the ball
    /// that a loop over all of them would find.
    static const float* nearest(const float* data, const Vec3<float>& p);

    /// Which balls matter to the points of a box: those that may be the nearest somewhere in it and are no farther than
    /// `farthest`. Distances beyond that may be wrong as long as they exceed it.
    struct Wanted {
        const PointRange& box;
        double farthest;
        std::size_t most;  ///< maximum number of balls
    };
    /// Append the ShortList of these balls, which has at least one ball. They are taken from `around`, the list of an
    /// enclosing box, or from the tree if `around` is empty. Returns false if there are too many, which cannot happen
    /// if `around` is given.
    static bool balls_in(const float* tree, const Wanted&, std::span<const float> around, std::vector<float>& floats);

    /// The cube root of the volume per ball: the volume of the box around all balls, divided by their number.
    static float spacing(const float* data);

    /// The maximum of d·p over all balls, with radii increased by `more`.
    static double support(const float* data, const glm::dvec3& d, float more);
};

/// Build the data of a Tree. There must be at least one ball. The order of the balls does not matter.
std::vector<float> make_tree(std::vector<glm::vec4> balls);

/// The box around all balls of a tree.
Bounds bounds_of(const float* tree);

}  // namespace phasetree::balls
