#include "lights/light_tree.hpp"

#include <cmath>
#include <limits>
#include <numeric>

namespace phasetree::tracer {

namespace {

// Lamps are sorted into so many slices along an axis, and divided between two of them.
constexpr std::size_t slices = 12;

// From this depth on groups are halved, so that a way down is never long however lamps are placed.
constexpr int deepest_split = 40;

struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

    void add(const Box& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    // The surface, and a little of the squared diagonal, so that rows of points have some, too.
    double area() const {
        const glm::dvec3 size = high - low;
        return 2 * (size.x * size.y + size.y * size.z + size.z * size.x) + 0.01 * glm::dot(size, size);
    }
};

// What is known of several lamps while the tree is built.
struct Summary {
    Box box{};
    double intensity = 0;
    std::optional<EmissionCone> cone{};
    std::size_t count = 0;

    void add(const Summary& other) {
        box.add(other.box);
        intensity += other.intensity;
        if (other.cone) cone = cone ? merged(*cone, *other.cone) : other.cone;
        count += other.count;
    }
};

Summary summary_of(const EmissionBounds& lamp) {
    const glm::dvec3 centre(lamp.sphere.centre), radius(static_cast<double>(lamp.sphere.radius));
    return {{centre - radius, centre + radius}, lamp.intensity, lamp.cone, 1};
}

}  // namespace

class LightTree::Builder {
  public:
    Builder(LightTree& tree, std::span<const Lamp> lamps) : tree_(tree), lamps_(lamps), order_(lamps.size()) {
        std::iota(order_.begin(), order_.end(), std::size_t(0));
    }

    LightNode build() { return build(order_, 0); }

  private:
    LightNode build(std::span<std::size_t> part, int depth) {
        if (part.size() == 1) return lamps_[part.front()].node;
        const std::size_t count = depth < deepest_split ? split(part) : part.size() / 2;
        const Group group{bounds_of(part),
                          {build(part.first(count), depth + 1), build(part.subspan(count), depth + 1)}};
        tree_.groups_.push_back(group);
        return {LightNode::Kind::group, static_cast<std::uint32_t>(tree_.groups_.size() - 1)};
    }

    // Puts those of the first group first, and returns how many they are: neither none nor all.
    std::size_t split(std::span<std::size_t> part) const {
        glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
        for (const std::size_t i : part) {
            const glm::dvec3 centre(lamps_[i].bounds.sphere.centre);
            low = glm::min(low, centre);
            high = glm::max(high, centre);
        }
        double least = std::numeric_limits<double>::infinity();
        int least_axis = 0;
        std::size_t least_slice = 0;
        const auto slice_of = [&](std::size_t lamp, int axis) {
            const double x = static_cast<double>(lamps_[lamp].bounds.sphere.centre[axis]);
            const double share = (x - low[axis]) / (high[axis] - low[axis]);
            return std::min(static_cast<std::size_t>(share * static_cast<double>(slices)), slices - 1);
        };
        for (int axis = 0; axis < 3; ++axis) {
            if (!(high[axis] > low[axis])) continue;
            std::array<Summary, slices> slice{};
            for (const std::size_t i : part) slice[slice_of(i, axis)].add(summary_of(lamps_[i].bounds));
            // Thin groups are dearer than their area says: the longest edge over this one.
            const glm::dvec3 size = high - low;
            const double thinness = std::max({size.x, size.y, size.z}) / size[axis];
            std::array<double, slices> cost_above{};
            Summary above;
            for (std::size_t s = slices; s-- > 1;) {
                above.add(slice[s]);
                cost_above[s] = cost(above);
            }
            Summary below;
            for (std::size_t s = 1; s < slices; ++s) {
                below.add(slice[s - 1]);
                if (below.count == 0 || below.count == part.size()) continue;
                const double total = thinness * (cost(below) + cost_above[s]);
                if (!(total < least)) continue;
                least = total;
                least_axis = axis;
                least_slice = s;
            }
        }
        if (least_slice == 0) return part.size() / 2;  // all at one place, or costs are beyond numbers
        const auto second = std::stable_partition(part.begin(), part.end(),
                                                  [&](std::size_t i) { return slice_of(i, least_axis) < least_slice; });
        return static_cast<std::size_t>(second - part.begin());
    }

    static double cost(const Summary& lamps) {
        if (!lamps.cone) return 0;
        return lamps.intensity * lamps.box.area() * lamps.cone->measure();
    }

    EmissionBounds bounds_of(std::span<const std::size_t> part) const {
        Summary all;
        for (const std::size_t i : part) all.add(summary_of(lamps_[i].bounds));
        EmissionBounds bounds;
        bounds.sphere.centre = glm::vec3((all.box.low + all.box.high) / 2.0);
        bounds.intensity = all.intensity;
        bounds.cone = *all.cone;
        double radius = 0;
        for (const std::size_t i : part) {
            const BoundingSphere& sphere = lamps_[i].bounds.sphere;
            radius = std::max(radius, glm::distance(glm::dvec3(sphere.centre), glm::dvec3(bounds.sphere.centre)) +
                                          static_cast<double>(sphere.radius));
        }
        // Rounded up, so that the sphere stays around the lamps in single precision as well.
        bounds.sphere.radius = static_cast<float>(radius * (1 + 1e-6));
        return bounds;
    }

    LightTree& tree_;
    std::span<const Lamp> lamps_;
    std::vector<std::size_t> order_;
};

void LightTree::add(LightNode::Kind kind) {
    const auto add_top = [&](LightNode::Kind k, std::uint32_t number) {
        const auto end = k == LightNode::Kind::area ? tops_.begin() + number : tops_.end();
        tops_.insert(end, {k, number});
    };
    if (!groups_.empty()) {
        const std::array<std::uint32_t, 2> lamps = lamps_;
        *this = {};
        lamps_ = lamps;
        for (const auto each : {LightNode::Kind::area, LightNode::Kind::point})
            for (std::uint32_t i = 0; i < lamps_[static_cast<std::size_t>(each)]; ++i) add_top(each, i);
    }
    add_top(kind, lamps_[static_cast<std::size_t>(kind)]++);
}

LightTree LightTree::grouped(std::span<const Lamp> lamps) {
    LightTree tree;
    tree.tops_ = {Builder(tree, lamps).build()};
    // The greatest groups are opened.
    const auto extent_of = [&](const LightNode& node) {
        if (node.kind != LightNode::Kind::group) return -1.0;
        const EmissionBounds& bounds = tree.groups_[node.number].bounds;
        return bounds.intensity * static_cast<double>(bounds.sphere.radius) * static_cast<double>(bounds.sphere.radius);
    };
    while (tree.tops_.size() < most_compared) {
        const auto widest = std::ranges::max_element(tree.tops_, {}, extent_of);
        if (widest->kind != LightNode::Kind::group) break;
        const std::array<LightNode, 2> members = tree.groups_[widest->number].members;
        *widest = members[0];
        tree.tops_.insert(widest + 1, members[1]);
    }
    // Who is below whom, from the tops down.
    for (const auto kind : {LightNode::Kind::area, LightNode::Kind::point}) {
        const auto index = static_cast<std::size_t>(kind);
        const auto count = std::ranges::count(lamps, kind, [](const Lamp& lamp) { return lamp.node.kind; });
        tree.lamps_[index] = static_cast<std::uint32_t>(count);
        tree.above_[index].resize(static_cast<std::size_t>(count));
    }
    std::vector<LightNode> open = tree.tops_;
    while (!open.empty()) {
        const LightNode node = open.back();
        open.pop_back();
        if (node.kind != LightNode::Kind::group) continue;
        for (const LightNode& member : tree.groups_[node.number].members) {
            (member.kind == LightNode::Kind::group
                 ? tree.groups_[member.number].above
                 : tree.above_[static_cast<std::size_t>(member.kind)][member.number]) = node.number;
            open.push_back(member);
        }
    }
    return tree;
}

bool LightTree::may_meet(const glm::vec3& origin, const glm::vec3& direction, std::uint32_t group) const {
    const BoundingSphere& sphere = groups_[group].bounds.sphere;
    const glm::dvec3 to_centre = glm::dvec3(sphere.centre) - glm::dvec3(origin), d(direction);
    const double along = glm::dot(to_centre, d), radius = static_cast<double>(sphere.radius);
    const glm::dvec3 across = to_centre - along * d;
    // A direction in single precision may be off, and lamps are met by rays that pass them as closely as that.
    const double farther = radius + 1e-6 * (std::abs(along) + radius);
    return along > -farther && glm::dot(across, across) <= farther * farther;
}

}  // namespace phasetree::tracer
