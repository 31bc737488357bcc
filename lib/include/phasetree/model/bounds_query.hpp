#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <memory>

#include "phasetree/math/bounds.hpp"

namespace phasetree {

class Field;
class Phased;

/// Asks subtrees for a box around {f ≤ level}; for a multiphase object, around all points within `level` of a material
/// (a phase that is not the vacuum).
/// Answers are kept, so that a shared subtree is asked once for each level.
///
/// There are two ways to answer. The result is the box by boxes, with those sides by directions that are tighter by
/// more than a hundredth of its size.
///
/// *By boxes:* each node makes its box from those of its children, along its own axes. That is fast, but each rotation
/// puts a box around a rotated box.
///
/// *By directions:* let the root be the node that is asked first. Six directions, those of the outward normals of the
/// sides of the root's box, are passed down the tree, and each node gives its support along them, the maximum of d·p. A
/// map of space transforms the directions for its child, so that a chain of rotations loses nothing:
///     max of d·p over p in M A + v  =  max of (Mᵀd)·p over p in A,  plus d·v.
/// The six numbers are kept as a Bounds: a box along the root's axes, measured from where the node's own origin lies.
/// Behind a map that folds space two opposite sides may be asked along the same direction, so a low side may lie above
/// a high one; only Bounds{} means that there is nothing.
class BoundsQuery {
  public:
    /// The outward normals of the low sides along x, y and z, then those of the high sides, in the space of the node
    /// that is asked.
    using Directions = std::array<glm::dvec3, 6>;

    BoundsQuery();
    ~BoundsQuery();
    BoundsQuery(const BoundsQuery&) = delete;
    BoundsQuery& operator=(const BoundsQuery&) = delete;

    Bounds operator()(const Field&, float level);
    Bounds operator()(const Phased&, float level);

    /// Whether the box is wanted along the axes of the node that is asked. If not, a node must make its answer by one
    /// of the functions below.
    bool is_by_boxes() const { return way_ != Way::by_directions; }

    /// A child's box along its own axes, whichever way the parent is asked.
    Bounds own_box(const Field&, float level);
    Bounds own_box(const Phased&, float level);

    /// The answer of a node that knows a box in its own space.
    Bounds placed(const Bounds& box) const;
    /// The answer of a node that also knows its support(d) along any direction d.
    template <class Support>
    Bounds placed(const Bounds& box, const Support& support) const {
        if (is_by_boxes() || box.empty()) return placed(box);
        Supports supports;
        for (std::size_t i = 0; i < supports.size(); ++i) supports[i] = support(directions_[i]);
        return intersect(placed(box), gathered(supports));
    }
    /// The answer of a node that maps space: its support along d is that of its child, which ask() asks, along
    /// towards(d), plus beyond(d).
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
    /// The answer of a node that maps its child by p ↦ M p + v.
    template <class Ask>
    Bounds through(const glm::dmat3& m, const glm::dvec3& v, const Ask& ask) {
        return through([&](const glm::dvec3& d) { return d * m; }, [&](const glm::dvec3& d) { return glm::dot(d, v); },
                       ask);
    }
    /// The answer of a node that is an intersection. It is asked along the node's own axes as well, because along other
    /// directions each child alone may be unbounded or large where several together are small.
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
    /// At most this many subtrees of a root are bounded along directions; the others are bounded by boxes. A shape used
    /// in many places needs other directions in each, which would be slow.
    static constexpr std::size_t most_asked = 20'000;

    static Bounds gathered(const Supports&);
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
