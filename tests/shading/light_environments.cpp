// Constant, gradient and image environments: density, samples, radiance and orientation.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "image/luminance.hpp"
#include "light_checks.hpp"
#include "lights/constant_environment.hpp"
#include "lights/gradient_environment.hpp"
#include "lights/image_environment.hpp"
#include "lights/lat_long.hpp"
#include "lights/load_environment.hpp"

namespace test_light_environments {

using namespace phasetree::tracer;
using namespace phasetree::tests;

namespace {

constexpr double half_turn = std::numbers::pi;

// Sixteen by eight texels with a range of 1 : 10⁴, some of them black.
ImageEnvironment test_image(float rotation_degrees = 0.0f, float intensity = 1.0f) {
    Uniform random(7);
    std::vector<glm::vec3> pixels(16 * 8);
    for (glm::vec3& pixel : pixels) {
        const float level = std::pow(10.0f, 4.0f * random() - 3.0f);
        pixel = random() < 0.2f ? glm::vec3(0.0f) : level * glm::vec3(1.0f, random(), random());
    }
    return {16, 8, pixels, rotation_degrees, intensity};
}

// ∫ luminance(L) max(0, n·ω) dω by the midpoint rule.
template <class Environment>
double irradiance_by_quadrature(const Environment& environment, const glm::vec3& normal) {
    return sum_of(lat_long_probabilities(1, 1, 512, [&](const glm::vec3& w) {
        return static_cast<double>(luminance(environment.radiance(w)) * std::max(0.0f, glm::dot(normal, w)));
    }));
}

template <class Environment>
EstimatorResult irradiance_test(const Environment& environment, const glm::vec3& normal, double expected,
                                std::size_t count) {
    return estimator_test(expected, count, [&](Uniform& random) {
        const auto s = environment.sample(random.two());
        if (!s) return 0.0;
        const float cosine = std::max(0.0f, glm::dot(normal, s->direction));
        return static_cast<double>(luminance(environment.radiance(s->direction)) * cosine / s->pdf);
    });
}

constexpr int columns = 16;
constexpr int rows = 8;

template <class Environment, class Bin>
void check_density(const Environment& environment, const std::vector<double>& probability, const Bin& bin) {
    // The density is constant on the quadrature's grid; what remains is single precision, 6e-8 times a few roundings.
    CHECK(sum_of(probability) == doctest::Approx(1.0).epsilon(1e-6));
    check_directions(
        probability,
        [&](const glm::vec2& u) -> std::optional<glm::vec3> {
            const auto s = environment.sample(u);
            if (!s) return std::nullopt;
            return s->direction;
        },
        bin);

    Uniform random(3);
    int differing = 0;
    for (int i = 0; i < 10000; ++i) {
        const auto s = environment.sample(random.two());
        REQUIRE(s);
        CHECK(std::abs(glm::length(s->direction) - 1.0f) < 1e-6f);
        if (std::abs(environment.pdf(s->direction) - s->pdf) > 1e-5f * s->pdf) ++differing;
    }
    // A direction on a cell's boundary may round into the neighbour: 256 rows of 1e-2 against 1e-7, well below 1e-3.
    CHECK(differing < 10);
}

template <class Environment>
void check_density(const Environment& environment, int finer) {
    const auto probability = lat_long_probabilities(
        columns, rows, finer, [&](const glm::vec3& w) { return static_cast<double>(environment.pdf(w)); });
    check_density(environment, probability, [](const glm::vec3& w) { return lat_long_bin(columns, rows, w); });
}

// For a density that depends on z alone: bins of equal height, which have equal solid angles.
template <class Environment>
void check_zonal_density(const Environment& environment) {
    constexpr int finer = 32;
    std::vector<double> probability(columns * rows, 0.0);
    for (int zone = 0; zone < rows * finer; ++zone) {
        const double z = (2.0 * zone + 1.0) / (rows * finer) - 1.0;
        for (int column = 0; column < columns; ++column)
            probability[static_cast<std::size_t>(zone / finer * columns + column)] +=
                4.0 * half_turn / (columns * rows * finer) * environment.pdf(direction_of(0.4 * column, z));
    }
    check_density(environment, probability, [](const glm::vec3& w) {
        const int row = std::clamp(static_cast<int>(0.5f * (w.z + 1.0f) * rows), 0, rows - 1);
        return row * columns + lat_long_bin(columns, 1, w);
    });
}

}  // namespace

TEST_CASE("constant environment: density and irradiance") {
    const ConstantEnvironment environment(glm::vec3(1.0f));
    check_density(environment, 2);
    // The variance of 4π cos⁺ over the square of its mean, π, is 16/6 − 1. So with 2.5 million samples, 1 % is 12
    // standard deviations.
    check(irradiance_test(environment, {0.0f, 0.6f, 0.8f}, half_turn, 2500000));
    CHECK(environment.fluence() == doctest::Approx(4.0 * half_turn));
}

TEST_CASE("gradient environment: density and irradiance") {
    const glm::vec3 zenith(2.0f);
    const glm::vec3 horizon(0.5f);
    const glm::vec3 ground(0.1f);
    const GradientEnvironment environment(zenith, horizon, ground);
    check_zonal_density(environment);
    // ∫₀¹ S(z) z dz = 3/4 − 2/5.
    const double expected = 2.0 * half_turn * (0.35 * 2.0 + 0.15 * 0.5);
    check(irradiance_test(environment, {0.0f, 0.0f, 1.0f}, expected, 1000000));
    CHECK(environment.radiance({0.0f, 0.0f, 1.0f}) == zenith);
    CHECK(environment.radiance({0.0f, 1.0f, 0.0f}) == horizon);
    CHECK(environment.radiance({0.0f, 0.0f, -1.0f}) == ground);
}

TEST_CASE("gradient environment: what emits is sampled, however steep the gradient") {
    for (const float softness : {1.0f, 0.1f, 0.001f}) {
        const GradientEnvironment environment(glm::vec3(0.0f), glm::vec3(1.0f), glm::vec3(0.0f), softness);
        const glm::vec3 normal = glm::normalize(glm::vec3(0.0f, 1.0f, 0.2f));
        Uniform random(11);
        for (int i = 0; i < 100000; ++i) {
            const glm::vec3 w = direction_of(6.0 * random(), 0.002 * random() - 0.001);
            if (environment.radiance(w).x > 0.0f) CHECK(environment.pdf(w) > 0.0f);
        }
        if (softness < 0.01f) continue;
        check(irradiance_test(environment, normal, irradiance_by_quadrature(environment, normal), 2000000));
    }
}

TEST_CASE("image environment: density and irradiance, turned or not") {
    for (const float rotation : {0.0f, 67.5f}) {
        CAPTURE(rotation);
        const ImageEnvironment environment = test_image(rotation, 0.5f);
        check_density(environment, 2);
        for (const glm::vec3 normal : {glm::vec3(0, 0, 1), glm::vec3(0.6f, -0.8f, 0), glm::vec3(0, 0.6f, -0.8f)}) {
            // As measured, the standard deviation is less than twice the mean. So with a million samples, 1 % is 5
            // standard deviations.
            check(irradiance_test(environment, normal, irradiance_by_quadrature(environment, normal), 2000000));
        }
    }
}

TEST_CASE("image environment: a black texel beside a bright one is sampled, because interpolation lights it") {
    for (const float rotation : {0.0f, 100.0f}) {
        std::vector<glm::vec3> pixels(32 * 16, glm::vec3(0.0f));
        pixels[5 * 32 + 0] = glm::vec3(100.0f);
        const ImageEnvironment environment(32, 16, pixels, rotation);
        Uniform random(5);
        int bright = 0;
        for (int i = 0; i < 200000; ++i) {
            const glm::vec3 w = direction_of(2.0 * half_turn * random(), 2.0 * random() - 1.0);
            // Rounding decides on which side of a cell's edge a direction lies; 1e-3 of the bright texel is well above
            // that effect.
            if (environment.radiance(w).x <= 0.1f) continue;
            ++bright;
            CHECK(environment.pdf(w) > 0.0f);
        }
        CHECK(bright > 1000);
    }
}

TEST_CASE("image environment: large images are sampled by blocks") {
    constexpr int width = 4096;
    constexpr int height = 16;
    std::vector<glm::vec3> pixels(width * height, glm::vec3(0.01f));
    for (int i = 0; i < 64; ++i) pixels[static_cast<std::size_t>(5 * width + 997 + i)] = glm::vec3(30.0f, 20.0f, 10.0f);
    const ImageEnvironment environment(width, height, pixels);
    const auto probability = lat_long_probabilities(
        2048, 16, 1, [&](const glm::vec3& w) { return static_cast<double>(environment.pdf(w)); });
    CHECK(sum_of(probability) == doctest::Approx(1.0).epsilon(1e-5));
    const glm::vec3 normal(0.0f, 0.0f, 1.0f);
    check(irradiance_test(environment, normal, irradiance_by_quadrature(environment, normal), 1000000));
}

TEST_CASE("image environment: its bright parts are caps around what is much brighter than the rest") {
    constexpr int width = 64, height = 32;
    const auto parts_of = [](const std::vector<std::pair<int, float>>& bright, float sky = 0.1f) {
        std::vector<glm::vec3> pixels(width * height, glm::vec3(sky));
        for (const auto& [texel, radiance] : bright) pixels[static_cast<std::size_t>(texel)] = glm::vec3(radiance);
        return ImageEnvironment(width, height, pixels).bright_parts();
    };
    CHECK(parts_of({}).empty());
    CHECK(parts_of({}, 0.0f).empty());
    CHECK(parts_of({{10 * width + 20, 0.5f}}).empty());  // a texel five times as bright as the sky is not a sun
    // All directions in which a part shines are in its cap, which is no larger than the texel and those around it.
    const auto check_part = [](const Cap& part, int column, int row) {
        const auto direction = [&](float x, float y) {
            const double u = (column + static_cast<double>(x)) / width, v = (row + static_cast<double>(y)) / height;
            return direction_of((2 * u - 1) * std::numbers::pi, std::cos(v * std::numbers::pi));
        };
        for (const float x : {-0.49f, 0.5f, 1.49f})
            for (const float y : {-0.49f, 0.5f, 1.49f}) CHECK(part.contains(direction(x, y)));
        const double step = std::numbers::pi / height;
        CHECK(static_cast<double>(part.solid_angle()) < std::numbers::pi * std::pow(2.5 * step, 2));
    };
    const auto one = parts_of({{10 * width + 20, 1000.0f}});
    REQUIRE(one.size() == 1);
    check_part(one[0], 20, 10);
    // Texels on both sides of the seam form one part, and a part at the zenith is round.
    const auto seam = parts_of({{10 * width, 1000.0f}, {10 * width + width - 1, 1000.0f}});
    REQUIRE(seam.size() == 1);
    CHECK(glm::length(seam[0].axis() - glm::normalize(glm::vec3(0, seam[0].axis().y, seam[0].axis().z))) < 1e-3f);
    CHECK(seam[0].axis().y < 0);
    std::vector<std::pair<int, float>> zenith;
    for (int column = 0; column < width; ++column) zenith.emplace_back(column, 1000.0f);
    REQUIRE(parts_of(zenith).size() == 1);
    CHECK(parts_of(zenith)[0].axis().z > 0.9999f);
    // The brightest first, and no more than four.
    std::vector<std::pair<int, float>> six;
    for (int i = 0; i < 6; ++i) six.emplace_back(12 * width + 5 + 10 * i, 1000.0f + 100.0f * static_cast<float>(i));
    const auto four = parts_of(six, 0.01f);
    REQUIRE(four.size() == 4);
    check_part(four[0], 55, 12);
    check_part(four[3], 25, 12);
    // The parts rotate with the image.
    std::vector<glm::vec3> pixels(width * height, glm::vec3(0.1f));
    pixels[10 * width + 20] = glm::vec3(1000);
    const ImageEnvironment turned(width, height, pixels, 70);
    REQUIRE(turned.bright_parts().size() == 1);
    CHECK(turned.radiance(turned.bright_parts()[0].axis()).x > 500);
}

TEST_CASE("image environment: orientation and rotation") {
    // One bright texel; its centre is at azimuth 2π (column + 1/2)/16 − π. The azimuth 45° is to the right of +y.
    std::vector<glm::vec3> pixels(16 * 8, glm::vec3(0.0f));
    pixels[2 * 16 + 9] = glm::vec3(1.0f, 2.0f, 3.0f);
    const double cos_theta = std::cos(half_turn * 2.5 / 8.0);
    const glm::vec3 there = direction_of(2.0 * half_turn * 9.5 / 16.0 - half_turn, cos_theta);
    CHECK(there.x > 0.0f);
    CHECK(there.y > 0.0f);
    CHECK(there.z > 0.0f);
    const glm::vec3 seen = ImageEnvironment(16, 8, pixels).radiance(there);
    CHECK(glm::length(seen - glm::vec3(1.0f, 2.0f, 3.0f)) < 1e-4f);
    // After a rotation by 90°, clockwise as seen from above, the part that was at +y is at +x.
    const glm::vec3 turned(there.y, -there.x, there.z);
    const glm::vec3 seen_turned = ImageEnvironment(16, 8, pixels, 90.0f).radiance(turned);
    CHECK(glm::length(seen_turned - glm::vec3(1.0f, 2.0f, 3.0f)) < 1e-4f);
    CHECK(direction_of_degrees(90.0f, 0.0f).x == doctest::Approx(1.0));
    CHECK(direction_of_degrees(0.0f, 0.0f).y == doctest::Approx(1.0));
}

TEST_CASE("image environment: unusable pixels are replaced, unusable images refused") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    const ImageEnvironment environment(2, 1, {{nan, -1.0f, 0.25f}, {nan, -infinity, infinity}});
    for (const float azimuth : {0.0f, -90.0f, 90.0f, 180.0f}) {
        const glm::vec3 seen = environment.radiance(direction_of_degrees(azimuth, 10.0f));
        CHECK(seen.r == 0.0f);
        CHECK(seen.g == 0.0f);
        CHECK(seen.b >= 0.25f);
        CHECK(seen.b <= 65504.0f);
    }
    CHECK_THROWS_AS(ImageEnvironment(2, 2, {{1, 1, 1}}), std::invalid_argument);
    CHECK_THROWS_AS(ImageEnvironment(0, 0, std::vector<glm::vec3>{}), std::invalid_argument);
    CHECK_THROWS_AS(ImageEnvironment(1, 1, {{1, 1, 1}}, nan), std::invalid_argument);
    CHECK_THROWS_AS(ImageEnvironment(1, 1, {{1, 1, 1}}, 0.0f, -1.0f), std::invalid_argument);
    CHECK_THROWS_AS(GradientEnvironment(glm::vec3(nan), {}, {}), std::invalid_argument);
    CHECK_THROWS_AS(GradientEnvironment({}, {}, {}, 0.0f), std::invalid_argument);
    CHECK_THROWS_AS(ConstantEnvironment(glm::vec3(-1.0f)), std::invalid_argument);
    const ImageEnvironment black(2, 1, {{0, 0, 0}, {0, 0, 0}});
    CHECK_FALSE(black.sample({0.5f, 0.5f}));
    CHECK(black.fluence() == 0.0f);
    CHECK(black.pdf({0.0f, 0.0f, 1.0f}) == 0.0f);
}

TEST_CASE("environment images are read from files, and what is wrong with a file is said") {
    const auto folder = std::filesystem::temp_directory_path() / "phasetree-light-environments";
    std::filesystem::create_directories(folder);
    const auto write = [&](const char* name, const std::string& bytes) {
        const auto path = folder / name;
        std::ofstream(path, std::ios::binary) << bytes;
        return path.string();
    };
    // Radiance's format: a mantissa byte per channel and a common exponent; (128, 64, 32, 129) is (1, 0.5, 0.25).
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n";
    std::string pixels;
    for (int i = 0; i < 8; ++i) pixels += "\x80\x40\x20\x81";
    const ImageEnvironment environment = load_environment(write("good.hdr", header + pixels), 0.0f, 2.0f);
    const glm::vec3 seen = environment.radiance({0.0f, 1.0f, 0.3f});
    // The format rounds to 8 bits.
    CHECK(seen.r == doctest::Approx(2.0).epsilon(0.01));
    CHECK(seen.g == doctest::Approx(1.0).epsilon(0.01));
    CHECK(seen.b == doctest::Approx(0.5).epsilon(0.02));

    // A plain PPM holds sRGB: 188 is 0.5 of full light.
    std::string grey = "P6 2 1 255\n";
    grey += std::string(6, static_cast<char>(188));
    CHECK(load_environment(write("grey.ppm", grey)).radiance({1.0f, 0.0f, 0.0f}).g ==
          doctest::Approx(0.503).epsilon(0.005));

    const auto message = [](const std::string& path) -> std::string {
        try {
            load_environment(path);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "";
    };
    CHECK(message((folder / "absent.hdr").string()).find("no such file") != std::string::npos);
    CHECK(message(folder.string()).find("not a file") != std::string::npos);
    CHECK(message(write("text.hdr", "hello")).find("text.hdr") != std::string::npos);
    CHECK(message(write("tall.ppm", "P6 1 4 255\nabcabcabcabc")).find("twice as wide") != std::string::npos);
    CHECK_FALSE(message(write("short.hdr", header + "abc")).empty());
    std::filesystem::remove_all(folder);
}

}  // namespace test_light_environments
