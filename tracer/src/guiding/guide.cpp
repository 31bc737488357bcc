#include "guiding/guide.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

namespace phasetree::tracer {

namespace {

// A part of space with more findings than this is divided.
constexpr std::size_t findings_a_part = 2048;
// One with fewer than this knows nothing: a handful of findings is luck.
constexpr std::size_t fewest_findings = 64;
// A finding counts as so many times the mean of its part at most, where the mean is of what counts. Few paths find very
// much, by luck, and what they found tells less of where light comes from than of luck: without this a room behind a
// door had 1.2 × the variance.
constexpr double most_of_mean = 4;

}  // namespace

Facing facing_of(const glm::vec3& normal) {
    const glm::vec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return static_cast<Facing>(2 * axis + (normal[axis] < 0.0f ? 1 : 0));
}

struct Guide::Builder {
    using Numbers = std::span<std::uint32_t>;
    const std::vector<Finding>& findings;
    std::vector<Node>& nodes;
    std::vector<Numbers>& parts;  // the findings of each tree

    std::size_t divide(Numbers numbers) {
        const std::size_t node = nodes.size();
        nodes.emplace_back();
        glm::vec3 low = findings[numbers[0]].position, high = low;
        for (const std::uint32_t number : numbers) {
            low = glm::min(low, findings[number].position);
            high = glm::max(high, findings[number].position);
        }
        const glm::vec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        // In the middle: where findings are many they are divided again, and parts stay compact.
        const float at = low[axis] + 0.5f * size[axis];
        const auto is_low = [&](std::uint32_t number) { return findings[number].position[axis] < at; };
        if (numbers.size() <= findings_a_part || !(low[axis] < at && at < high[axis])) {
            if (numbers.size() < fewest_findings) return node;
            nodes[node].tree = parts.size();
            parts.push_back(numbers);
            return node;
        }
        const auto middle = std::partition(numbers.begin(), numbers.end(), is_low);
        const std::size_t low_half = divide({numbers.begin(), middle}), high_half = divide({middle, numbers.end()});
        nodes[node] = {axis, at, low_half, high_half, std::nullopt};
        return node;
    }
};

namespace {

float most_that_counts(const std::vector<Finding>& findings, std::span<const std::uint32_t> part) {
    float most = std::numeric_limits<float>::max();
    for (int round = 0; round < 16; ++round) {
        double light = 0;
        for (const std::uint32_t number : part) light += static_cast<double>(std::min(findings[number].light, most));
        const float before = most;
        most = static_cast<float>(most_of_mean * light / static_cast<double>(part.size()));
        if (most > 0.9f * before) break;
    }
    return most;
}

}  // namespace

Guide::Guide(const std::vector<Finding>& findings) {
    std::array<std::vector<std::uint32_t>, facings> numbers;
    for (std::size_t i = 0; i < findings.size(); ++i)
        numbers[findings[i].facing].push_back(static_cast<std::uint32_t>(i));
    std::vector<Builder::Numbers> parts;
    for (std::size_t facing = 0; facing < facings; ++facing)
        if (!numbers[facing].empty()) Builder{findings, parts_[facing], parts}.divide(numbers[facing]);
    std::vector<std::optional<DirectionTree>> trees(parts.size());
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
        std::vector<DirectionTree::Arrival> arrivals;
        arrivals.reserve(parts[i].size());
        const float most = most_that_counts(findings, parts[i]);
        for (const std::uint32_t number : parts[i])
            arrivals.push_back({sphere_to_square(findings[number].direction), std::min(findings[number].light, most)});
        trees[i].emplace(arrivals);
    });
    for (std::optional<DirectionTree>& tree : trees) trees_.push_back(std::move(*tree));
}

const DirectionTree* Guide::at(const glm::vec3& position, Facing facing) const {
    const std::vector<Node>& nodes = parts_[facing];
    if (nodes.empty()) return nullptr;
    const Node* node = nodes.data();
    while (node->axis != undivided) node = &nodes[position[node->axis] < node->at ? node->low : node->high];
    return node->tree ? &trees_[*node->tree] : nullptr;
}

}  // namespace phasetree::tracer
