#include "guiding/direction_tree.hpp"

#include <algorithm>
#include <cmath>

#include "phasetree/math/portable.hpp"
#include "sampling/warps.hpp"

namespace phasetree::tracer {

namespace {

constexpr float below_one = 0x1.fffffep-1f;

// A square is divided if it contains more than this share of all light, and at least this many lights, which are needed
// to locate the light within it. With 16 instead of 64, a room behind a door had 1.6 × the variance
// (benchmarks/experiments.md).
constexpr double divided_share = 0.01;
constexpr std::size_t divided_lights = 64;
// Each level takes bits from numbers of 24 bits.
constexpr int most_depth = 12;
// Smaller shares count as 0 because sample() divides by shares.
constexpr float least_share = 1e-6f;

}  // namespace

glm::vec2 sphere_to_square(const glm::vec3& direction) {
    const float turn = portable::atan2(direction.y, direction.x) / (2.0f * pi);
    return {std::clamp(turn < 0.0f ? turn + 1.0f : turn, 0.0f, below_one),
            std::clamp(0.5f * (1.0f + direction.z), 0.0f, below_one)};
}

glm::vec3 square_to_sphere(const glm::vec2& point) {
    const float z = 2.0f * point.y - 1.0f;
    const float across = std::sqrt(std::max(0.0f, 1.0f - z * z));
    const float phi = 2.0f * pi * point.x;
    return {across * std::cos(phi), across * std::sin(phi), z};
}

DirectionTree::DirectionTree(std::span<Light> lights) {
    double amount = 0;
    for (const Light& light : lights) amount += static_cast<double>(light.amount);
    divide(amount, lights, {0.0f, 0.0f}, 0);
}

// Makes the node of the square with side 2^−depth and the given low corner. Returns its index.
std::uint32_t DirectionTree::divide(double amount_of_all, std::span<Light> lights, glm::vec2 corner, int depth) {
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    const float half = std::ldexp(0.5f, -depth);
    const glm::vec2 middle = corner + half;
    const auto is_below = [&](const Light& light) { return light.on_square.y < middle.y; };
    const auto is_left = [&](const Light& light) { return light.on_square.x < middle.x; };
    const auto row = std::partition(lights.begin(), lights.end(), is_below);
    const std::array bounds{lights.begin(), std::partition(lights.begin(), row, is_left), row,
                            std::partition(row, lights.end(), is_left), lights.end()};
    std::array<double, 4> amount{};
    for (std::size_t q = 0; q < 4; ++q)
        for (auto light = bounds[q]; light != bounds[q + 1]; ++light) amount[q] += static_cast<double>(light->amount);
    const double sum = amount[0] + amount[1] + amount[2] + amount[3];
    for (std::size_t q = 0; q < 4; ++q) {
        const auto share = static_cast<float>(amount[q] / sum);
        nodes_[number].share[q] = share < least_share ? 0.0f : share;
        const std::span<Light> part(bounds[q], bounds[q + 1]);
        if (depth + 1 == most_depth || part.size() < divided_lights || !(amount[q] > divided_share * amount_of_all))
            continue;
        const glm::vec2 part_corner = corner + half * glm::vec2(static_cast<float>(q % 2), static_cast<float>(q / 2));
        const std::uint32_t child = divide(amount_of_all, part, part_corner, depth + 1);
        nodes_[number].child[q] = child;
    }
    return number;
}

DirectionTree::Sample DirectionTree::sample(glm::vec2 u) const {
    glm::vec2 corner(0.0f);
    float half = 0.5f, density = 1.0f / (4.0f * pi);
    // Chooses the low or the high half by their light, and rescales the rest of the number. A half without light is
    // never chosen: the quotient is exactly 0 or 1 then.
    const auto is_high = [](float& number, float in_low, float in_high) {
        const float low = in_low / (in_low + in_high);
        const bool high = number >= low;
        number = high ? (number - low) / (1.0f - low) : number / low;
        number = std::min(number, below_one);
        return high;
    };
    for (std::uint32_t number = 0;; half *= 0.5f) {
        const Node& node = nodes_[number];
        const bool right = is_high(u.x, node.share[0] + node.share[2], node.share[1] + node.share[3]);
        const bool high = is_high(u.y, node.share[right ? 1 : 0], node.share[right ? 3 : 2]);
        const std::size_t q = (right ? 1 : 0) + (high ? 2 : 0);
        corner += half * glm::vec2(right ? 1.0f : 0.0f, high ? 1.0f : 0.0f);
        density *= 4.0f * node.share[q];
        number = node.child[q];
        if (number == 0) return {square_to_sphere(corner + half * u), density};
    }
}

float DirectionTree::pdf(const glm::vec3& direction) const {
    glm::vec2 within = sphere_to_square(direction);
    float density = 1.0f / (4.0f * pi);
    for (std::uint32_t number = 0;;) {
        const Node& node = nodes_[number];
        within *= 2.0f;
        const bool right = within.x >= 1.0f, high = within.y >= 1.0f;
        within -= glm::vec2(right ? 1.0f : 0.0f, high ? 1.0f : 0.0f);
        const std::size_t q = (right ? 1 : 0) + (high ? 2 : 0);
        density *= 4.0f * node.share[q];
        number = node.child[q];
        if (number == 0) return density;
    }
}

}  // namespace phasetree::tracer
