// Water that overlaps its glass, touches it, or leaves a gap looks like water in exact contact.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tracer/support/paths.hpp"

namespace test_close_gaps {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

constexpr int columns = 16, rows = 12;
constexpr std::uint32_t seeds = 16;

std::string cylinder(double radius, double low, double high) {
    return fmt::format(R"({{"translate": {{"by": [0, 0, {}], "of": {{"cylinder": {{"radius": {}, "height": {}}}}}}}}})",
                       (low + high) / 2, radius, high - low);
}
/// A glass with a cavity of radius 0.3 above z = 0, and water up to z = 0.5. The water is larger than the cavity at the
/// wall and at the bottom, by a positive or negative length.
std::string glass_of_water(double larger_by) {
    return fmt::format(
        R"({{"over": [
            {{"set": {{"phase": "glass", "of": {{"difference": {{"from": {}, "subtract": [{}]}}}}}}}},
            {{"set": {{"phase": "water", "of": {}}}}}]}})",
        cylinder(0.34, -0.05, 0.8), cylinder(0.3, 0, 2), cylinder(0.3 + larger_by, -larger_by, 0.5));
}
std::string closed(const std::string& object) {
    return R"({"close_gaps": {"phases": ["water", "glass"], "gap": 0.0012, "of": )" + object + "}}";
}
/// From the side, below the surface of the water: bottom, walls and water. The bright side is behind it on the left.
Scene scene_with(const std::string& tree) {
    return scene_of(
        R"("glass": {"clear": {"ior": 1.5}}, "water": {"clear": {"ior": 1.33, "absorption": [0.8, 0.3, 0.1]}})", tree,
        fmt::format(R"("lights": [
            {{"gradient": {{"zenith": [0.5, 0.6, 0.9], "horizon": [0.4, 0.4, 0.4], "ground": [0.1, 0.08, 0.06]}}}},
            {{"rectangle": {{"centre": [-3, 3, 1], "target": [0, 0, 0], "width": 3, "height": 3, "radiance": [3, 3, 3]}}}}],
            "camera": {{"position": [0, -4, 0.9], "look_at": [0, 0, 0.2], "fov": 11}},
            "render": {{"width": {}, "height": {}, "samples": 64}})",
                    columns, rows));
}

/// The brightness of each quarter of a picture's columns, once for each seed. Pictures with other seeds are
/// independent.
using Quarters = std::array<Moments, 4>;
Quarters brightness(const std::string& tree, std::uint32_t first_seed) {
    Scene scene = scene_with(tree);
    const World world(scene);
    Quarters result;
    for (std::uint32_t i = 0; i < seeds; ++i) {
        scene.settings.seed = first_seed + i;
        const Image image = image_of(world, scene);
        std::array<double, 4> sums{};
        for (std::size_t pixel = 0; pixel < image.pixels.size(); ++pixel)
            sums[pixel % columns / (columns / 4)] += static_cast<double>(image.pixels[pixel].x);
        for (std::size_t quarter = 0; quarter < 4; ++quarter)
            result[quarter].add(sums[quarter] * 4 / static_cast<double>(image.pixels.size()));
    }
    return result;
}
/// The smallest p-value, over the quarters of two pictures, for equal brightness.
double p_value(const Quarters& a, const Quarters& b) {
    double least = 1;
    for (std::size_t i = 0; i < 4; ++i) {
        const double error = std::hypot(a[i].standard_error(), b[i].standard_error());
        CAPTURE(error / a[i].mean());
        CHECK(error < 0.01 * a[i].mean());
        least = std::min(least, phasetree::tests::normal_two_sided((a[i].mean() - b[i].mean()) / error));
    }
    return least;
}

}  // namespace

TEST_CASE("water that overlaps the glass, touches it, or leaves a gap looks like that of the exact tree") {
    const Quarters exact = brightness(glass_of_water(0), 1);
    const double significance = sidak(1e-4, 3 * 4);
    std::uint32_t first_seed = 1;
    for (const double larger_by : {0.0005, 0.0, -0.0005}) {
        CAPTURE(larger_by);
        first_seed += seeds;
        CHECK(p_value(exact, brightness(closed(glass_of_water(larger_by)), first_seed)) > significance);
    }
    // The test detects a difference: a gap of air mirrors light at the walls.
    CHECK(p_value(exact, brightness(glass_of_water(-0.0005), first_seed + seeds)) < significance);
}

}  // namespace test_close_gaps
