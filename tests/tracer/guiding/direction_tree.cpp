// The densities of directions of which guides consist.
#include "guiding/direction_tree.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "guiding/guide.hpp"
#include "phasetree/math/float_mode.hpp"
#include "sampling/warps.hpp"
#include "support/statistics.hpp"
#include "support/uniform.hpp"

namespace test_direction_tree {

using namespace phasetree::tests;
using namespace phasetree::tracer;

namespace {

// Light from two sides, one of them narrow, and a little from everywhere.
std::vector<DirectionTree::Light> lights(int count, std::uint32_t seed) {
    Uniform random(seed);
    std::vector<DirectionTree::Light> result;
    for (int i = 0; i < count; ++i) {
        const glm::vec2 u = random.two();
        const float kind = random();
        const glm::vec2 at = kind < 0.2f   ? u
                             : kind < 0.6f ? glm::vec2(0.3f, 0.7f) + 0.03f * u
                                           : glm::vec2(0.6f, 0.1f) + 0.3f * u;
        result.push_back({at, 0.5f + random()});
    }
    return result;
}

constexpr int side = 512;  // of a grid finer than the trees of this file, so their density is exact on it

glm::vec2 middle_of(int x, int y) {
    return (glm::vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5f) / static_cast<float>(side);
}

}  // namespace

TEST_CASE("the map of the sphere to the square is the same in both directions, and keeps areas") {
    Uniform random(1);
    for (int i = 0; i < 10000; ++i) {
        const glm::vec3 direction = square_to_uniform_sphere(random.two());
        const glm::vec2 point = sphere_to_square(direction);
        REQUIRE(std::min(point.x, point.y) >= 0.0f);
        REQUIRE(std::max(point.x, point.y) < 1.0f);
        REQUIRE(glm::length(square_to_sphere(point) - direction) < 2e-3f);
        // A small square's area on the sphere is 4π times its area in the plane.
        const float step = 1e-2f;
        if (std::abs(direction.z) > 0.9f || point.x > 1 - step || point.y > 1 - step) continue;
        const glm::vec3 a = square_to_sphere(point + glm::vec2(step, 0)) - square_to_sphere(point);
        const glm::vec3 b = square_to_sphere(point + glm::vec2(0, step)) - square_to_sphere(point);
        REQUIRE(glm::length(glm::cross(a, b)) == doctest::Approx(4.0f * pi * step * step).epsilon(0.05));
    }
    for (const glm::vec3& axis :
         {glm::vec3(0, 0, 1), glm::vec3(0, 0, -1), glm::vec3(-1, 0, 0), glm::vec3(-1, -0.0f, 0)})
        CHECK(glm::length(square_to_sphere(sphere_to_square(axis)) - axis) < 2e-3f);
}

TEST_CASE("directions are sampled with the density that the tree tells") {
    std::vector<DirectionTree::Light> light = lights(4000, 2);
    const DirectionTree tree(light);
    constexpr int cells = 16;
    std::vector<double> expected(cells * cells), observed(cells * cells), defective(cells * cells);
    double sum = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double share =
                static_cast<double>(tree.pdf(square_to_sphere(middle_of(x, y)))) * 4 * std::numbers::pi / (side * side);
            sum += share;
            expected[static_cast<std::size_t>(y / (side / cells) * cells + x / (side / cells))] += share;
        }
    CHECK(sum == doctest::Approx(1.0).epsilon(1e-4));
    const auto count = static_cast<int>(samples_to_detect(1e-4, cells * cells));
    for (double& e : expected) e *= count / sum;
    Uniform random(3);
    const auto cell_of = [&](const glm::vec2& u) {
        const glm::vec2 at = sphere_to_square(tree.sample(u).direction) * static_cast<float>(cells);
        return static_cast<std::size_t>(static_cast<int>(at.y) * cells + static_cast<int>(at.x));
    };
    for (int i = 0; i < count; ++i) {
        const glm::vec2 u = random.two();
        ++observed[cell_of(u)];
        ++defective[cell_of({std::min(std::pow(u.x, 1.02f), 0x1.fffffep-1f), u.y})];
    }
    CHECK(chi_squared_test(observed, expected).p_value > sidak(1e-4, 2));
    CHECK(chi_squared_test(defective, expected).p_value < sidak(1e-4, 2));
}

TEST_CASE("at all corners of the square there is a direction, with the density that it has") {
    const phasetree::FlushSubnormals flush;
    Uniform random(9);
    const float corners[] = {0.0f, 0x1p-24f, 0.5f, 1 - 0x1p-24f};
    for (int round = 0; round < 2000; ++round) {
        // Whole columns, rows and squares without light, and light of all intensities, down to negligible ones.
        std::vector<DirectionTree::Light> light;
        const float strength = 30 * random(), wide = random() * random();
        const glm::vec2 corner = random.two();
        for (int i = 0; i < 300; ++i)
            light.push_back(
                {glm::min(corner + wide * random.two(), 1 - 0x1p-24f), std::exp(strength * (random() - 1))});
        light.push_back({random.two(), std::exp(-85 * random())});
        const DirectionTree tree(light);
        for (const float x : corners)
            for (const float y : corners) {
                const DirectionTree::Sample sample = tree.sample({x, y});
                REQUIRE(std::abs(glm::length(sample.direction) - 1) < 1e-3f);
                REQUIRE(sample.pdf > 0.0f);
                REQUIRE(std::isfinite(sample.pdf));
            }
        const DirectionTree::Sample sample = tree.sample(random.two());
        const float asked = tree.pdf(sample.direction);
        // A direction at the edge of its square may be rounded into the next.
        if (asked != doctest::Approx(sample.pdf).epsilon(1e-5)) {
            const glm::vec2 at = sphere_to_square(sample.direction) * 4096.0f;
            REQUIRE(std::min({at.x - std::floor(at.x), std::ceil(at.x) - at.x, at.y - std::floor(at.y),
                              std::ceil(at.y) - at.y}) < 0.02f);
        }
    }
}

TEST_CASE("the density is what of the light comes from a square") {
    std::vector<DirectionTree::Light> light = lights(20000, 4);
    double narrow = 0, all = 0;
    const auto is_narrow = [](const glm::vec2& p) {  // a square of the tree: the eighth from 0.25 and from 0.625 on
        return p.x >= 0.25f && p.x < 0.375f && p.y >= 0.625f && p.y < 0.75f;
    };
    for (const auto& one : light) {
        all += static_cast<double>(one.amount);
        if (is_narrow(one.on_square)) narrow += static_cast<double>(one.amount);
    }
    const DirectionTree tree(light);
    Uniform random(5);
    int found = 0;
    constexpr int count = 100'000;
    for (int i = 0; i < count; ++i) found += is_narrow(sphere_to_square(tree.sample(random.two()).direction));
    CHECK(static_cast<double>(found) / count == doctest::Approx(narrow / all).epsilon(0.02));
    // Where 40 % of the light comes from a thousandth of the sphere, the density is hundreds of times the mean.
    CHECK(tree.pdf(square_to_sphere({0.315f, 0.715f})) * 4.0f * pi > 100.0f);
    // A few arrivals show only roughly where they come from, however bright they are.
    std::vector<DirectionTree::Light> few(10, {{0.3f, 0.3f}, 1e6f});
    CHECK(DirectionTree(few).pdf(square_to_sphere({0.3f, 0.3f})) * 4.0f * pi == doctest::Approx(4.0f));
}

TEST_CASE("a guide tells places and sides apart, and knows nothing where nothing was found") {
    Uniform random(6);
    std::vector<GuideSample> samples;
    // On a floor, light comes from +x where x > 0 and from −x where x < 0; below a ceiling it comes from −y.
    for (int i = 0; i < 20000; ++i) {
        const glm::vec3 at(random() - 0.5f, random() - 0.5f, 0.0f);
        samples.push_back({at, facing_of({0, 0, 1}), glm::normalize(glm::vec3(at.x > 0 ? 1 : -1, 0.1f, 0.3f)), 1.0f});
        samples.push_back({at, facing_of({0.1f, 0.1f, -1}), glm::normalize(glm::vec3(0.1f, -1, -0.3f)), 1.0f});
    }
    const Guide guide(samples);
    const auto at = [&](const glm::vec3& position, const glm::vec3& normal, const glm::vec3& direction) {
        const DirectionTree* tree = guide.at(position, facing_of(normal));
        REQUIRE(tree != nullptr);
        return tree->pdf(glm::normalize(direction));
    };
    CHECK(at({0.25f, 0.2f, 0}, {0, 0, 1}, {1, 0.1f, 0.3f}) > 10.0f);
    CHECK(at({0.25f, 0.2f, 0}, {0, 0, 1}, {-1, 0.1f, 0.3f}) == 0.0f);
    CHECK(at({-0.25f, 0.2f, 0}, {0, 0, 1}, {-1, 0.1f, 0.3f}) > 10.0f);
    CHECK(at({0.25f, 0.2f, 0}, {0, 0, -1}, {0.1f, -1, -0.3f}) > 10.0f);
    CHECK(guide.at({0, 0, 0}, facing_of({1, 0, 0})) == nullptr);
    CHECK(Guide().at({0, 0, 0}, facing_of({0, 0, 1})) == nullptr);
    // Outside the region with samples, the nearest part is used.
    CHECK(at({100, 100, 100}, {0, 0, 1}, {1, 0.1f, 0.3f}) > 10.0f);
}

TEST_CASE("a handful of samples tells nothing, and one that is very bright little") {
    std::vector<GuideSample> samples(60, {{0, 0, 0}, 0, {0, 0, 1}, 1.0f});
    CHECK(Guide(samples).at({0, 0, 0}, 0) == nullptr);
    samples.resize(1000, samples[0]);
    samples.push_back({{0, 0, 0}, 0, {0, 1, 0}, 1e29f});
    const Guide guide(samples);
    const DirectionTree* tree = guide.at({0, 0, 0}, 0);
    REQUIRE(tree != nullptr);
    CHECK(tree->pdf({0, 1, 0}) < tree->pdf({0, 0, 1}));
    // Infinite coordinates are divided in bounded time.
    for (int i = 0; i < 5000; ++i) samples.push_back({{1e30f * static_cast<float>(i % 7), 0, 0}, 0, {0, 0, 1}, 1.0f});
    CHECK(Guide(samples).at({0, 0, 0}, 0) != nullptr);
}

TEST_CASE("samples all at one place, and of one direction, are no reason to divide forever") {
    std::vector<GuideSample> samples(50000, {{1, 2, 3}, 0, {0, 0, 1}, 1.0f});
    const Guide guide(samples);
    REQUIRE(guide.at({1, 2, 3}, 0) != nullptr);
    CHECK(std::isfinite(guide.at({1, 2, 3}, 0)->pdf({0, 0, 1})));
    CHECK(glm::length(guide.at({1, 2, 3}, 0)->sample({0.5f, 0.5f}).direction - glm::vec3(0, 0, 1)) < 0.05f);
}

}  // namespace test_direction_tree
