// Many balls as data of one primitive: a list, and a hierarchy of boxes over it. The distance to their union is that to
// the ball for which |p − c| − r is least. In a small box few balls matter.
#pragma once

#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "phasetree/math/bounds.hpp"
#include "phasetree/math/point_range.hpp"
#include "phasetree/math/vec3.hpp"

namespace phasetree::balls {

/// A ball is four floats: the centre and the radius.
inline constexpr std::size_t ball_floats = 4;

/// The signed distance to a ball, |p − c| − r.
template <class T>
T distance_to(const float* ball, const Vec3<T>& p) {
    return length(Vec3<T>{p.x - ball[0], p.y - ball[1], p.z - ball[2]}) - ball[3];
}

/// The number of balls, and the balls. Where several are equally near, the first one counts.
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

/// A ShortList of all balls, behind it the largest of their coordinates and radii, the number of nodes, and the nodes,
/// each parent before its children.
struct Tree {
    /// A node: the box around the centres below it, the largest radius below it, and how many balls it has, which is 0
    /// but for a leaf; a leaf has the number of its first ball, another node that of its second child. The first child
    /// follows the node.
    static constexpr std::size_t low = 0, high = 3, radius = 6, count = 7, link = 8, node_floats = 9;

    /// The nearest ball, of equally near ones the first. Distances are compared as floats tell them, so it is the ball
    /// that a loop over all of them would find.
    static const float* nearest(const float* data, const Vec3<float>& p);

    /// Which balls matter to the points of a box: those that may be the nearest somewhere, and no farther than
    /// `farthest`. Beyond that the distance need not be itself, as long as it is more than that, too.
    struct Wanted {
        const PointRange& box;
        double farthest;
        std::size_t most;  ///< more balls are too many
    };
    /// Appends their ShortList, or returns false if there are too many. They are sought in the tree, or, if `around` is
    /// not empty, in that list of a box around; of those there are never too many. The list has one ball at least.
    static bool balls_in(const float* tree, const Wanted&, std::span<const float> around, std::vector<float>& floats);

    /// The side of a cube of which as many as there are balls fill the box around them.
    static float spacing(const float* data);

    /// The largest d·p over all balls, of which the radii are larger by so much.
    static double support(const float* data, const glm::dvec3& d, float more);
};

/// The data of a Tree. There must be a ball. The order of the balls does not matter.
std::vector<float> make_tree(std::vector<glm::vec4> balls);

/// The box around all balls of a tree.
Bounds bounds_of(const float* tree);

}  // namespace phasetree::balls
