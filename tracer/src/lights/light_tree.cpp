#include "lights/light_tree.hpp"

#include <cmath>
#include <numeric>

namespace phasetree::tracer {

namespace {

// Candidate splits of a cluster are between these slices of an axis.
constexpr std::size_t slice_count = 12;

// From this depth on, clusters are split in halves by number, which bounds the depth of the tree.
constexpr int deepest_costed_split = 40;

struct Box {
    glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

    void add(const Box& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    // The surface area plus a fraction of the squared diagonal, so that collinear points do not have area 0.
    double area_for_splitting() const {
        const glm::dvec3 size = high - low;
        return 2 * (size.x * size.y + size.y * size.z + size.z * size.x) + 0.01 * glm::dot(size, size);
    }
};

// Properties of several lamps, used while building the tree.
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
    double cost() const { return cone ? intensity * box.area_for_splitting() * cone->measure() : 0.0; }
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
    LightNode build(std::span<std::size_t> lamps, int depth) {
        if (lamps.size() == 1) return lamps_[lamps.front()].node;
        const std::size_t count = depth < deepest_costed_split ? split(lamps) : lamps.size() / 2;
        const Cluster cluster{bounds_of(lamps),
                              {build(lamps.first(count), depth + 1), build(lamps.subspan(count), depth + 1)}};
        tree_.clusters_.push_back(cluster);
        return {LightNode::Kind::cluster, static_cast<std::uint32_t>(tree_.clusters_.size() - 1)};
    }

    // Moves the lamps of the first part to the front and returns their number, which is neither 0 nor all.
    std::size_t split(std::span<std::size_t> lamps) const {
        Box centres;
        for (const std::size_t i : lamps) {
            const glm::dvec3 centre(lamps_[i].bounds.sphere.centre);
            centres.add({centre, centre});
        }
        const glm::dvec3 low = centres.low, size = centres.high - low;
        const auto slice_of = [this, low, size](std::size_t lamp, int axis) {
            const double x = static_cast<double>(lamps_[lamp].bounds.sphere.centre[axis]);
            const double share = (x - low[axis]) / size[axis];
            return std::min(static_cast<std::size_t>(share * static_cast<double>(slice_count)), slice_count - 1);
        };
        double least = std::numeric_limits<double>::infinity();
        int least_axis = 0;
        std::size_t least_slice = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(size[axis] > 0.0)) continue;
            std::array<Summary, slice_count> slices{};
            for (const std::size_t i : lamps) slices[slice_of(i, axis)].add(summary_of(lamps_[i].bounds));
            // Splitting a short edge creates thin parts, so it costs more.
            const double thinness = std::max({size.x, size.y, size.z}) / size[axis];
            std::array<double, slice_count> upper_cost{};
            Summary upper;
            for (std::size_t s = slice_count; s-- > 1;) {
                upper.add(slices[s]);
                upper_cost[s] = upper.cost();
            }
            Summary lower;
            for (std::size_t s = 1; s < slice_count; ++s) {
                lower.add(slices[s - 1]);
                if (lower.count == 0 || lower.count == lamps.size()) continue;
                const double cost = thinness * (lower.cost() + upper_cost[s]);
                if (!(cost < least)) continue;
                least = cost;
                least_axis = axis;
                least_slice = s;
            }
        }
        if (least_slice == 0) return lamps.size() / 2;  // all centres are equal, or no cost is finite
        const auto second = std::stable_partition(lamps.begin(), lamps.end(),
                                                  [&](std::size_t i) { return slice_of(i, least_axis) < least_slice; });
        return static_cast<std::size_t>(second - lamps.begin());
    }

    EmissionBounds bounds_of(std::span<const std::size_t> lamps) const {
        Summary all;
        for (const std::size_t i : lamps) all.add(summary_of(lamps_[i].bounds));
        EmissionBounds bounds;
        bounds.sphere.centre = glm::vec3((all.box.low + all.box.high) / 2.0);
        bounds.intensity = all.intensity;
        bounds.cone = *all.cone;
        double radius = 0;
        for (const std::size_t i : lamps) {
            const BoundingSphere& sphere = lamps_[i].bounds.sphere;
            radius = std::max(radius, glm::distance(glm::dvec3(sphere.centre), glm::dvec3(bounds.sphere.centre)) +
                                          static_cast<double>(sphere.radius));
        }
        // Rounded up, so that the sphere still contains the lamps in single precision.
        bounds.sphere.radius = static_cast<float>(radius * (1 + 1e-6));
        return bounds;
    }

    LightTree& tree_;
    std::span<const Lamp> lamps_;
    std::vector<std::size_t> order_;
};

void LightTree::roots_are_all_lamps() {
    roots_.clear();
    for (const auto kind : {LightNode::Kind::area, LightNode::Kind::point, LightNode::Kind::emissive_part})
        for (std::uint32_t i = 0; i < lamps_[static_cast<std::size_t>(kind)]; ++i) roots_.push_back({kind, i});
}

void LightTree::add(LightNode::Kind kind) {
    if (!parent_.empty()) {
        clusters_.clear();
        parent_.clear();
        roots_are_all_lamps();
    }
    const LightNode lamp{kind, lamps_[static_cast<std::size_t>(kind)]++};
    roots_.insert(std::ranges::lower_bound(roots_, lamp), lamp);
}

LightTree LightTree::of(std::span<const Lamp> lamps) {
    LightTree tree;
    if (lamps.empty()) return tree;
    for (const Lamp& lamp : lamps) ++tree.lamps_[static_cast<std::size_t>(lamp.node.kind)];
    tree.roots_ = {Builder(tree, lamps).build()};
    // Replace the strongest, widest clusters by their members until there are enough roots.
    const auto priority_of = [&](const LightNode& node) {
        if (node.kind != LightNode::Kind::cluster) return -1.0;
        const EmissionBounds& bounds = tree.clusters_[node.number].bounds;
        return bounds.intensity * static_cast<double>(bounds.sphere.radius) * static_cast<double>(bounds.sphere.radius);
    };
    while (tree.roots_.size() < most_roots) {
        const auto next = std::ranges::max_element(tree.roots_, {}, priority_of);
        if (next->kind != LightNode::Kind::cluster) break;
        const std::array<LightNode, 2> members = tree.clusters_[next->number].members;
        *next = members[0];
        tree.roots_.push_back(members[1]);
    }
    std::ranges::sort(tree.roots_);
    // Assign parents, from the roots down.
    tree.parent_.resize(lamps.size() + tree.clusters_.size());
    std::vector<LightNode> to_visit = tree.roots_;
    while (!to_visit.empty()) {
        const LightNode node = to_visit.back();
        to_visit.pop_back();
        if (node.kind != LightNode::Kind::cluster) continue;
        for (const LightNode& member : tree.members(node.number)) {
            tree.parent_[tree.index_of(member)] = node.number;
            to_visit.push_back(member);
        }
    }
    return tree;
}

bool LightTree::may_hit(const glm::vec3& origin, const glm::vec3& direction, float farthest,
                        std::uint32_t cluster) const {
    const BoundingSphere& sphere = clusters_[cluster].bounds.sphere;
    const glm::dvec3 to_centre = glm::dvec3(sphere.centre) - glm::dvec3(origin), d(direction);
    const double along = glm::dot(to_centre, d), radius = static_cast<double>(sphere.radius);
    const glm::dvec3 across = to_centre - along * d;
    // Lamps accept rays that miss slightly because directions are rounded, so the sphere is slightly enlarged.
    const double enlarged_radius = radius + 1e-6 * (std::abs(along) + radius);
    return along > -enlarged_radius && along - enlarged_radius < static_cast<double>(farthest) &&
           glm::dot(across, across) <= enlarged_radius * enlarged_radius;
}

}  // namespace phasetree::tracer
