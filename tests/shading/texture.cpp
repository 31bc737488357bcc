#include "shading/texture/texture.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "bsdf_checks.hpp"
#include "shading/texture/noise.hpp"

namespace test_texture {

using namespace phasetree::tracer;
using phasetree::tests::Moments;
using phasetree::tests::Uniform;

namespace {

const std::array<Texture, 5> textures{ConstantTexture{}, CheckerTexture{}, MarbleTexture{}, SpeckleTexture{},
                                      WoodTexture{}};

}  // namespace

TEST_CASE("textures: a reflectance in [0, 1] everywhere, also where there is no such place") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    Uniform uniform(61);
    for (const Texture& texture : textures) {
        const auto sane = [&](const glm::vec3& p) {
            const glm::vec3 c = color_at(texture, p);
            for (int i = 0; i < 3; ++i) {
                if (!(c[i] >= 0.0f && c[i] <= 1.0f)) return false;
            }
            return true;
        };
        bool all = true;
        for (int i = 0; i < 20000; ++i) {
            const float x = uniform();
            const float y = uniform();
            all = all && sane(20.0f * glm::vec3{x - 0.5f, y - 0.5f, uniform() - 0.5f});
        }
        CHECK(all);
        for (const float far : {1e10f, -1e30f, 3.4e38f}) CHECK(sane({far, 1.0f, far}));
        color_at(texture,
                 glm::vec3{nan, 0.0f, infinity});  // any colour will do, without a trap or an undefined conversion
    }
}

TEST_CASE("textures: the same seed gives the same texture, another seed another") {
    const glm::vec3 p{0.123f, 0.456f, 0.789f};
    WoodTexture wood;
    const glm::vec3 first = wood.at(p);
    CHECK(wood.at(p) == first);
    wood.seed = 1;
    CHECK(wood.at(p) != first);
    SpeckleTexture sand;
    const glm::vec3 grain = sand.at(p);
    sand.seed = 1;
    CHECK(sand.at(p) != grain);
}

TEST_CASE("noise: zero on the lattice, smooth, bounded, mean zero") {
    Uniform uniform(62);
    Moments moments;
    float most = 0.0f;
    float steepest = 0.0f;
    for (int i = 0; i < 200000; ++i) {
        const float x = uniform();
        const float y = uniform();
        const glm::vec3 p = 1000.0f * glm::vec3{x - 0.5f, y - 0.5f, uniform() - 0.5f};
        const float value = gradient_noise(p, 3);
        most = std::max(most, std::abs(value));
        steepest = std::max(steepest, std::abs(gradient_noise(p + glm::vec3{0.01f, 0.0f, 0.0f}, 3) - value) / 0.01f);
        moments.add(static_cast<double>(value));
    }
    CHECK(most <= 1.0f);
    CHECK(steepest < 5.0f);  // continuous across the lattice
    // Points are independent and far apart compared with the wavelength; the mean of the field itself over a million
    // cells is off by about another 3e-4.
    CHECK(phasetree::tests::mean_p_value(moments, 0.0, 1e-3) > 1e-4);
    CHECK(moments.variance() > 0.03);
    CHECK(gradient_noise({3.0f, -7.0f, 11.0f}, 3) == 0.0f);
}

TEST_CASE("noise: continuous where coordinates change sign and across cubes") {
    for (const float x : {0.0f, 1.0f, -1.0f, 17.0f, -33.0f}) {
        const glm::vec3 below{std::nextafter(x, -1e9f), 0.4f, 0.7f};
        const glm::vec3 above{x, 0.4f, 0.7f};
        CHECK(std::abs(gradient_noise(below, 5) - gradient_noise(above, 5)) < 1e-5f);
        CHECK(std::abs(cellular_noise(below, 5).nearest - cellular_noise(above, 5).nearest) < 1e-5f);
    }
}

TEST_CASE("cellular noise: the nearest point is no farther than the next, and cells are areas") {
    Uniform uniform(63);
    int same = 0;
    for (int i = 0; i < 10000; ++i) {
        const float x = uniform();
        const float y = uniform();
        const glm::vec3 p = 100.0f * glm::vec3{x, y, uniform()};
        const Cell cell = cellular_noise(p, 7);
        const bool ordered = cell.nearest <= cell.next && cell.nearest < 1.8f;
        CHECK(ordered);
        if (!ordered) break;
        if (cellular_noise(p + glm::vec3{0.01f, 0.0f, 0.0f}, 7).id == cell.id) ++same;
    }
    CHECK(same > 9500);
}

TEST_CASE("cellular noise: distances change by no more than one moves, so no near point is overlooked") {
    Uniform uniform(64);
    float steepest_nearest = 0.0f, steepest_next = 0.0f;
    for (int i = 0; i < 200000; ++i) {
        const auto one = [&] { return 2.0f * uniform() - 1.0f; };
        const glm::vec3 p{3.0f * one(), 3.0f * one(), 3.0f * one()};
        const glm::vec3 step = 0.02f * glm::normalize(glm::vec3{one(), one(), one()});
        const Cell a = cellular_noise(p, 7), b = cellular_noise(p + step, 7);
        steepest_nearest = std::max(steepest_nearest, std::abs(a.nearest - b.nearest));
        steepest_next = std::max(steepest_next, std::abs(a.next - b.next));
    }
    CHECK(steepest_nearest < 0.02f + 1e-5f);
    CHECK(steepest_next < 0.02f + 1e-5f);
}

TEST_CASE("wood: pale along the grain it stays, across it turns") {
    // The same step changes the colour much more across the rings than along the fibres.
    const WoodTexture wood;
    Uniform uniform(64);
    Moments along;
    Moments across;
    for (int i = 0; i < 5000; ++i) {
        const float x = uniform();
        const float y = uniform();
        const glm::vec3 p{2.0f * x - 1.0f, 2.0f * y - 1.0f, uniform()};
        const float step = 0.3f * wood.ring_spacing;
        const auto change = [&](const glm::vec3& d) {
            return static_cast<double>(glm::length(wood.at(p + d) - wood.at(p)));
        };
        along.add(change({0.0f, 0.0f, step}));
        across.add(change({step, 0.0f, 0.0f}));
    }
    CHECK(across.mean() > 2.0 * along.mean());
}

TEST_CASE("checker: alternates, on both sides of the origin") {
    const CheckerTexture checker{glm::vec3{1.0f}, glm::vec3{0.0f}, 2.0f, glm::vec3{0.0f}};
    CHECK(checker.at({1.0f, 1.0f, 1.0f}).x == 1.0f);
    CHECK(checker.at({3.0f, 1.0f, 1.0f}).x == 0.0f);
    CHECK(checker.at({-1.0f, 1.0f, 1.0f}).x == 0.0f);
    CHECK(checker.at({-1.0f, -1.0f, 1.0f}).x == 1.0f);
}

}  // namespace test_texture
