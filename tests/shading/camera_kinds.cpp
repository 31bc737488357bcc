// Panoramic, dome and tilt–shift cameras, and the shapes of apertures, against geometry.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

#include "camera/camera.hpp"
#include "support/uniform.hpp"

namespace test_camera_kinds {

using namespace phasetree::tracer;
using phasetree::tests::Uniform;

namespace {

constexpr glm::vec2 no_lens{0.5f, 0.5f};

bool same(const glm::vec3& a, const glm::vec3& b) {
    return glm::length(a - b) < 1e-6f;
}

}  // namespace

TEST_CASE("panorama: the middle is the axis, quarters are right, left and behind, the edges up and down") {
    PanoramaParameters p;
    p.position = {1, 2, 3};
    p.look_at = {1, 7, 3};
    const Panorama camera(p, {400, 200});
    const auto towards = [&](double x, double y) { return camera.generate({x, y}, no_lens).direction; };
    CHECK(same(towards(200, 100), {0, 1, 0}));
    CHECK(same(towards(300, 100), {1, 0, 0}));
    CHECK(same(towards(100, 100), {-1, 0, 0}));
    CHECK(same(towards(0, 100), {0, -1, 0}));
    CHECK(same(towards(137, 0), {0, 0, 1}));
    CHECK(same(towards(137, 200), {0, 0, -1}));
    const double s = std::sqrt(0.5);
    CHECK(same(towards(200, 50), {0, float(s), float(s)}));
    CHECK_FALSE(same(towards(200, 51), {0, float(s), float(s)}));
    CHECK(camera.single_origin() == p.position);
}

TEST_CASE("dome: the angle grows evenly outwards") {
    DomeParameters p;
    const Dome camera(p, {300, 200});
    const auto towards = [&](double x, double y) { return camera.generate({x, y}, no_lens).direction; };
    CHECK(same(towards(150, 100), {0, 1, 0}));
    CHECK(same(towards(250, 100), {1, 0, 0}));
    CHECK(same(towards(150, 0), {0, 0, 1}));
    for (const double out : {10.0, 55.0, 99.0}) {
        const double angle = std::acos(static_cast<double>(towards(150, 100 + out).y)) * 180 / std::numbers::pi;
        CHECK(angle == doctest::Approx(out / 100 * 90).epsilon(1e-4));
        CHECK_FALSE(1.01 * angle == doctest::Approx(out / 100 * 90).epsilon(1e-3));
    }
    p.fov_degrees = 361;
    CHECK_THROWS_AS(Dome(p, {300, 200}), std::invalid_argument);
}

TEST_CASE("tilt-shift: all rays of a point of the film meet on the tilted plane of focus") {
    TiltShiftParameters p;
    p.position = {0, 0, 0};
    p.look_at = {0, 4, 0};
    p.lens_radius = 0.3f;
    p.tilt = {50, -20};
    p.shift = {0.1f, 0.2f};
    const TiltShift camera(p, {200, 200});
    // The plane passes through (0, 4, 0), leaning away by 50° upwards and towards the camera by 20° at its right.
    const double up = std::tan(50 * std::numbers::pi / 180), right = std::tan(-20 * std::numbers::pi / 180);
    Uniform random(4);
    for (const glm::dvec2 film : {glm::dvec2(100, 100), glm::dvec2(30, 160), glm::dvec2(190, 120)}) {
        const CameraRay centre = camera.generate(film, no_lens);
        // y = 4 + up · z + right · x along t · direction.
        const glm::dvec3 d(centre.direction);
        const double t = 4 / (d.y - up * d.z - right * d.x);
        REQUIRE(t > 0);
        const glm::dvec3 focus = t * d;
        double farthest = 0, by_one_percent = 1e9;
        for (int i = 0; i < 100; ++i) {
            const CameraRay ray = camera.generate(film, random.two());
            const glm::dvec3 o(ray.origin), w(ray.direction);
            const auto off = [&](const glm::dvec3& q) { return glm::length(glm::cross(q - o, w)); };
            farthest = std::max(farthest, off(focus));
            if (glm::length(o) > 0.2) by_one_percent = std::min(by_one_percent, off(1.01 * focus));
        }
        CHECK(farthest < 1e-5);
        CHECK(by_one_percent > 1e-3);  // a plane that is 1 % farther away would be detected
    }
}

TEST_CASE("tilt-shift: shifted, it sees the part beside of a wider pinhole, with verticals parallel") {
    TiltShiftParameters p;
    p.position = {0, 0, 0};
    p.look_at = {0, 4, 0};
    p.vertical_fov_degrees = 60;
    p.shift = {0, 0.5f};
    const TiltShift camera(p, {100, 100});
    CHECK(same(camera.generate({50, 100}, no_lens).direction, {0, 1, 0}));
    const glm::vec3 top = camera.generate({50, 0}, no_lens).direction;
    CHECK(top.z / top.y == doctest::Approx(2 * std::tan(std::numbers::pi / 6)));
    // Without shift and tilt, the camera equals the thin lens.
    ThinLensParameters thin;
    thin.position = p.position;
    thin.look_at = p.look_at;
    thin.vertical_fov_degrees = 60;
    thin.lens_radius = p.lens_radius = 0.2f;
    p.shift = {0, 0};
    const ThinLens lens(thin, {100, 100});
    const TiltShift plain(p, {100, 100});
    const CameraRay a = lens.generate({13, 77}, {0.3f, 0.8f}), b = plain.generate({13, 77}, {0.3f, 0.8f});
    CHECK(same(a.origin, b.origin));
    CHECK(same(a.direction, b.direction));
    p.tilt = {90, 0};
    CHECK_THROWS_AS(TiltShift(p, {100, 100}), std::invalid_argument);
}

TEST_CASE("aperture: a polygon of blades is filled evenly, within its circle") {
    const Aperture aperture({.lens_radius = 2, .blades = 5, .rotation_degrees = 20});
    Uniform random(8);
    const double inner = 2 * std::cos(std::numbers::pi / 5);
    int near = 0, outside = 0;
    glm::dvec2 mean(0.0);
    constexpr int samples = 200000;
    for (int i = 0; i < samples; ++i) {
        const glm::dvec2 q = aperture.sample(random.two());
        mean += q / double(samples);
        near += glm::length(q) < 0.5 * inner;
        for (int k = 0; k < 5; ++k) {
            const double a = (20 + 36 + 72 * k) * std::numbers::pi / 180;  // the middle of a side
            outside += q.x * std::cos(a) + q.y * std::sin(a) > inner + 1e-6;
        }
    }
    CHECK(outside == 0);
    // The share within a disk of half the inner radius.
    const double area = 5 * 0.5 * 4 * std::sin(2 * std::numbers::pi / 5);
    const double expected = std::numbers::pi * 0.25 * inner * inner / area;
    const double ratio = near / (samples * expected);
    CHECK(std::abs(ratio - 1) < 0.02);
    CHECK_FALSE(std::abs(1.05 * ratio - 1) < 0.02);
    CHECK(glm::length(mean) < 0.01);
    CHECK_THROWS_AS(Aperture({.lens_radius = 1, .blades = 2}), std::invalid_argument);
    CHECK_THROWS_AS(Aperture({.lens_radius = -1}), std::invalid_argument);
}

}  // namespace test_camera_kinds
