// Decides statements from the adjacency of boxes alone.
//
// *Sets of boxes.* A box is *in* a phase if all of it certainly is. It *may meet* the phase unless it certainly
// contains none of it. If a chain of boxes in the phase, each sharing a face with the next, joins two points, the phase
// connects them. If no chain of boxes that may meet the phase, each touching the next, joins two points, the phase does
// not connect them.
#include "measuring/decide.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "math/disjoint_sets.hpp"

namespace phasetree::measuring {

namespace {

Proof absent() {
    return {Verdict::refuted, "no point has this phase", {}, 0, {}};
}

// Groups the leaves for which `is_wanted` holds. Leaves that share a face, or at least a point, are in the same group.
template <class IsWanted>
DisjointSets groups_of(const Evidence& e, bool by_faces, const IsWanted& is_wanted) {
    const PhaseOctree& octree = e.octree;
    StopPoll poll(e.is_stopped);
    DisjointSets groups(octree.leaves.size());
    for (std::size_t i = 0; i < octree.leaves.size(); ++i) {
        poll();
        if (!is_wanted(octree.leaves[i])) continue;
        const auto unite = [&](std::size_t other) {
            if (is_wanted(octree.leaves[other])) groups.join(i, other);
        };
        if (!by_faces) {
            octree.around_leaf_once(octree.leaves[i], unite);
            continue;
        }
        for (const int direction : {1, 3, 5}) octree.across_face(octree.leaves[i], direction, unite);
    }
    return groups;
}

// The largest leaf for which `is_wanted` holds; among equals, the first.
template <class IsWanted>
std::optional<std::uint32_t> largest(const PhaseOctree& octree, const IsWanted& is_wanted) {
    std::optional<std::uint32_t> found;
    for (std::size_t i = 0; i < octree.leaves.size(); ++i)
        if (is_wanted(i) && (!found || octree.leaves[i].level < octree.leaves[*found].level))
            found = static_cast<std::uint32_t>(i);
    return found;
}

// Whether each point of the phase in a leaf in doubt is joined to a box in the phase: the leaf *drains*. It does if
// there is a direction in which the phase's component does not rise anywhere in the leaf, and each leaf on that side is
// in the phase, drains, or does not meet the phase. A point of the phase may then move in that direction until it
// leaves the leaf, and stays in the phase.
bool all_drain(const Evidence& e, int phase) {
    const PhaseOctree& octree = e.octree;
    StopPoll poll(e.is_stopped);
    const std::vector<OctreeLeaf>& leaves = octree.leaves;
    std::vector<bool> is_good(leaves.size());
    std::queue<std::uint32_t> fresh;
    std::size_t left = 0;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        if (!leaves[i].is_possible(phase)) continue;
        is_good[i] = leaves[i].is_only(phase);
        if (is_good[i])
            fresh.push(static_cast<std::uint32_t>(i));
        else
            ++left;
    }
    const auto drains = [&](const OctreeLeaf& leaf) {
        const std::uint8_t falls = octree.falls_of(leaf, phase);
        for (int direction = 0; direction < 6; ++direction) {
            if (((falls >> direction) & 1) == 0) continue;
            bool is_all = true, is_any = false;
            octree.across_face(leaf, direction, [&](std::size_t i) {
                is_any = true;
                is_all = is_all && (is_good[i] || !leaves[i].is_possible(phase));
            });
            if (is_any && is_all) return true;
        }
        return false;
    };
    for (; !fresh.empty(); fresh.pop()) {
        poll();
        for (int direction = 0; direction < 6; ++direction)
            octree.across_face(leaves[fresh.front()], direction, [&](std::size_t i) {
                if (is_good[i] || !leaves[i].is_possible(phase) || !drains(leaves[i])) return;
                is_good[i] = true;
                fresh.push(static_cast<std::uint32_t>(i));
                --left;
            });
    }
    return left == 0;
}

bool is_at_boundary(const PhaseOctree& octree, const OctreeLeaf& leaf) {
    const PhaseOctree::Cell at = octree.cell_of(leaf.key);
    const std::uint32_t size = octree.size_of(leaf);
    return std::ranges::any_of(at, [&](std::uint32_t v) { return v == 0 || v + size == octree.count(); });
}

// Whether boxes that may meet the inside are separated by boxes in the walls from the space around the object.
bool is_separated(const Evidence& e, std::uint64_t walls, std::uint64_t inside) {
    const PhaseOctree& octree = e.octree;
    StopPoll poll(e.is_stopped);
    std::vector<bool> is_reached(octree.leaves.size());
    std::queue<std::uint32_t> fresh;
    bool is_inside_reached = false;
    const auto reach = [&](std::size_t i) {
        const OctreeLeaf& leaf = octree.leaves[i];
        if (is_reached[i] || (leaf.possible & ~walls) == 0) return;
        is_reached[i] = true;
        is_inside_reached = is_inside_reached || (leaf.possible & inside) != 0;
        fresh.push(static_cast<std::uint32_t>(i));
    };
    for (std::size_t i = 0; i < octree.leaves.size(); ++i)
        if (is_at_boundary(octree, octree.leaves[i])) reach(i);
    for (; !fresh.empty() && !is_inside_reached; fresh.pop()) {
        poll();
        octree.around_leaf(octree.leaves[fresh.front()], reach);
    }
    return !is_inside_reached;
}

// The leaves of a path through boxes outside the walls, from a box that is in a phase of `inside` to the space around
// the object.
std::vector<std::uint32_t> leak(const Evidence& e, std::uint64_t walls, std::uint64_t inside) {
    const PhaseOctree& octree = e.octree;
    StopPoll poll(e.is_stopped);
    constexpr std::uint32_t none = 0xffffffff;
    std::vector<std::uint32_t> from(octree.leaves.size(), none);
    std::queue<std::uint32_t> fresh;
    const auto is_free = [&](std::size_t i) { return (octree.leaves[i].possible & walls) == 0; };
    for (std::size_t i = 0; i < octree.leaves.size(); ++i)
        if (is_free(i) && is_at_boundary(octree, octree.leaves[i])) {
            from[i] = static_cast<std::uint32_t>(i);
            fresh.push(from[i]);
        }
    for (; !fresh.empty(); fresh.pop()) {
        poll();
        const std::uint32_t at = fresh.front();
        const OctreeLeaf& leaf = octree.leaves[at];
        if (leaf.is_certain() && (leaf.possible & inside) != 0) {
            std::vector<std::uint32_t> path{at};
            while (from[path.back()] != path.back()) path.push_back(from[path.back()]);
            return path;
        }
        for (int direction = 0; direction < 6; ++direction)
            octree.across_face(leaf, direction, [&](std::size_t i) {
                if (from[i] != none || !is_free(i)) return;
                from[i] = at;
                fresh.push(static_cast<std::uint32_t>(i));
            });
    }
    return {};
}

struct ClosestPair {
    double distance;
    std::uint32_t first, second;
};

// The closest pair of leaves, one from each list, if they are closer than `limit`.
class ClosestLeaves {
  public:
    ClosestLeaves(const Evidence& e, double limit) : octree_(e.octree), poll_(e.is_stopped) { best_.distance = limit; }
    std::optional<ClosestPair> run(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
        if (!a.empty() && !b.empty()) search(a, b);
        return is_found_ ? std::optional(best_) : std::nullopt;
    }

  private:
    void search(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
        poll_();
        const Cube of_a = cube_of(octree_, a), of_b = cube_of(octree_, b);
        const double distance = of_a.distance(of_b);
        if (!(distance < best_.distance)) return;
        if (a.size() == 1 && b.size() == 1) {
            best_ = {distance, a.front(), b.front()};
            is_found_ = true;
            return;
        }
        const bool halves_a = b.size() == 1 || (a.size() > 1 && of_a.half_diagonal() >= of_b.half_diagonal());
        const std::size_t middle = (halves_a ? a : b).size() / 2;
        if (halves_a) {
            search(a.first(middle), b);
            search(a.subspan(middle), b);
        } else {
            search(a, b.first(middle));
            search(a, b.subspan(middle));
        }
    }

    const PhaseOctree& octree_;
    StopPoll poll_;
    ClosestPair best_{0, 0, 0};
    bool is_found_ = false;
};

// Points of two boxes that are as close to each other as the boxes.
std::pair<glm::vec3, glm::vec3> closest_points(const Cube& a, const Cube& b) {
    std::pair<glm::vec3, glm::vec3> points;
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double low = std::max(a.low[k], b.low[k]), high = std::min(a.high[k], b.high[k]);
        const bool overlap = low <= high;
        points.first[i] = static_cast<float>(overlap                ? 0.5 * (low + high)
                                             : a.high[k] < b.low[k] ? a.high[k]
                                                                    : a.low[k]);
        points.second[i] = static_cast<float>(overlap                ? 0.5 * (low + high)
                                              : a.high[k] < b.low[k] ? b.low[k]
                                                                     : b.high[k]);
    }
    return points;
}

// A point of each phase, joined by a path without other phases: approximately the closest pair of such points that are
// centres of boxes.
std::optional<std::vector<Witness>> contact(const Evidence& e, Phase a, Phase b) {
    const std::uint64_t both = (PhaseSet::of(a) | PhaseSet::of(b)).bits;
    DisjointSets groups = groups_of(e, true, [&](const OctreeLeaf& leaf) { return (leaf.possible & ~both) == 0; });
    const auto leaves_in = [&](Phase p) {
        return leaves_where(e.octree, [p](const OctreeLeaf& leaf) { return leaf.is_only(p.index); });
    };
    std::vector<std::uint32_t> of_a = leaves_in(a), of_b = leaves_in(b);
    std::vector<bool> has_a(e.octree.leaves.size());
    for (const std::uint32_t i : of_a) has_a[groups.root(i)] = true;
    const auto joined = std::ranges::find_if(of_b, [&](std::uint32_t i) { return has_a[groups.root(i)]; });
    if (joined == of_b.end()) return std::nullopt;
    const std::size_t group = groups.root(*joined);
    const auto is_elsewhere = [&](std::uint32_t i) { return groups.root(i) != group; };
    std::erase_if(of_a, is_elsewhere);
    std::erase_if(of_b, is_elsewhere);
    const auto closest = ClosestLeaves(e, std::numeric_limits<double>::infinity()).run(of_a, of_b);
    return std::vector{e.middle_of(e.octree.leaves[closest->first]), e.middle_of(e.octree.leaves[closest->second])};
}

}  // namespace

bool Evidence::is_absent(Phase phase) const {
    return std::ranges::none_of(octree.leaves, [&](const OctreeLeaf& leaf) { return leaf.is_possible(phase.index); });
}

std::optional<std::vector<Witness>> Evidence::points_of(PhaseSet set) const {
    std::vector<Witness> points;
    bool is_known = true;
    for_each_phase(set.bits, [&](int i) {
        const auto& p = octree.deepest[static_cast<std::size_t>(i)];
        is_known = is_known && p.has_value();
        if (p) points.push_back({p->point, Phase{static_cast<std::uint8_t>(i)}});
    });
    return is_known ? std::optional(points) : std::nullopt;
}

Witness Evidence::middle_of(const OctreeLeaf& leaf) const {
    const std::array<double, 3> middle = octree.cube(leaf).centre();
    return {glm::vec3(glm::dvec3(middle[0], middle[1], middle[2])),
            Phase{static_cast<std::uint8_t>(std::countr_zero(leaf.possible))}};
}

Proof decide(const Evidence& e, const IsPresent& s) {
    if (const auto points = e.points_of(PhaseSet::of(s.phase))) return {Verdict::proved, "", *points, 0, {}};
    if (e.is_absent(s.phase)) return absent();
    return {};
}

Proof decide(const Evidence& e, const IsConnected& s) {
    const int phase = s.phase.index;
    const auto is_in = [&](const OctreeLeaf& leaf) { return leaf.is_only(phase); };
    if (e.is_absent(s.phase)) return absent();
    const auto first = largest(e.octree, [&](std::size_t i) { return is_in(e.octree.leaves[i]); });
    if (!first) return {};
    const auto may_meet = [&](const OctreeLeaf& leaf) { return leaf.is_possible(phase); };
    DisjointSets apart = groups_of(e, false, may_meet);
    const auto elsewhere = largest(
        e.octree, [&](std::size_t i) { return is_in(e.octree.leaves[i]) && apart.root(i) != apart.root(*first); });
    if (elsewhere) {
        std::vector<std::size_t> pieces;
        for (const std::uint32_t i : leaves_where(e.octree, is_in)) pieces.push_back(apart.root(i));
        std::ranges::sort(pieces);
        const auto count = std::distance(pieces.begin(), std::unique(pieces.begin(), pieces.end()));
        return {Verdict::refuted,
                "it has at least " + std::to_string(count) + " pieces",
                {e.middle_of(e.octree.leaves[*first]), e.middle_of(e.octree.leaves[*elsewhere])},
                0,
                {}};
    }
    DisjointSets together = groups_of(e, true, is_in);
    for (const std::uint32_t i : leaves_where(e.octree, is_in))
        if (together.root(i) != together.root(*first)) return {};
    if (!all_drain(e, phase)) return {};
    return {Verdict::proved, "", {}, 0, {}};
}

Proof decide(const Evidence& e, const IsClosed& s) {
    bool is_one_absent = false;
    const PhaseSet all = s.walls | s.inside;
    for_each_phase(all.bits,
                   [&](int i) { is_one_absent = is_one_absent || e.is_absent(Phase{static_cast<std::uint8_t>(i)}); });
    if (is_one_absent) return {Verdict::refuted, "no point has one of the phases", {}, 0, {}};
    if (e.points_of(all) && is_separated(e, s.walls.bits, s.inside.bits)) return {Verdict::proved, "", {}, 0, {}};
    const std::vector<std::uint32_t> path = leak(e, s.walls.bits, s.inside.bits);
    if (path.empty()) return {};
    Proof proof{Verdict::refuted, "a path leads outside", {}, 0, {}};
    for (const std::uint32_t i : path) {
        const OctreeLeaf& leaf = e.octree.leaves[i];
        Witness witness = e.middle_of(leaf);
        if (!leaf.is_certain()) witness.phase = e.evaluator.label(witness.point, Evaluator::thread_workspace());
        proof.witnesses.push_back(witness);
    }
    return proof;
}

Proof decide(const Evidence& e, const AreApart& s) {
    if (e.is_absent(s.first) || e.is_absent(s.second)) return absent();
    const auto may_meet = [](Phase p) { return [p](const OctreeLeaf& leaf) { return leaf.is_possible(p.index); }; };
    const auto is_in = [](Phase p) { return [p](const OctreeLeaf& leaf) { return leaf.is_only(p.index); }; };
    // Distances of boxes are rounded. Boxes that do not touch are at least one side of the smallest boxes apart.
    const double rounding = 1e-12 * e.octree.whole().half_diagonal();
    const double limit = std::max(s.at_least * (1 + 1e-12) + rounding, 0.5 * e.octree.side());
    const auto close = ClosestLeaves(e, limit).run(leaves_where(e.octree, may_meet(s.first)),
                                                   leaves_where(e.octree, may_meet(s.second)));
    if (!close && e.points_of(PhaseSet::of(s.first) | PhaseSet::of(s.second))) return {Verdict::proved, "", {}, 0, {}};
    if (const auto points = contact(e, s.first, s.second)) return {Verdict::refuted, "they touch", *points, 0, {}};
    const auto closer = ClosestLeaves(e, s.at_least * (1 - 1e-6) - rounding)
                            .run(leaves_where(e.octree, is_in(s.first)), leaves_where(e.octree, is_in(s.second)));
    if (!closer) return {};
    const auto [a, b] =
        closest_points(e.octree.cube(e.octree.leaves[closer->first]), e.octree.cube(e.octree.leaves[closer->second]));
    return {Verdict::refuted, "they are closer than required", {{a, s.first}, {b, s.second}}, 0, {}};
}

Proof decide(const Evidence& e, const AreTouching& s) {
    if (e.is_absent(s.first) || e.is_absent(s.second)) return absent();
    if (const auto points = contact(e, s.first, s.second)) return {Verdict::proved, "", *points, 0, {}};
    if (decide(e, AreApart{s.first, s.second, 0}).verdict == Verdict::proved)
        return {Verdict::refuted, "they do not touch", {}, 0, {}};
    return {};
}

}  // namespace phasetree::measuring
