#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <memory>

#include "phasetree/math/bounds.hpp"

namespace phasetree {

class Field;
class Phased;

/// Asks subtrees for a box around {f ≤ level} (for a multiphase object: around everything within level of a phase).
/// Answers are remembered, so that shared subtrees are asked once a level.
///
/// There are two ways to answer, and the box is the smaller of both. *By boxes*, each node makes its box of those below
/// it, along its own axes. That is fast, but each turn puts a box around a turned box. *By directions*, nodes are told
/// along which six directions of their own space the sides of the box are that the first one was asked for. A map of
/// space passes them on as they are seen on its other side, so a chain of turns costs nothing:
///     the most of d·p over M A + v  is  the most of (Mᵀd)·p over A,  plus d·v.
/// A node says how far it reaches along each; the result is a box all the same, of the axes of the first node, measured
/// from where the asked node's origin lies. Behind a map that folds space, two opposite sides may be seen along the
/// same direction, and a low side be above a high one; only Bounds{} is nothing.
class BoundsQuery {
  public:
    /// Along which the low sides, then the high ones, are seen from.
    using Directions = std::array<glm::dvec3, 6>;

    BoundsQuery();
    ~BoundsQuery();
    BoundsQuery(const BoundsQuery&) = delete;
    BoundsQuery& operator=(const BoundsQuery&) = delete;

    Bounds operator()(const Field&, float level);
    Bounds operator()(const Phased&, float level);

    /// Whether the box is wanted along the axes of the node that is asked. Else it goes through what follows.
    bool is_by_boxes() const { return way_ != Way::by_directions; }

    /// A child's box along its own axes, also where the parent's is not wanted along its.
    Bounds own_box(const Field&, float level);
    Bounds own_box(const Phased&, float level);

    /// The answer of a node that has a box in its own space.
    Bounds placed(const Bounds& box) const;
    /// And that of one that also knows the most of d·p along any direction d.
    template <class Support>
    Bounds placed(const Bounds& box, const Support& support) const {
        if (is_by_boxes() || box.empty()) return placed(box);
        Reaches reach;
        for (std::size_t i = 0; i < reach.size(); ++i) reach[i] = support(directions_[i]);
        return intersect(placed(box), gathered(reach));
    }
    /// The answer of a node that maps space: its points reach along d as far as the child's, which ask() asks for, do
    /// along towards(d), and beyond(d) more.
    template <class Towards, class Beyond, class Ask>
    Bounds through(const Towards& towards, const Beyond& beyond, const Ask& ask) {
        const Directions outer = directions_;
        Reaches more;
        for (std::size_t i = 0; i < outer.size(); ++i) {
            directions_[i] = towards(outer[i]);
            more[i] = beyond(outer[i]);
        }
        const Bounds inner = ask();
        directions_ = outer;
        return moved(inner, more);
    }
    /// That of p ↦ M p + v.
    template <class Ask>
    Bounds through(const glm::dmat3& m, const glm::dvec3& v, const Ask& ask) {
        return through([&](const glm::dvec3& d) { return d * m; }, [&](const glm::dvec3& d) { return glm::dot(d, v); },
                       ask);
    }
    /// The answer of a node that is an intersection: ask() is asked along the node's own axes as well. What is bounded
    /// by several children may be unbounded, or large, along the directions by each of them alone.
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
    using Reaches = std::array<double, 6>;
    struct Memory;

    static constexpr Directions along_axes{{{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    /// Subtrees that are asked by directions, of one first node; then boxes have to do. A shape that is used in many
    /// places is asked along other directions in each.
    static constexpr std::size_t most_asked = 20'000;

    static Bounds gathered(const Reaches&);
    static Bounds moved(const Bounds&, const Reaches& more);
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
