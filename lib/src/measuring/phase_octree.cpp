#include "measuring/phase_octree.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <queue>

#include "measuring/divide.hpp"
#include "phasetree/math/float_mode.hpp"
#include "phasetree/program/program.hpp"
#include "rewriting/rewrite.hpp"

namespace phasetree::measuring {

using building::CellBudget, building::WorkerPool;
using rewriting::ArenaScope, rewriting::rewrite;

namespace {

// Keys have 16 bits for each axis, more than floats allow levels.
constexpr int most_levels = 14;
// Sides of the smallest boxes, in resolutions.
constexpr double least_side_of_box = 16;
// The cube is divided into at least this many boxes in doubt before threads share them, unless there are fewer.
constexpr std::size_t enough_boxes = 128;
// By which fraction the cube's side exceeds the object's longest side, and the object's offset in the cube as fractions
// of that side. Faces of objects often have round coordinates; these fractions keep faces of boxes away from them.
constexpr double cube_excess = 0.0271;
constexpr std::array<double, 3> offset_in_cube{0.0131, 0.0157, 0.0119};

// Moves the bits of a number three places apart.
std::uint64_t spread(std::uint64_t v) {
    std::uint64_t result = 0;
    for (int bit = 0; bit < 16; ++bit) result |= ((v >> bit) & 1) << (3 * bit);
    return result;
}

std::uint32_t gathered(std::uint64_t v) {
    std::uint64_t result = 0;
    for (int bit = 0; bit < 16; ++bit) result |= ((v >> (3 * bit)) & 1) << bit;
    return static_cast<std::uint32_t>(result);
}

double longest_side(const TraceableObject& object) {
    const glm::dvec3 extent(object.bounds.extent());
    return std::max({extent.x, extent.y, extent.z});
}

Bounds cube_around(const TraceableObject& object) {
    const double side = longest_side(object) * (1 + cube_excess);
    Bounds cube;
    for (int i = 0; i < 3; ++i) {
        const double low = static_cast<double>(object.bounds.low[i]) -
                           offset_in_cube[static_cast<std::size_t>(i)] * longest_side(object);
        cube.low[i] = static_cast<float>(low);
        cube.high[i] = static_cast<float>(low + side);
    }
    return cube;
}

// Sets lines[first] … lines[last] between known ones at both ends, as SubBoxes divides.
void set_lines_between(std::vector<float>& lines, std::size_t first, std::size_t last) {
    if (last - first < 2) return;
    const std::size_t middle = (first + last) / 2;
    lines[middle] = (lines[first] + lines[last]) * 0.5f;
    set_lines_between(lines, first, middle);
    set_lines_between(lines, middle, last);
}

// A box, which is a leaf unless it is divided further.
struct Item {
    Node node;
    OctreeLeaf leaf;
    bool is_leaf = false;
};

// The leaves of a part, in ascending order.
struct Found {
    std::vector<OctreeLeaf> leaves;
    std::vector<std::uint8_t> falls;
    std::array<std::optional<CertainPoint>, Phase::capacity> deepest;

    void offer(int phase, const CertainPoint& p) {
        auto& known = deepest[static_cast<std::size_t>(phase)];
        if (!known || p.depth > known->depth) known = p;
    }
};

class OctreeDivision {
  public:
    OctreeDivision(const Phased& object, const TraceableObject& traceable, int levels, std::size_t max_boxes,
                   const std::function<bool()>& is_stopped)
        : levels_(levels),
          most_boxes_(max_boxes),
          is_stopped_(is_stopped),
          recorded_(record(object)),
          root_{cube_around(traceable), rewrite(recorded_, arena_)},
          context_{ProgramContext(root_.program, recorded_.constants, PhaseSet(), 0.5f * traceable.resolution),
                   {},
                   traceable.resolution},
          budget_(std::numeric_limits<std::size_t>::max()),
          pool_(budget_, recorded_.constants),
          worker_{pool_} {}

    PhaseOctree run() {
        const FlushSubnormals flush;
        std::vector<Item> items{{root_, {}, false}};
        std::vector<Found> parts(1);
        Found& first = parts.front();
        std::size_t in_doubt = 1;
        for (int level = 0; level < levels_ && in_doubt > 0 && in_doubt < enough_boxes; ++level) {
            std::vector<Item> next;
            in_doubt = 0;
            for (const Item& item : items) {
                if (item.is_leaf) {
                    next.push_back(item);
                    continue;
                }
                each_child(item, worker_, first, [&](const Item& child) {
                    next.push_back(child);
                    in_doubt += child.is_leaf ? 0 : 1;
                });
            }
            items = std::move(next);
        }
        // parts[0] holds the certain points and falls found so far; each item gets a part of its own after it.
        parts.resize(items.size() + 1);
        tbb::parallel_for(std::size_t{0}, items.size(), [&](std::size_t i) {
            Found& part = parts[i + 1];
            if (items[i].is_leaf) {
                part.leaves.push_back(items[i].leaf);
                return;
            }
            const FlushSubnormals flush_here;
            const WorkerPool::Borrowed worker = pool_.borrow();
            divide(items[i], *worker, part);
        });
        return joined(parts);
    }

  private:
    // Calls use(item) for each eighth of a box.
    template <class Use>
    void each_child(const Item& item, Worker& worker, Found& found, const Use& use) const {
        const ArenaScope scratch(worker.scratch);
        const Division division(item.node, context_, worker);
        for (std::size_t i = 0; i < division.count(); ++i) {
            const ExaminedBox box = division.examine(i);
            Item child{box.node, {}, false};
            child.leaf.level = static_cast<std::uint8_t>(item.leaf.level + 1);
            child.leaf.key = item.leaf.key | (std::uint64_t{i} << (3 * (levels_ - child.leaf.level)));
            child.leaf.possible = possible_in(box, found);
            child.is_leaf = child.leaf.is_certain() || child.leaf.level == levels_;
            if (child.leaf.is_certain())
                found.offer(std::countr_zero(child.leaf.possible),
                            {box.node.box.centre(), 0.25 * static_cast<double>(box.node.box.diagonal())});
            else if (child.is_leaf)
                add_falls(child.leaf, box, found);
            use(child);
        }
    }
    std::uint64_t possible_in(const ExaminedBox& box, Found& found) const {
        if (box.only) return PhaseSet::of(*box.only).bits;
        std::uint64_t possible = 0;
        for (const PhaseInBox& p : box.phases) {
            if (p.is_possible()) possible |= PhaseSet::of(p.phase).bits;
            if (p.deepest < -2 * static_cast<double>(context_.program.value_error))
                found.offer(p.phase.index, {sampled_points(box.node.box)[p.deepest_at], -p.deepest});
        }
        if (possible == 0)
            for (const PhaseInBox& p : box.phases) possible |= PhaseSet::of(p.phase).bits;
        return possible;
    }
    static void add_falls(OctreeLeaf& leaf, const ExaminedBox& box, Found& found) {
        leaf.listed = leaf.possible;
        leaf.falls = static_cast<std::uint32_t>(found.falls.size());
        for_each_phase(leaf.possible, [&](int phase) {
            std::uint8_t falls = 0;
            for (const PhaseInBox& p : box.phases)
                if (p.phase.index == phase) falls = p.falls;
            found.falls.push_back(falls);
        });
    }
    // Throws DivisionStopped.
    void divide(const Item& item, Worker& worker, Found& found) {
        const ArenaScope programs(worker.programs), scratch(worker.scratch);
        std::size_t count = 0;
        each_child(item, worker, found, [&](const Item& child) {
            ++count;
            if (child.is_leaf)
                found.leaves.push_back(child.leaf);
            else
                divide(child, worker, found);
        });
        constexpr std::size_t boxes_between_polls = 256;
        const std::size_t before = boxes_.fetch_add(count);
        if (before + count > most_boxes_) throw DivisionStopped{true};
        if (before / boxes_between_polls != (before + count) / boxes_between_polls && is_stopped_())
            throw DivisionStopped{false};
    }
    PhaseOctree joined(std::vector<Found>& parts) const {
        PhaseOctree octree;
        octree.levels = levels_;
        octree.value_error = context_.program.value_error;
        for (int axis = 0; axis < 3; ++axis) {
            std::vector<float>& lines = octree.lines[static_cast<std::size_t>(axis)];
            lines.resize(octree.count() + 1);
            lines.front() = root_.box.low[axis];
            lines.back() = root_.box.high[axis];
            set_lines_between(lines, 0, octree.count());
        }
        octree.falls = parts.front().falls;
        for (std::size_t part = 0; part < parts.size(); ++part) {
            Found& found = parts[part];
            // Leaves that are made before threads share the work refer to the first part's data.
            const bool has_own = !found.falls.empty() && part > 0;
            const auto offset = has_own ? static_cast<std::uint32_t>(octree.falls.size()) : 0;
            if (has_own) octree.falls.insert(octree.falls.end(), found.falls.begin(), found.falls.end());
            for (OctreeLeaf& leaf : found.leaves) {
                if (leaf.falls != OctreeLeaf::no_falls) leaf.falls += offset;
                octree.leaves.push_back(leaf);
            }
            for (std::size_t phase = 0; phase < found.deepest.size(); ++phase)
                if (const auto& p = found.deepest[phase])
                    if (auto& known = octree.deepest[phase]; !known || p->depth > known->depth) known = p;
        }
        return octree;
    }

    int levels_;
    std::size_t most_boxes_;
    const std::function<bool()>& is_stopped_;
    Program recorded_;
    rewriting::Arena arena_;
    Node root_;
    MeasureContext context_;
    CellBudget budget_;
    WorkerPool pool_;
    Worker worker_;  // of the boxes before threads share the work
    std::atomic<std::size_t> boxes_{0};
};

}  // namespace

std::array<double, 3> Cube::centre() const {
    return {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2])};
}

double Cube::half_diagonal() const {
    double squared = 0;
    for (std::size_t i = 0; i < 3; ++i) squared += (high[i] - low[i]) * (high[i] - low[i]);
    return 0.5 * std::sqrt(squared);
}

double Cube::distance(const std::array<double, 3>& p) const {
    return distance(Cube{p, p});
}

double Cube::distance(const Cube& o) const {
    double squared = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double gap = std::max({0.0, low[i] - o.high[i], o.low[i] - high[i]});
        squared += gap * gap;
    }
    return std::sqrt(squared);
}

PhaseOctree::Cell PhaseOctree::cell_of(std::uint64_t key) const {
    return {gathered(key), gathered(key >> 1), gathered(key >> 2)};
}

std::uint64_t PhaseOctree::key_of(const Cell& cell) {
    return spread(cell[0]) | (spread(cell[1]) << 1) | (spread(cell[2]) << 2);
}

Cube PhaseOctree::cube(const OctreeLeaf& leaf) const {
    const Cell at = cell_of(leaf.key);
    const std::uint32_t size = size_of(leaf);
    Cube cube;
    for (std::size_t i = 0; i < 3; ++i) {
        cube.low[i] = static_cast<double>(lines[i][at[i]]);
        cube.high[i] = static_cast<double>(lines[i][at[i] + size]);
    }
    return cube;
}

Cube PhaseOctree::whole() const {
    Cube cube;
    for (std::size_t i = 0; i < 3; ++i) {
        cube.low[i] = static_cast<double>(lines[i].front());
        cube.high[i] = static_cast<double>(lines[i].back());
    }
    return cube;
}

Cube PhaseOctree::around(std::uint64_t first, std::uint64_t last_key, std::uint32_t size_of_last) const {
    const std::uint64_t size = size_of_last;
    const std::uint64_t last = last_key + size * size * size - 1;
    int digits = 0;
    while ((first >> (3 * digits)) != (last >> (3 * digits))) ++digits;
    OctreeLeaf box;
    box.level = static_cast<std::uint8_t>(levels - digits);
    box.key = (first >> (3 * digits)) << (3 * digits);
    return cube(box);
}

std::uint8_t PhaseOctree::falls_of(const OctreeLeaf& leaf, int phase) const {
    if (leaf.falls == OctreeLeaf::no_falls) return 0;
    const std::uint64_t before = leaf.listed & ((std::uint64_t{1} << phase) - 1);
    return falls[leaf.falls + static_cast<std::uint32_t>(std::popcount(before))];
}

bool PhaseOctree::is_excluded(const OctreeLeaf& leaf, int phase) const {
    const std::uint8_t directions = falls_of(leaf, phase);
    for (int direction = 0; direction < 6; ++direction) {
        if (((directions >> direction) & 1) == 0) continue;
        bool is_elsewhere = false, is_any = false;
        across_face(leaf, direction, [&](std::size_t i) {
            is_any = true;
            is_elsewhere = is_elsewhere || leaves[i].is_possible(phase);
        });
        if (is_any && !is_elsewhere) return true;
    }
    return false;
}

void PhaseOctree::narrow(const std::function<bool()>& is_stopped) {
    StopPoll poll(is_stopped);
    std::queue<std::uint32_t> fresh;
    for (std::size_t i = 0; i < leaves.size(); ++i)
        if (!leaves[i].is_certain()) fresh.push(static_cast<std::uint32_t>(i));
    for (; !fresh.empty(); fresh.pop()) {
        poll();
        OctreeLeaf& leaf = leaves[fresh.front()];
        std::uint64_t excluded = 0;
        for_each_phase(leaf.is_certain() ? 0 : leaf.possible, [&](int phase) {
            if (is_excluded(leaf, phase)) excluded |= std::uint64_t{1} << phase;
        });
        // At least one phase must remain, because each point is in some phase.
        if (excluded == 0 || excluded == leaf.possible) continue;
        leaf.possible &= ~excluded;
        for (int direction = 0; direction < 6; ++direction)
            across_face(leaf, direction, [&](std::size_t i) {
                if (!leaves[i].is_certain()) fresh.push(static_cast<std::uint32_t>(i));
            });
    }
}

std::size_t PhaseOctree::find(const Cell& cell) const {
    const auto after = std::upper_bound(leaves.begin(), leaves.end(), key_of(cell),
                                        [](std::uint64_t key, const OctreeLeaf& leaf) { return key < leaf.key; });
    return static_cast<std::size_t>(after - leaves.begin()) - 1;
}

PhaseOctree divided(const Phased& object, const TraceableObject& traceable, int levels, std::size_t max_boxes,
                    const std::function<bool()>& is_stopped) {
    PhaseOctree octree = OctreeDivision(object, traceable, levels, max_boxes, is_stopped).run();
    octree.narrow(is_stopped);
    return octree;
}

int levels_for(const TraceableObject& object, double side) {
    const double whole = longest_side(object) * (1 + cube_excess);
    const double finest = std::max(side, least_side_of_box * static_cast<double>(object.resolution));
    int levels = 1;
    while (levels < most_levels && std::ldexp(whole, -levels) > finest) ++levels;
    return levels;
}

}  // namespace phasetree::measuring
