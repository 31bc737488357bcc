#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <memory>

#include "phasetree/math/bounds.hpp"

namespace phasetree {

class Field;
class Phased;

/// Computes a box around {f ≤ level} of a field, or around all points within `level` of a material (a phase other than
/// the vacuum) of an object. Answers are cached, so a shared subtree is evaluated once per level.
///
/// There are two methods. The result is the box of the first, with each side replaced by that of the second if it is
/// tighter by more than a hundredth of the box's size.
///
/// *By boxes:* each node makes its box from those of its children, along its own axes. This is fast, but each rotation
/// puts a box around a rotated box.
///
/// *By directions:* the query starts at one node, here called the root. The outward normals of the six sides of the
/// root's box are passed down the tree. Each node returns its support along them, the maximum of d·p. A map of space
/// transforms the directions for its child, so a chain of rotations loses nothing:
///     max of d·p over p in M A + v  =  max of (Mᵀd)·p over p in A,  plus d·v.
/// The six supports are stored as a Bounds, with those of the low sides negated. It is a box whose axes are the root's
/// and whose origin is the node's. A map that folds space may map two opposite directions to one, so that low > high.
/// Here, such a box does not count as empty, although Bounds::empty() is true; only Bounds{} does.
class BoundsQuery {
  public:
    /// The outward normals of the low sides along x, y and z, then those of the high sides, in the space of the node
    /// being asked.
    using Directions = std::array<glm::dvec3, 6>;

    BoundsQuery();
    ~BoundsQuery();
    BoundsQuery(const BoundsQuery&) = delete;
    BoundsQuery& operator=(const BoundsQuery&) = delete;

    Bounds operator()(const Field&, float level);
    Bounds operator()(const Phased&, float level);

    /// Whether the box is requested along the axes of the node being asked. If not, the node must produce its answer
    /// with one of the functions below.
    bool is_by_boxes() const { return way_ != Way::by_directions; }

    /// A child's box along its own axes, whichever method is used for the parent.
    Bounds own_box(const Field&, float level);
    Bounds own_box(const Phased&, float level);

    /// Returns the answer of a node that knows a box in its own space: the box, or its supports along the directions,
    /// depending on the method in use.
    Bounds placed(const Bounds& box) const;
    /// The same for a node that also knows its support(d) along any direction d, which may be tighter.
    template <class Support>
    Bounds placed(const Bounds& box, const Support& support) const {
        if (is_by_boxes() || box.empty()) return placed(box);
        Supports supports;
        for (std::size_t i = 0; i < supports.size(); ++i) supports[i] = support(directions_[i]);
        return intersect(placed(box), gathered(supports));
    }
    /// Returns the answer of a node that maps space. Its support along d is that of its child along towards(d), plus
    /// beyond(d), which is d·v for a translation by v; ask() asks the child.
    template <class Towards, class Beyond, class Ask>
    Bounds through(const Towards& towards, const Beyond& beyond, const Ask& ask) {
        const Directions outer = directions_;
        Supports more;
        for (std::size_t i = 0; i < outer.size(); ++i) {
            directions_[i] = towards(outer[i]);
            more[i] = beyond(outer[i]);
        }
        const Bounds inner = ask();
        directions_ = outer;
        return moved(inner, more);
    }
    /// Returns the answer of a node that maps its child by p ↦ M p + v.
    template <class Ask>
    Bounds through(const glm::dmat3& m, const glm::dvec3& v, const Ask& ask) {
        return through([&](const glm::dvec3& d) { return d * m; }, [&](const glm::dvec3& d) { return glm::dot(d, v); },
                       ask);
    }
    /// Returns the answer of an intersection. `ask` is called a second time along the node's own axes, because along
    /// other directions each child alone may be large or unbounded although their intersection is small.
    template <class Ask>
    Bounds cut(const Ask& ask) {
        const Bounds here = ask();
        if (is_by_boxes() || directions_ == along_axes) return here;
        const Directions outer = directions_;
        directions_ = along_axes;
        const Bounds own = ask();
        directions_ = outer;
        return intersect(here, placed(own));
    }

  private:
    enum class Way { both, by_boxes, by_directions };
    using Supports = std::array<double, 6>;
    struct Memory;

    static constexpr Directions along_axes{{{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    /// The maximum number of subtrees of a root that are bounded by directions; the rest are bounded by boxes. A shape
    /// used in many places needs different directions in each, which would be slow.
    static constexpr std::size_t max_directed = 20'000;

    /// A box from six supports, as described above.
    static Bounds gathered(const Supports&);
    /// The box with `more` added to its six supports.
    static Bounds moved(const Bounds&, const Supports& more);
    template <class Handle>
    Bounds answer(const Handle&, float level);
    template <class Handle>
    Bounds along_own_axes(const Handle&, float level);
    template <class Handle>
    Bounds by_boxes(const Handle&, float level);
    template <class Handle>
    Bounds by_directions(const Handle&, float level);

    Way way_ = Way::both;
    Directions directions_ = along_axes;
    std::unique_ptr<Memory> memory_;
};

}  // namespace phasetree
