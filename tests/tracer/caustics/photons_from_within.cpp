// Photons of lamps inside an object, compared with paths alone, and with a lamp of another kind.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "caustics/directions.hpp"
#include "support/uniform.hpp"
#include "tracer/support/shell_scenes.hpp"

namespace test_photons_from_within {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;
using phasetree::tests::normal_two_sided;

namespace {

// A ball as bright as a point of unit intensity.
std::string ball_at(const std::string& centre, double radius) {
    return fmt::format(R"([{{"sphere": {{"centre": {}, "radius": {}, "radiance": [{}, 1, 1]}}}}])", centre, radius,
                       1 / (std::numbers::pi * radius * radius));
}

}  // namespace

TEST_CASE("a small lamp in a shell of glass is not counted twice where photons are gathered from afar") {
    // The lamp is smaller than the gathering radius. From the point that gathers a photon, the lamp is in another
    // direction than the photon's.
    for (const char* centre : {"[0.2, 0, -0.4]", "[0.25, 0.15, -0.45]"})
        check_floor(glass, shell_around(""), ball_at(centre, 0.21), passes / 2, sidak(1e-4, 2));
}

TEST_CASE("a point light within glass shines to all sides, as a small ball does") {
    // Above the middle of the object and below.
    const double significance = sidak(1e-4, 2);
    for (const char* at : {"[0, 0, 0.5]", "[0.1, 0, -0.5]"}) {
        const auto floor_with = [&](const std::string& lights) {
            return with_photons(scene_of(glass, shell_around(""), floor_and + lights), {2.4f, 0, -1},
                                {-1.2f, 0.1f, -1.5f}, passes / 3);
        };
        const Moments point = floor_with(fmt::format(R"([{{"point": {{"position": {}}}}}])", at));
        const Moments ball = floor_with(ball_at(at, 0.05));
        const double error = std::hypot(point.standard_error(), ball.standard_error());
        CAPTURE(point.mean() / ball.mean());
        CAPTURE(error / ball.mean());
        CHECK(normal_two_sided((point.mean() - ball.mean()) / error) > significance);
        CHECK(normal_two_sided((planted * point.mean() - ball.mean()) / error) < significance);
    }
}

TEST_CASE("directions of photons are as dense as they say") {
    PhotonDirections directions(32);
    phasetree::tests::Uniform random(3);
    std::vector<double> weights(directions.bins());
    for (double& weight : weights) weight = static_cast<double>(random()) + 0.01;
    directions.set_weights(weights);
    // The mean of 1/p is the measure of all directions, and that of z/p is 0.
    Moments inverse, upward;
    for (int i = 0; i < 20000; ++i) {
        const auto [direction, bin] = directions.sample(random(), random.two());
        const double density = static_cast<double>(directions.density(direction));
        REQUIRE(density > 0);
        inverse.add(1 / density);
        upward.add(static_cast<double>(direction.z) / density);
    }
    CHECK(mean_p_value(inverse, 4 * std::numbers::pi, 0) > 1e-4);
    CHECK(mean_p_value(inverse, 1.03 * 4 * std::numbers::pi, 0) < 1e-4);
    CHECK(mean_p_value(upward, 0, 0) > 1e-4);
}

}  // namespace test_photons_from_within
