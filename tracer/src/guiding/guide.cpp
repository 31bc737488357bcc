#include "guiding/guide.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "phasetree/math/float_mode.hpp"

namespace phasetree::tracer {

namespace {

// A region with more samples than this is divided.
constexpr std::size_t findings_a_region = 2048;
// A region with fewer samples than this has no pdf, because so few are due to chance.
constexpr std::size_t fewest_findings = 64;
// A sample is clamped to this many times the mean of its region, where the mean is taken after clamping. Otherwise the
// few paths that happen to find very much light would attract all others: without clamping, a room behind a door had
// 1.2 × the variance.
constexpr double clamp_over_mean = 4;

// 0, 1 or 2.
int longest_axis(const glm::vec3& size) {
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

}  // namespace

Facing facing_of(const glm::vec3& normal) {
    const int axis = longest_axis(glm::abs(normal));
    return static_cast<Facing>(2 * axis + (normal[axis] < 0.0f ? 1 : 0));
}

struct Guide::Builder {
    using Numbers = std::span<std::uint32_t>;
    const std::vector<GuideSample>& samples;
    std::vector<Node>& nodes;
    std::vector<Numbers>& samples_of_trees;

    // Makes the node of the region with the samples of these indices. Returns its index.
    std::size_t divide(Numbers numbers) {
        const std::size_t node = nodes.size();
        nodes.emplace_back();
        glm::vec3 low = samples[numbers[0]].point, high = low;
        for (const std::uint32_t number : numbers) {
            low = glm::min(low, samples[number].point);
            high = glm::max(high, samples[number].point);
        }
        const int axis = longest_axis(high - low);
        // Regions are divided in the middle, so they stay compact; those with many samples are divided again.
        const float at = low[axis] + 0.5f * (high[axis] - low[axis]);
        if (numbers.size() <= findings_a_region || !(low[axis] < at && at < high[axis])) {
            if (numbers.size() < fewest_findings) return node;
            nodes[node].tree = samples_of_trees.size();
            samples_of_trees.push_back(numbers);
            return node;
        }
        const auto is_low = [&](std::uint32_t number) { return samples[number].point[axis] < at; };
        const auto middle = std::partition(numbers.begin(), numbers.end(), is_low);
        const std::size_t low_half = divide({numbers.begin(), middle}), high_half = divide({middle, numbers.end()});
        nodes[node] = {axis, at, low_half, high_half, std::nullopt};
        return node;
    }
};

namespace {

// Clamping lowers the mean from which the limit is derived, so this is iterated until it converges.
float clamp_of(const std::vector<GuideSample>& samples, std::span<const std::uint32_t> region) {
    float clamp = std::numeric_limits<float>::max();
    for (int round = 0; round < 16; ++round) {
        double light = 0;
        for (const std::uint32_t number : region) light += static_cast<double>(std::min(samples[number].light, clamp));
        const float before = clamp;
        clamp = static_cast<float>(clamp_over_mean * light / static_cast<double>(region.size()));
        if (clamp > 0.9f * before) break;
    }
    return clamp;
}

}  // namespace

Guide::Guide(const std::vector<GuideSample>& samples) {
    const FlushSubnormals flush;
    std::array<std::vector<std::uint32_t>, facings> numbers;
    for (std::size_t i = 0; i < samples.size(); ++i)
        numbers[samples[i].facing].push_back(static_cast<std::uint32_t>(i));
    std::vector<Builder::Numbers> samples_of_trees;
    for (std::size_t facing = 0; facing < facings; ++facing)
        if (!numbers[facing].empty()) Builder{samples, nodes_[facing], samples_of_trees}.divide(numbers[facing]);
    std::vector<std::optional<DirectionTree>> trees(samples_of_trees.size());
    tbb::parallel_for(std::size_t{0}, trees.size(), [&](std::size_t i) {
        const FlushSubnormals flush_here;
        std::vector<DirectionTree::Light> lights;
        lights.reserve(samples_of_trees[i].size());
        const float clamp = clamp_of(samples, samples_of_trees[i]);
        for (const std::uint32_t number : samples_of_trees[i])
            lights.push_back({sphere_to_square(samples[number].direction), std::min(samples[number].light, clamp)});
        trees[i].emplace(lights);
    });
    for (std::optional<DirectionTree>& tree : trees) trees_.push_back(std::move(*tree));
}

const DirectionTree* Guide::at(const glm::vec3& point, Facing facing) const {
    const std::vector<Node>& nodes = nodes_[facing];
    if (nodes.empty()) return nullptr;
    const Node* node = nodes.data();
    while (node->axis != undivided) node = &nodes[point[node->axis] < node->at ? node->low : node->high];
    return node->tree ? &trees_[*node->tree] : nullptr;
}

}  // namespace phasetree::tracer
