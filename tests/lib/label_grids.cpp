// Segmented scans: labels at the centres of voxels, and between them.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/phased/labels.hpp"
#include "support/random_voxels.hpp"

namespace test_label_grids {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

template <class F>
LabelGrid labelled(const std::array<int, 3>& size, int numbers, F&& number) {
    LabelGrid grid;
    grid.lattice.size = size;
    for (int i = 0; i < numbers; ++i) grid.numbers.push_back(i);
    for (int z = 0; z < size[2]; ++z)
        for (int y = 0; y < size[1]; ++y)
            for (int x = 0; x < size[0]; ++x)
                grid.voxels.push_back(static_cast<std::uint8_t>(number(glm::ivec3(x, y, z))));
    return grid;
}

std::vector<Phase> phases_up_to(int count) {
    std::vector<Phase> phases;
    for (int i = 1; i <= count; ++i) phases.push_back(Phase{static_cast<std::uint8_t>(i)});
    return phases;
}

Labels node_of(LabelGrid grid, float smoothing = 1, const glm::vec3& spacing = glm::vec3(0.1f)) {
    const auto count = static_cast<int>(grid.numbers.size()) - 1;
    return {.file = held_content(std::move(grid)),
            .of_phases = phases_up_to(count),
            .values = {},
            .empty = {},
            .spacing = spacing,
            .smoothing = smoothing,
            .grid = {}};
}

// The number of voxels whose centre is in another phase, or in two phases.
std::size_t wrong_centres(const LabelGrid& grid, const Phased& object, const glm::dvec3& spacing) {
    std::size_t wrong = 0, at = 0;
    const auto [nx, ny, nz] = grid.lattice.size;
    for (int z = 0; z < nz; ++z)
        for (int y = 0; y < ny; ++y)
            for (int x = 0; x < nx; ++x, ++at) {
                const glm::dvec3 p = spacing * (glm::dvec3(x, y, z) - 0.5 * glm::dvec3(nx - 1, ny - 1, nz - 1));
                const Phases<float> phi = distances(object, glm::vec3(p));
                int negative = 0;
                for_each_phase(phi.present, [&](int i) { negative += phi[i] < 0; });
                wrong += negative != 1 || label(phi).index != grid.numbers[grid.voxels[at]];
            }
    return wrong;
}

std::string said_of(Labels node) {
    try {
        const Phased object = std::move(node);
        (void)object;
    } catch (const ModelError& e) {
        return e.what();
    }
    return "an object";
}

}  // namespace

TEST_CASE("the centre of every voxel is of the phase of its number, whatever is around it") {
    Random rng(611);
    std::size_t voxels = 0;
    for (int n = 0; n < 60; ++n) {
        const int numbers = 2 + n % 5, kind = n / 5 % 4;
        const std::array<int, 3> size{3 + rng.below(20), 1 + rng.below(20), 1 + rng.below(12)};
        const LabelGrid grid = labelled(size, numbers, [&](const glm::ivec3& p) {
            if (kind == 0) return rng.below(numbers);                         // noise
            if (kind == 1) return rng.chance(0.03) ? rng.below(numbers) : 0;  // single voxels
            if (kind == 2) return p.x % 5 == 2 ? 1 : 0;                       // sheets of one voxel
            return (p.x / 3 + p.y / 4 + p.z / 2) % numbers;                   // steps
        });
        const glm::vec3 spacing(0.1f, 0.1f + 0.05f * static_cast<float>(n % 3), 0.1f);
        const float smoothing = std::array{1.f, 0.f, 2.f, 0.5f}[static_cast<std::size_t>(n) % 4];
        CAPTURE(n);
        CAPTURE(smoothing);
        REQUIRE(wrong_centres(grid, node_of(grid, smoothing, spacing), glm::dvec3(spacing)) == 0);
        voxels += grid.voxels.size();
    }
    MESSAGE(voxels, " voxels");
}

TEST_CASE("at any point one component is negative at most, and all are 1-Lipschitz") {
    Random rng(612);
    for (int n = 0; n < 10; ++n) {
        const int numbers = 2 + n % 4;
        const LabelGrid grid = labelled({12, 12, 12}, numbers, [&](const glm::ivec3& p) {
            return n % 2 == 0 ? rng.below(numbers) : (p.x + 2 * p.y + p.z) / 7 % numbers;
        });
        const Phased object = node_of(grid);
        float steepest = 0;
        for (int k = 0; k < 5000; ++k) {
            const glm::vec3 p = 0.8f * rng.uniform(0, 1) * rng.direction();
            const float step = rng.uniform(0.001f, 0.05f);
            const Phases<float> a = distances(object, p), b = distances(object, p + step * rng.direction());
            int negative = 0;
            for_each_phase(a.present, [&](int i) {
                negative += a[i] < 0;
                steepest = std::max(steepest, std::abs(a[i] - b[i]) / step);
            });
            REQUIRE(negative <= 1);
        }
        REQUIRE(steepest < 1.001f);
    }
}

TEST_CASE("the surface of a ball of voxels is smooth and is the ball's") {
    constexpr double radius = 9.3;
    constexpr int n = 27;
    const glm::dvec3 middle(13.2, 12.9, 13.1);
    const LabelGrid grid = labelled(
        {n, n, n}, 2, [&](const glm::ivec3& p) { return glm::length(glm::dvec3(p) - middle) < radius ? 1 : 0; });
    const auto roughness = [&](float smoothing) {
        const Phased object = node_of(grid, smoothing, glm::vec3(1));
        Random rng(613);
        double sum = 0, squares = 0;
        for (int k = 0; k < 2000; ++k) {
            const glm::dvec3 d(rng.direction());
            // The place along a radius where the label changes, and its distance from the ball.
            double low = radius - 2, high = radius + 2;
            for (int i = 0; i < 30; ++i) {
                const double r = 0.5 * (low + high);
                const glm::dvec3 p = middle + r * d - glm::dvec3(0.5 * (n - 1));
                (label(distances(object, glm::vec3(p))) == vacuum ? high : low) = r;
            }
            sum += low - radius;
            squares += (low - radius) * (low - radius);
        }
        const double mean = sum / 2000;
        return std::pair(mean, std::sqrt(squares / 2000 - mean * mean));
    };
    const auto [smooth_mean, smooth] = roughness(1);
    const auto [rough_mean, rough] = roughness(0);
    MESSAGE("in voxels, mean and deviation: ", smooth_mean, " and ", smooth, "; without smoothing ", rough_mean,
            " and ", rough);
    // A blur moves a curved interface inward: that of a ball of radius R by σ²/R.
    CHECK(smooth_mean == doctest::Approx(-1 / radius).epsilon(0.2));
    CHECK(smooth < 0.09);
    CHECK(rough > 2 * smooth);
}

TEST_CASE("the distance to a flat interface is told for two voxels, and does not grow beyond") {
    const LabelGrid grid = labelled({21, 21, 21}, 2, [](const glm::ivec3& p) { return p.x < 10 ? 1 : 0; });
    const Phased object = node_of(grid, 1, glm::vec3(1));
    // The interface lies half way between the centres of the voxels 9 and 10, at −0.5.
    for (const float t : {-2.f, -1.3f, -0.5f, -0.1f, 0.2f, 0.9f, 1.7f})
        CHECK(distances(object, {-0.5f + t, 0.3f, 0.1f})[1] == doctest::Approx(t).epsilon(0.12).scale(1));
    CHECK(distances(object, {-8, 0, 0})[1] < -2);
    CHECK(distances(object, {8, 0, 0})[1] > 2);
}

TEST_CASE("a wall and a thread of one voxel are whole, and not much thinner") {
    const LabelGrid grid = labelled({15, 15, 15}, 3, [](const glm::ivec3& p) {
        return p.x == 4 ? 1 : p.y == 7 && p.x == 10 ? 2 : 0;
    });
    const Phased object = node_of(grid, 1, glm::vec3(1));
    const auto thickness = [&](const glm::vec3& from, const glm::vec3& to) {
        int there = 0;
        for (int i = 0; i < 1000; ++i)
            there += label(distances(object, glm::mix(from, to, static_cast<float>(i) / 1000))) != vacuum;
        return static_cast<float>(there) / 1000 * glm::length(to - from);
    };
    for (int i = 0; i < 20; ++i) {
        const float along = -6.f + 0.6f * static_cast<float>(i);
        const float wall = thickness({-5, along, 0.3f * along}, {-1, along, 0.3f * along});
        CHECK(wall > 0.4f);
        CHECK(wall < 1);
        const float thread = thickness({1, 0, along}, {5, 0, along});
        CHECK(thread > 0.3f);
        CHECK(thread < 1);
    }
}

TEST_CASE("numbers are given to phases and to the vacuum") {
    LabelGrid grid = labelled({4, 1, 1}, 4, [](const glm::ivec3& p) { return p.x; });
    grid.numbers = {0, 40, -7, 65535};
    Labels node = node_of(grid);
    node.of_phases = {Phase{3}, Phase{1}, Phase{3}};
    node.values = {40, 65535, -7};
    const Phased object = node;
    const auto at = [&](float x) { return label(distances(object, {x, 0, 0})).index; };
    CHECK(at(-0.15f) == 0);
    CHECK(at(-0.05f) == 3);
    CHECK(at(0.05f) == 3);
    CHECK(at(0.15f) == 1);
    node.values = {40, 65535, 0};
    CHECK(said_of(node) ==
          "labels: the voxel (2, 0, 0), counted from 0, has the number -7, which belongs to no phase; add it to "
          "\"values\", or to \"empty\" for the vacuum");
    node.empty = {-7};
    CHECK(said_of(node) == "an object");
    node.values = {40, 65535, -7};
    CHECK(said_of(node).find("the voxel (0, 0, 0), counted from 0, has the number 0") != std::string::npos);
}

TEST_CASE("what is no object is rejected") {
    const LabelGrid grid = labelled({2, 2, 2}, 2, [](const glm::ivec3& p) { return p.x; });
    Labels node = node_of(grid);
    node.values = {1, 2};
    CHECK(said_of(node) == "labels: \"values\" needs one entry for each of the 1 phases, but has 2");
    node = node_of(grid);
    node.of_phases = {Phase{1}, Phase{2}};
    node.values = {1, 1};
    CHECK(said_of(node) == "labels: \"values\" must be different whole numbers");
    node.values = {1, 1.5f};
    CHECK(said_of(node) == "labels: \"values\" must be different whole numbers");
    node = node_of(grid, 1, glm::vec3(0));
    CHECK(said_of(node).find("\"spacing\" must be [x, y, z], each positive") != std::string::npos);
    LabelGrid placed = grid;
    placed.has_spacing = true;
    CHECK(said_of(node_of(placed)) == "labels: the grid has its own spacing; remove \"spacing\"");
    LabelGrid few = grid;
    few.voxels.pop_back();
    CHECK(said_of(node_of(few)) == "labels: the grid lacks some of its voxels");
    LabelGrid huge = grid;
    huge.lattice.size = {8192, 8192, 8};
    CHECK(said_of(node_of(huge)) == "labels: the grid has more than 134217728 voxels");
}

TEST_CASE("a grid of one number alone is its box") {
    const LabelGrid grid = labelled({4, 5, 6}, 2, [](const glm::ivec3&) { return 1; });
    const Phased object = node_of(grid, 1, glm::vec3(0.5f));
    CHECK(distances(object, {0, 0, 0})[1] == doctest::Approx(-1));
    CHECK(distances(object, {0, 0, 2.5f})[0] == doctest::Approx(-1));
    CHECK(bounds(object).high.z == doctest::Approx(1.5));
    const Phased nothing = node_of(labelled({4, 5, 6}, 2, [](const glm::ivec3&) { return 0; }), 1, glm::vec3(0.5f));
    CHECK(label(distances(nothing, {0, 0, 0})) == vacuum);
}

}  // namespace test_label_grids
