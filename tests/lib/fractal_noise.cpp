// Fractal noise equals its definition by whole numbers, is 1-Lipschitz as claimed, and the claim is sharp.
#include <doctest/doctest.h>

#include "math/dual.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/displace.hpp"
#include "phasetree/nodes/fields/fractal_noise.hpp"
#include "phasetree/nodes/fields/gyroid.hpp"
#include "phasetree/nodes/fields/schwarz_d.hpp"
#include "phasetree/nodes/fields/schwarz_p.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "support/random_tree.hpp"
#include "support/set_algebra/textures.hpp"

namespace test_fractal_noise {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

Vec3<Dual> dual(const glm::vec3& p) {
    return {Dual(p.x, 1, 0, 0), Dual(p.y, 0, 1, 0), Dual(p.z, 0, 0, 1)};
}
double slope(const Dual& d) {
    return glm::length(glm::dvec3(d.gradient()));
}

}  // namespace

TEST_CASE("the hash in floats is that in whole numbers, over all of the lattice's period and far away") {
    const FractalNoise noise(1, 1);
    const double unit = 1 / FractalNoise::slope(1, 1);
    Random rng(151);
    for (int n = 0; n < 100'000; ++n) {
        const float reach = rng.chance(0.5) ? 600.f : 65535.f;
        const glm::vec3 p = glm::floor(rng.in(Bounds::centred(glm::vec3(reach))));
        const double expected = oracle::fractal_noise(glm::dvec3(p), 1) * unit;
        REQUIRE(std::abs(noise.distance(Vec3<float>{p.x, p.y, p.z}) - expected) < 1e-6);
    }
}

TEST_CASE("between the lattice's points noise is what whole numbers say, and so is its gradient") {
    Random rng(155);
    for (const float octaves : {1.f, 3.f}) {
        const FractalNoise noise(1, octaves);
        const auto expected = [&](const glm::dvec3& p) {
            return oracle::fractal_noise(p, static_cast<int>(octaves)) / FractalNoise::slope(1, octaves);
        };
        double value = 0, slope = 0;
        for (int n = 0; n < 20'000; ++n) {
            const glm::vec3 p = rng.in(Bounds::centred(glm::vec3(40)));
            const Dual d = noise.distance(dual(p));
            REQUIRE(d.value() == noise.distance(Vec3<float>{p.x, p.y, p.z}));
            value = std::max(value, std::abs(d.value() - expected(p)));
            for (int i = 0; i < 3; ++i) {
                glm::dvec3 step(0);
                step[i] = 1e-5;
                const double rise = (expected(glm::dvec3(p) + step) - expected(glm::dvec3(p) - step)) / 2e-5;
                slope = std::max(slope, std::abs(d.gradient()[i] - rise));
            }
        }
        CAPTURE(octaves);
        CHECK(value < 1e-5);
        CHECK(slope < 3e-4);
    }
}

TEST_CASE("noise over the plane is that in space on a plane of the lattice") {
    Random rng(156);
    double value = 0;
    for (int n = 0; n < 20'000; ++n) {
        const float x = rng.uniform(-300, 300), y = rng.uniform(-300, 300);
        const auto which = static_cast<float>(static_cast<int>(rng.below(2001)) - 1000);
        value = std::max(value, std::abs(static_cast<double>(value_noise(x, y, which)) -
                                         oracle::value_noise(glm::dvec3(which, x, y))));
    }
    CHECK(value < 1e-5);
}

TEST_CASE("noise is in [-1, 1], of slope 15/4 at most, and comes near to both") {
    Random rng(152);
    for (const float octaves : {1.f, 3.f, 6.f}) {
        const FractalNoise noise(1, octaves);
        const double unit = 1 / FractalNoise::slope(1, octaves);
        double largest = 0, steepest = 0;
        for (int n = 0; n < 300'000; ++n) {
            const glm::vec3 p = rng.in(Bounds::centred(glm::vec3(100)));
            const Dual d = noise.distance(dual(p));
            largest = std::max(largest, std::abs(d.value()) / unit);
            steepest = std::max(steepest, slope(d));
            // Continuous: across a lattice's plane too.
            const glm::vec3 q = glm::round(p);
            const float below = noise.distance(Vec3<float>{std::nextafter(q.x, -1e9f), p.y, p.z});
            REQUIRE(std::abs(below - noise.distance(Vec3<float>{q.x, p.y, p.z})) < 2e-5);
        }
        CAPTURE(octaves);
        MESSAGE("octaves ", octaves, ": largest ", largest, ", steepest ", steepest);
        CHECK(largest <= 1 + 1e-6);
        CHECK(steepest <= 1 + 1e-5);
        if (octaves == 1) {
            CHECK(largest > 0.9);
            CHECK(steepest > 0.7);
        }
    }
}

TEST_CASE("the sheets' slope is 1 where the proofs say that it is reached, and nowhere more") {
    const auto steepest = [](const auto& sheet) {
        Random rng(153);
        double most = 0;
        for (int n = 0; n < 200'000; ++n)
            most = std::max(most, slope(sheet.distance(dual(rng.in(Bounds::centred(glm::vec3(2)))))));
        return most;
    };
    const glm::vec3 origin(1e-6f), quarter(0.25f);
    CHECK(slope(Gyroid{}.distance(dual(origin))) == doctest::Approx(1).epsilon(1e-5));
    CHECK(slope(SchwarzP{}.distance(dual(quarter + 1e-6f))) == doctest::Approx(1).epsilon(1e-5));
    CHECK(slope(SchwarzD{}.distance(dual(origin))) == doctest::Approx(1).epsilon(1e-5));
    CHECK(steepest(Gyroid{}) <= 1 + 1e-5);
    CHECK(steepest(SchwarzP{}) <= 1 + 1e-5);
    CHECK(steepest(SchwarzD{}) <= 1 + 1e-5);
}

TEST_CASE("a displaced field keeps its slope away from the surface, and its noise is within the amplitude") {
    const Field f = Displace{.of = Sphere{.radius = 1}, .amplitude = 0.1f, .scale = 0.2f, .octaves = 3};
    Random rng(154);
    for (int n = 0; n < 10'000; ++n) {
        const glm::vec3 p = rng.direction() * rng.uniform(0.01f, 3);
        const float ball = glm::length(p) - 1, v = distance(f, p);
        REQUIRE(v >= ball - 0.1f - 1e-6f);
        REQUIRE(v <= ball + 0.1f + 1e-6f);
        if (ball > 0.25f) REQUIRE(v > 0.5f * ball);
    }
    CHECK(bounds(f).high.x == doctest::Approx(1.1f));
}

}  // namespace test_fractal_noise
