#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "phasetree/model/handle.hpp"
#include "phasetree/trace/tracer.hpp"

namespace phasetree::measuring {

/// Thrown when work on boxes is stopped, or when there are more boxes than allowed.
struct DivisionStopped {
    bool exceeded_max_boxes = false;
};

/// Throws DivisionStopped in a long loop when the work should end. To be cheap, it asks only once in many calls.
class StopPoll {
  public:
    explicit StopPoll(const std::function<bool()>& is_stopped) : is_stopped_(is_stopped) {}
    void operator()() {
        constexpr std::uint32_t calls_between_polls = 1024;
        if (++calls_ % calls_between_polls == 0 && is_stopped_()) throw DivisionStopped();
    }

  private:
    const std::function<bool()>& is_stopped_;
    std::uint32_t calls_ = 0;
};

/// A box of doubles.
struct Cube {
    std::array<double, 3> low{}, high{};

    std::array<double, 3> centre() const;
    double half_diagonal() const;
    double distance(const std::array<double, 3>& p) const;
    double distance(const Cube&) const;
};

/// A box of the octree: those phases that may be in it, and the directions in which their components do not rise.
struct OctreeLeaf {
    static constexpr std::uint32_t no_falls = 0xffffffff;

    std::uint64_t key = 0;       ///< Morton code of its low corner; the lowest bit is of x
    std::uint64_t possible = 0;  ///< bits of phases; a single bit if the box is certainly in one phase
    std::uint64_t listed = 0;    ///< bits of the phases that were possible before PhaseOctree::narrow()
    /// Index in PhaseOctree::falls of the entry for the first listed phase; those of the others follow.
    std::uint32_t falls = no_falls;
    std::uint8_t level = 0;

    bool is_possible(int phase) const { return (possible >> phase) & 1; }
    bool is_only(int phase) const { return possible == std::uint64_t{1} << phase; }
    bool is_certain() const { return (possible & (possible - 1)) == 0; }
};

/// A point that is certainly in a phase.
struct CertainPoint {
    glm::vec3 point;
    double depth;  ///< minus the component there, or an estimate of it
};

/// A cube around an object, divided down to boxes of one size where the phase is in doubt. Boxes are sorted by key, so
/// a box that contains others is a range of them.
struct PhaseOctree {
    int levels = 0;
    std::array<std::vector<float>, 3> lines;  ///< coordinates of the sides of the smallest boxes along each axis
    std::vector<OctreeLeaf> leaves;
    std::vector<std::uint8_t> falls;  ///< PhaseInBox::falls of the listed phases of each leaf
    std::array<std::optional<CertainPoint>, Phase::capacity> deepest;  ///< a point of each phase, if one is known
    float value_error = 0;  ///< an upper bound of the rounding error of any component

    std::uint32_t count() const { return std::uint32_t{1} << levels; }
    double side() const { return static_cast<double>(lines[0][1]) - static_cast<double>(lines[0][0]); }
    using Cell = std::array<std::uint32_t, 3>;
    Cell cell_of(std::uint64_t key) const;
    static std::uint64_t key_of(const Cell&);
    std::uint32_t size_of(const OctreeLeaf& leaf) const { return std::uint32_t{1} << (levels - leaf.level); }
    Cube cube(const OctreeLeaf&) const;
    Cube whole() const;
    /// The smallest box of the octree that contains both keys.
    Cube around(std::uint64_t first, std::uint64_t last_key, std::uint32_t size_of_last) const;
    std::uint8_t falls_of(const OctreeLeaf&, int phase) const;
    std::size_t find(const Cell&) const;

    /// Calls f(index) for the leaves that share a face with a leaf in a direction, as in PhaseInBox::falls.
    template <class F>
    void across_face(const OctreeLeaf& leaf, int direction, F&& f) const {
        std::array<int, 3> step{};
        step[static_cast<std::size_t>(direction / 2)] = direction % 2 == 0 ? -1 : 1;
        beside(leaf, step, f);
    }
    /// Calls f(index) for the leaves that share at least a point with a leaf.
    template <class F>
    void around_leaf(const OctreeLeaf& leaf, F&& f) const {
        for (int i = 0; i < 27; ++i)
            if (i != 13) beside(leaf, {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1}, f);
    }
    /// Like around_leaf(), but for half of the directions, so that most pairs of adjacent leaves are visited once when
    /// this is called for all leaves.
    template <class F>
    void around_leaf_once(const OctreeLeaf& leaf, F&& f) const {
        for (int i = 0; i < 13; ++i) beside(leaf, {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1}, f);
    }

    /// Excludes phases from boxes by what neighbouring boxes contain. Suppose that a phase's component does not rise in
    /// a box towards one of its faces. Then a point of the phase in the box can move through this face without leaving
    /// the phase. So if no box on the other side can contain the phase, this box does not contain it either.
    /// Throws DivisionStopped.
    void narrow(const std::function<bool()>& is_stopped);

  private:
    bool is_excluded(const OctreeLeaf&, int phase) const;
    template <class F>
    void beside(const OctreeLeaf& leaf, const std::array<int, 3>& step, F&& f) const {
        const Cell at = cell_of(leaf.key);
        const std::uint32_t size = size_of(leaf);
        Cell low{}, extent{};
        for (std::size_t i = 0; i < 3; ++i) {
            if ((step[i] < 0 && at[i] == 0) || (step[i] > 0 && at[i] + size == count())) return;
            low[i] = step[i] < 0 ? at[i] - 1 : step[i] > 0 ? at[i] + size : at[i];
            extent[i] = step[i] == 0 ? size : 1;
        }
        in_region(low, extent, f);
    }
    template <class F>
    void in_region(const Cell& low, const Cell& extent, F& f) const {
        const std::size_t found = find(low);
        const OctreeLeaf& leaf = leaves[found];
        const std::uint32_t size = size_of(leaf);
        const Cell at = cell_of(leaf.key);
        bool is_all = true;
        for (std::size_t i = 0; i < 3; ++i) is_all = is_all && low[i] + extent[i] <= at[i] + size;
        if (is_all) return f(found);
        for (int part = 0; part < 8; ++part) {
            Cell part_low = low, part_extent = extent;
            bool is_there = true;
            for (std::size_t i = 0; i < 3; ++i) {
                const bool is_high = (part >> i) & 1;
                if (extent[i] == 1) {
                    is_there = is_there && !is_high;
                    continue;
                }
                part_extent[i] = extent[i] / 2;
                if (is_high) part_low[i] += part_extent[i];
            }
            if (is_there) in_region(part_low, part_extent, f);
        }
    }
};

/// Divides the cube around an object to this many levels. `is_stopped` is called from any thread.
PhaseOctree divided(const Phased& object, const TraceableObject&, int levels, std::size_t max_boxes,
                    const std::function<bool()>& is_stopped);

/// The number of levels at which boxes have this side; at most the one that 32-bit coordinates allow.
int levels_for(const TraceableObject&, double side);

}  // namespace phasetree::measuring
