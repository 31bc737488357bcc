// The cameras and the pixel filter.
#include "camera/camera.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "film/film.hpp"
#include "light_checks.hpp"

namespace test_camera {

using namespace phasetree::tracer;
using namespace phasetree::tests;

namespace {

constexpr double half_turn = std::numbers::pi;
constexpr glm::vec2 middle{0.5f, 0.5f};  // no displacement; the lens's centre
constexpr glm::ivec2 resolution{301, 201};

ThinLensParameters example() {
    ThinLensParameters p;
    p.position = {1.0f, -4.0f, 2.0f};
    p.look_at = {0.5f, 0.5f, 0.25f};
    p.vertical_fov_degrees = 50.0f;
    return p;
}

// The ray of a sample of pixel (x, y).
CameraRay generate(const auto& camera, int x, int y, const glm::vec2& on_pixel, const glm::vec2& on_lens) {
    static const Film film(FilmSettings{}, {0, 0, 1, 1});
    return camera.generate(film.sample_position(x, y, on_pixel), on_lens);
}

}  // namespace

TEST_CASE("camera: the middle pixel looks at the target, up is up, right is right") {
    ThinLensParameters p = example();
    const ThinLens camera(p, resolution);
    const CameraRay ray = generate(camera, 150, 100, middle, middle);
    CHECK(ray.origin == p.position);
    CHECK(glm::length(ray.direction - glm::normalize(p.look_at - p.position)) < 1e-6f);
    CHECK(generate(camera, 150, 0, middle, middle).direction.z > ray.direction.z);
    CHECK(generate(camera, 300, 100, middle, middle).direction.x > ray.direction.x);
    CHECK(generate(camera, 300, 100, middle, middle).direction.z == doctest::Approx(ray.direction.z).epsilon(0.2));
    CHECK(camera.focus_distance() == doctest::Approx(glm::length(p.look_at - p.position)));
}

TEST_CASE("camera: the field of view") {
    ThinLensParameters p;
    p.position = {0, 0, 0};
    p.look_at = {0, 3, 0};
    p.vertical_fov_degrees = 60.0f;
    const ThinLens camera(p, {300, 200});
    // Row y's centre is at height 1 − 2(y + 1/2)/200 of tan 30°.
    for (const int y : {0, 37, 199}) {
        const glm::vec3 d = generate(camera, 149, y, middle, middle).direction;
        CHECK(d.z / d.y == doctest::Approx((1.0 - 2.0 * (y + 0.5) / 200.0) * std::tan(half_turn / 6.0)));
    }
    for (const int x : {0, 220, 299}) {
        const glm::vec3 d = generate(camera, x, 100, middle, middle).direction;
        CHECK(d.x / d.y == doctest::Approx((2.0 * (x + 0.5) / 300.0 - 1.0) * 1.5 * std::tan(half_turn / 6.0)));
    }
    // Pixels outside the image belong to crops of a larger one and continue the same grid.
    const glm::vec3 d = generate(camera, -1, 100, middle, middle).direction;
    CHECK(d.x / d.y == doctest::Approx((-1.0 / 300.0 - 1.0) * 1.5 * std::tan(half_turn / 6.0)));
}

TEST_CASE("camera: all rays of a pixel meet in the plane of focus") {
    for (const bool own_distance : {false, true}) {
        ThinLensParameters p = example();
        p.lens_radius = 0.2f;
        if (own_distance) p.focus_distance = 2.5f;
        const ThinLens camera(p, resolution);
        const glm::vec3 axis = glm::normalize(p.look_at - p.position);
        Uniform random(1);
        for (const glm::ivec2 pixel : {glm::ivec2(150, 100), glm::ivec2(0, 0), glm::ivec2(290, 17)}) {
            const glm::vec2 on_film = random.two();
            const CameraRay chief = generate(camera, pixel.x, pixel.y, on_film, middle);
            CHECK(glm::length(chief.origin - p.position) < 1e-6f);
            const glm::vec3 focus =
                chief.origin + chief.direction * (camera.focus_distance() / glm::dot(chief.direction, axis));
            float furthest = 0.0f;
            for (int i = 0; i < 1000; ++i) {
                const CameraRay ray = generate(camera, pixel.x, pixel.y, on_film, random.two());
                const float t = camera.focus_distance() / glm::dot(ray.direction, axis);
                CHECK(glm::length(ray.origin + t * ray.direction - focus) < 1e-5f);
                CHECK(std::abs(glm::length(ray.direction) - 1.0f) < 1e-6f);
                CHECK(std::abs(glm::dot(ray.origin - p.position, axis)) < 1e-6f);
                furthest = std::max(furthest, glm::length(ray.origin - p.position));
            }
            CHECK(furthest <= 0.2f * 1.00001f);
            CHECK(furthest > 0.199f);
        }
    }
}

TEST_CASE("camera: the lens is sampled uniformly") {
    ThinLensParameters p;
    p.position = {0, 0, 0};
    p.look_at = {0, 1, 0};
    p.lens_radius = 2.0f;
    const ThinLens camera(p, {1, 1});
    constexpr int rings = 8;
    constexpr int sectors = 8;
    check_directions(
        std::vector<double>(rings * sectors, 1.0 / (rings * sectors)),
        [&](const glm::vec2& u) { return std::optional(generate(camera, 0, 0, middle, u).origin); },
        [&](const glm::vec3& o) {
            const int ring = std::min(static_cast<int>(rings * (o.x * o.x + o.z * o.z) / 4.0f), rings - 1);
            const double angle = std::atan2(o.z, o.x) / (2.0 * half_turn) + 0.5;
            return ring * sectors + std::min(static_cast<int>(angle * sectors), sectors - 1);
        });
}

TEST_CASE("camera: looking along its up direction, and what is no camera") {
    ThinLensParameters p;
    p.position = {0, 0, 5};
    p.look_at = {0, 0, 0};
    const ThinLens camera(p, {3, 3});
    CHECK(generate(camera, 1, 0, middle, middle).direction.y > 0.0f);
    CHECK(generate(camera, 2, 1, middle, middle).direction.x > 0.0f);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto refused = [](auto change) {
        ThinLensParameters broken = example();
        change(broken);
        CHECK_THROWS_AS((ThinLens{broken, resolution}), std::invalid_argument);
    };
    refused([](ThinLensParameters& b) { b.look_at = b.position; });
    refused([&](ThinLensParameters& b) { b.position.x = nan; });
    refused([&](ThinLensParameters& b) { b.up.x = nan; });
    refused([](ThinLensParameters& b) { b.vertical_fov_degrees = 180.0f; });
    refused([](ThinLensParameters& b) { b.vertical_fov_degrees = 0.0f; });
    refused([](ThinLensParameters& b) { b.lens_radius = -1.0f; });
    refused([](ThinLensParameters& b) { b.focus_distance = 0.0f; });
    CHECK_THROWS_AS((ThinLens{example(), {301, 0}}), std::invalid_argument);
    // A 50 mm lens has a vertical field of view of 2 atan(12/50) on film; at f/2 it is 25 mm wide.
    const auto fov = static_cast<float>(2.0 * std::atan(12.0 / 50.0) * 180.0 / half_turn);
    CHECK(lens_radius_from_f_number(2.0f, fov) == doctest::Approx(0.0125));
}

TEST_CASE("orthographic camera: parallel rays, a pixel apart by the same length everywhere") {
    OrthographicParameters p;
    p.position = {1.0f, -4.0f, 2.0f};
    p.look_at = {0.5f, 0.5f, 0.25f};
    p.height = 3.0f;
    const Orthographic camera(p, resolution);
    const glm::vec3 axis = glm::normalize(p.look_at - p.position);
    const glm::vec3 right = glm::normalize(glm::cross(axis, glm::vec3(0, 0, 1))), up = glm::cross(right, axis);
    CHECK_FALSE(camera.single_origin());
    const CameraRay centre = camera.generate(0.5 * glm::dvec2(resolution), middle);
    CHECK(glm::length(centre.origin - p.position) < 1e-6f);
    // The last two are outside the picture, like pixels beyond its edge that the filter uses, and continue the grid.
    for (const glm::dvec2 film :
         {glm::dvec2(0, 0), glm::dvec2(301, 201), glm::dvec2(17.3, 99), glm::dvec2(-2, 100), glm::dvec2(150, 202.5)}) {
        const CameraRay ray = camera.generate(film, {0.1f, 0.9f});
        CHECK(glm::length(ray.direction - axis) < 1e-6f);
        CHECK(std::abs(glm::length(ray.direction) - 1.0f) < 1e-6f);
        const glm::vec3 across = ray.origin - p.position;
        CHECK(std::abs(glm::dot(across, axis)) < 2e-6f);
        CHECK(glm::dot(across, right) == doctest::Approx((film.x - 150.5) * 3.0 / 201.0).epsilon(1e-5));
        CHECK(glm::dot(across, up) == doctest::Approx((100.5 - film.y) * 3.0 / 201.0).epsilon(1e-5));
    }
    const auto refused = [](auto change) {
        OrthographicParameters broken;
        change(broken);
        CHECK_THROWS_AS((Orthographic{broken, resolution}), std::invalid_argument);
    };
    refused([](OrthographicParameters& b) { b.look_at = b.position; });
    refused([](OrthographicParameters& b) { b.height = 0.0f; });
    refused([](OrthographicParameters& b) { b.height = std::numeric_limits<float>::infinity(); });
    CHECK_THROWS_AS((Orthographic{{}, {0, 5}}), std::invalid_argument);
}

TEST_CASE("a camera of any kind is the kind that its parameters are of") {
    const ThinLensParameters lens = example();
    const OrthographicParameters parallel{.position = {1, 2, 3}, .look_at = {3, 2, 1}};
    const glm::dvec2 film(12.5, 80.25);
    CHECK(Camera(lens, resolution).generate(film, middle).direction ==
          ThinLens(lens, resolution).generate(film, middle).direction);
    CHECK(Camera(lens, resolution).single_origin() == lens.position);
    CHECK(Camera(parallel, resolution).generate(film, middle).origin ==
          Orthographic(parallel, resolution).generate(film, middle).origin);
    CHECK_FALSE(Camera(parallel, resolution).single_origin());
    CHECK(position_of(parallel) == parallel.position);
    CHECK(look_at_of(lens) == lens.look_at);
    ThinLensParameters wide = lens;
    wide.lens_radius = 0.1f;
    CHECK_FALSE(Camera(wide, resolution).single_origin());
}

TEST_CASE("pixel filter: densities integrate to 1 and samples follow them") {
    for (const auto shape : {PixelFilter::Shape::box, PixelFilter::Shape::blackman_harris}) {
        for (const float radius : {0.5f, 1.5f}) {
            const PixelFilter filter(shape, radius);
            constexpr int cells = 32;
            constexpr int finer = 64;
            std::vector<double> probability(cells, 0.0);
            double integral = 0.0;
            for (int i = 0; i < cells * finer; ++i) {
                const double width = 2.0 * radius / (cells * finer);
                const double x = -radius + (i + 0.5) * width;
                probability[static_cast<std::size_t>(i / finer)] += filter.pdf(static_cast<float>(x)) * width;
                integral += filter.pdf(static_cast<float>(x)) * width;
                CHECK(filter.pdf(static_cast<float>(x)) >= 0.0f);
            }
            // The midpoint rule is exact for these sums of cosines over their period; the rest is single precision.
            CHECK(integral == doctest::Approx(1.0).epsilon(1e-6));
            CHECK(filter.pdf(1.001f * radius) == 0.0f);
            const auto bin = [&](const glm::vec3& v) {
                const int cell = static_cast<int>(cells * 0.5f * (v.x / radius + 1.0f));
                return std::clamp(cell, 0, cells - 1);
            };
            check_directions(
                probability, [&](const glm::vec2& u) { return std::optional(glm::vec3(filter.sample(u).y, 0, 0)); },
                bin);
            CHECK(filter.sample(0.5f) == doctest::Approx(0.0));
            CHECK(std::abs(filter.sample(0.0f)) <= radius);
            CHECK(std::abs(filter.sample(0x1.fffffep-1f)) <= radius);
            for (int i = 1; i < 1000; ++i) {
                CHECK(filter.sample(static_cast<float>(i) / 1000.0f) >=
                      filter.sample(static_cast<float>(i - 1) / 1000.0f));
            }
        }
    }
    CHECK_THROWS_AS(PixelFilter(PixelFilter::Shape::box, 0.0f), std::invalid_argument);
    CHECK_THROWS_AS(PixelFilter(PixelFilter::Shape::box, std::numeric_limits<float>::quiet_NaN()),
                    std::invalid_argument);
}

}  // namespace test_camera
