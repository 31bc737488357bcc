// Lamps in clusters: no lamp that emits is lost, choices have the reported probability, and rays meet the same lamps as
// without clusters.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "image/luminance.hpp"
#include "light_checks.hpp"
#include "lights/lights.hpp"
#include "sampling/warps.hpp"

namespace test_light_tree {

using namespace phasetree::tracer;
using namespace phasetree::tests;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

glm::vec3 three(Uniform& random) {
    const glm::vec2 two = random.two();
    return {two, random()};
}

// Some lamps of each finite kind, of many sizes and strengths, in groups.
Lights lamps_of_all_kinds(int count, std::uint32_t seed) {
    Lights lights;
    Uniform random(seed);
    const auto profile = std::make_shared<const IesProfile>(
        "IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n1 1000 1 3 1 1 2 0 0 0\n1 1 60\n0 45 90\n0\n100 60 10\n");
    glm::vec3 bunch(0);
    for (int i = 0; i < count; ++i) {
        if (i % 17 == 0) bunch = 20.0f * (three(random) - 0.5f);
        const glm::vec3 at = bunch + three(random) - 0.5f;
        const glm::vec3 target = at + square_to_uniform_sphere(random.two());
        const glm::vec3 light = std::exp(4.0f * random()) * (three(random) + 0.1f);
        switch (static_cast<int>(random() * 6)) {
            case 0:
                lights.add(SphereLight(at, 0.01f + 0.2f * random(), light));
                break;
            case 1:
                lights.add(RectangleLight::facing(at, target, 0.01f + 0.3f * random(), 0.2f, light, random() < 0.5f));
                break;
            case 2:
                lights.add(AnyPointLight(PointLight(at, light)));
                break;
            case 4:
                lights.add(EmissivePart({at, 0.05f + 0.2f * random()}, light.x));
                break;
            case 3:
                lights.add(AnyPointLight(IesLight(at, target, 20.0f, profile, light)));
                break;
            default:
                lights.add(AnyPointLight(SpotLight(at, target, 1.0f + 200.0f * random(), 0.5f, light)));
        }
    }
    return lights;
}

LightReceiver receiver(Uniform& random) {
    const glm::vec3 p = 24.0f * (three(random) - 0.5f);
    if (random() < 0.3f) return p;
    return {p, square_to_uniform_sphere(random.two())};
}

}  // namespace

TEST_CASE("clustered lamps: samples and rays agree on radiance, distance and density") {
    Lights lights = lamps_of_all_kinds(300, 1);
    lights.add(ConstantEnvironment(glm::vec3(0.1f)));
    lights.add(Portal(RectangleLight::facing({0, 0, 9}, {0, 0, 0}, 9, 5, glm::vec3(0), false)));
    lights.cluster_lamps();
    Uniform random(2);
    int area = 0, points = 0, infinite = 0;
    for (int i = 0; i < 30000; ++i) {
        const LightReceiver at = receiver(random);
        const auto s = lights.sample(at, random.two());
        if (!s) continue;
        if (const auto* point = std::get_if<OfPointLight>(&s->source)) {
            ++points;
            REQUIRE(lights.point_light_probability(at, point->index) == doctest::Approx(s->pdf).epsilon(1e-5));
            continue;
        }
        const auto again = lights.seen(at.p, s->wi, infinity, false).value();
        REQUIRE(again.distance == s->distance);
        REQUIRE(again.radiance == s->radiance);
        REQUIRE(lights.pdf(at, s->wi) == doctest::Approx(s->pdf).epsilon(1e-5));
        ++(s->distance == infinity ? infinite : area);
    }
    CHECK(area > 1000);
    CHECK(points > 1000);
    CHECK(infinite > 1000);
}

TEST_CASE("clustered lamps: each that shines on a receiver is chosen with a probability above 0") {
    Uniform random(3);
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        Lights lights = lamps_of_all_kinds(60, seed);
        const Lights one_by_one = lights;
        lights.cluster_lamps();
        int shining = 0;
        for (int i = 0; i < 2000; ++i) {
            // Also close to the lamps, and where they are barely visible.
            LightReceiver at = receiver(random);
            if (i % 2 == 0) {
                const auto& lamp = one_by_one.area()[static_cast<std::size_t>(i) % one_by_one.area().size()].light;
                at.p = std::visit([](const auto& light) -> BoundingSphere { return light.bounding_sphere(); }, lamp)
                           .centre +
                       std::pow(10.0f, -3 * random()) * square_to_uniform_sphere(random.two());
            }
            for (std::size_t k = 0; k < lights.points().size(); ++k) {
                if (!(one_by_one.point_light_probability(at, k) > 0.0f)) continue;
                REQUIRE(lights.point_light_probability(at, k) > 0.0f);
                ++shining;
            }
            const glm::vec3 w = square_to_uniform_sphere(random.two());
            if (!(one_by_one.pdf(at, w) > 0.0f)) continue;
            REQUIRE(lights.pdf(at, w) > 0.0f);
            ++shining;
        }
        CHECK(shining > 1000);
    }
}

TEST_CASE("clustered lamps: weak ones close by are chosen beside strong ones, above a floor and below it") {
    Lights lights;
    Uniform random(21);
    for (int i = 0; i < 400; ++i) {
        const float height = i % 2 == 0 ? 0.005f : -2.5f * random();
        lights.add(AnyPointLight(PointLight(10.0f * glm::vec3(random.two(), 0) + glm::vec3(0, 0, height),
                                            glm::vec3(i % 20 == 0 ? 1e4f : 1.0f))));
    }
    const Lights one_by_one = lights;
    lights.cluster_lamps();
    for (std::size_t k = 0; k < 400; k += 2) {
        const glm::vec3 lamp = std::visit([](const auto& light) { return light.position(); }, lights.points()[k].light);
        const LightReceiver at(glm::vec3(lamp.x + 0.001f, lamp.y, 0), {0, 0, 1});
        const float best = one_by_one.point_light_probability(at, k), found = lights.point_light_probability(at, k);
        REQUIRE(found > 1e-6f * best);
    }
}

TEST_CASE("cones of one axis stay as wide as they are, and opposite ones are all directions") {
    Uniform random(22);
    constexpr double half_turn = std::numbers::pi;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 axis = glm::normalize(glm::dvec3(square_to_uniform_sphere(random.two())));
        const glm::dvec3 near = glm::normalize(axis + 1e-7 * glm::dvec3(three(random)));
        const EmissionCone plane = EmissionCone::of_plane(axis);
        CHECK(merged(plane, plane).measure() == doctest::Approx(half_turn).epsilon(1e-2));
        CHECK(merged(plane, EmissionCone::of_plane(near)).measure() == doctest::Approx(half_turn).epsilon(1e-2));
        CHECK(merged(plane, EmissionCone::of_plane(-axis)).measure() == doctest::Approx(4 * half_turn));
    }
}

TEST_CASE("clustered lamps are chosen as often as their probabilities say") {
    Lights lights;
    Uniform random(4);
    for (int i = 0; i < 100; ++i)
        lights.add(AnyPointLight(SpotLight(4.0f * (three(random) - 0.5f), 4.0f * (three(random) - 0.5f), 300, 1,
                                           std::exp(3.0f * random()) * glm::vec3(1.0f))));
    lights.cluster_lamps();
    const LightReceiver at({0.5f, 0.2f, 0.1f}, {0, 0, 1});
    // The last outcome is that there is no sample: a cluster's bound may be positive although none of its lamps sends
    // light.
    std::vector<double> expected(101), observed(101), defective(101);
    const auto count = static_cast<int>(samples_to_detect(1e-4, 100.0));
    double sum = 0;
    for (std::size_t k = 0; k < 100; ++k) {
        expected[k] = static_cast<double>(lights.point_light_probability(at, k));
        sum += expected[k];
        expected[k] *= count;
    }
    CHECK(sum > 0.95);
    CHECK(sum < 1.00001);
    expected[100] = std::max(1 - sum, 0.0) * count;
    for (int i = 0; i < count; ++i) {
        const glm::vec2 u = random.two();
        const auto chosen = [&](const glm::vec2& v) {
            const auto sample = lights.sample(at, v);
            return sample ? std::get<OfPointLight>(sample->source).index : 100;
        };
        ++observed[chosen(u)];
        ++defective[chosen(i % 100 == 0 ? glm::vec2(0.5f * u.x, u.y) : u)];
    }
    CHECK(chi_squared_test(observed, expected).p_value > significance);
    CHECK(chi_squared_test(defective, expected).p_value < significance);
}

TEST_CASE("clustered lamps give the irradiance that all of them give together") {
    Uniform random(5);
    Lights lights;
    const LightReceiver at({0.3f, -0.2f, 0.0f}, {0, 0, 1});
    double expected = 0;
    for (int i = 0; i < 400; ++i) {
        // They are all around, near and far, and so small that they hardly hide each other.
        const float distance_to = 1.0f + 19.0f * random();
        const glm::vec3 centre = at.p + distance_to * square_to_uniform_sphere(random.two());
        const float radius = 0.002f * distance_to * (0.1f + random()), radiance = std::exp(6.0f * random());
        lights.add(SphereLight(centre, radius, glm::vec3(radiance)));
        const glm::dvec3 way = glm::dvec3(centre) - glm::dvec3(at.p);
        const double distance = glm::length(way), sine = static_cast<double>(radius) / distance;
        expected += way.z > 0 ? std::numbers::pi * static_cast<double>(radiance) * sine * sine * way.z / distance : 0.0;
    }
    lights.cluster_lamps();
    check(estimator_test(expected, 400000, [&](Uniform& numbers) {
        const auto s = lights.sample(at, numbers.two());
        return s ? static_cast<double>(luminance(s->radiance) * std::max(s->wi.z, 0.0f) / s->pdf) : 0.0;
    }));
}

TEST_CASE("a lamp that is added to a tree of any size is chosen as the others are") {
    for (const int count : {1, 2, 40}) {
        CAPTURE(count);
        Lights lights;
        for (int i = 0; i < count; ++i) lights.add(SphereLight({static_cast<float>(i), 0, 2}, 0.3f, glm::vec3(1)));
        lights.cluster_lamps();
        lights.add(SphereLight({0, 5, 0}, 0.5f, glm::vec3(3)));
        CHECK(lights.pdf(glm::vec3(0), {0, 1, 0}) > 0.0f);
    }
}

TEST_CASE("clustered lamps: rays see the same as if each is asked") {
    const Lights one_by_one = lamps_of_all_kinds(500, 6);
    Lights lights = one_by_one;
    lights.cluster_lamps();
    Uniform random(7);
    int met = 0;
    for (int i = 0; i < 250000; ++i) {
        const glm::vec3 p = 24.0f * (three(random) - 0.5f), w = square_to_uniform_sphere(random.two());
        const bool camera_ray = random() < 0.5f;
        const float geometry = random() < 0.5f ? infinity : 20.0f * random();
        const auto a = lights.area_light_seen(p, w, geometry, camera_ray);
        const auto b = one_by_one.area_light_seen(p, w, geometry, camera_ray);
        REQUIRE(a.has_value() == b.has_value());
        if (!a) continue;
        ++met;
        REQUIRE(a->distance == b->distance);
        REQUIRE(std::get<OfAreaLight>(a->source).index == std::get<OfAreaLight>(b->source).index);
    }
    CHECK(met > 500);
}

TEST_CASE("clustered lamps: one that is added later counts, and up to this many are asked one by one") {
    Lights lights = lamps_of_all_kinds(100, 10), expected = lights;
    lights.cluster_lamps();
    for (Lights* each : {&lights, &expected}) {
        each->add(SphereLight({0, 0, 40}, 0.5f, glm::vec3(1e6f)));
        each->add(AnyPointLight(PointLight({0, 0, 30}, glm::vec3(1e6f))));
    }
    Lights few = lamps_of_all_kinds(30, 11), same = few;
    same.cluster_lamps();
    Uniform random(12);
    for (int i = 0; i < 1000; ++i) {
        const LightReceiver at = receiver(random);
        const glm::vec2 u = random.two();
        for (const auto& [a, b] : {std::pair(&lights, &expected), std::pair(&few, &same)}) {
            const auto s = a->sample(at, u), t = b->sample(at, u);
            REQUIRE(s.has_value() == t.has_value());
            if (!s) continue;
            REQUIRE(s->wi == t->wi);
            REQUIRE(s->pdf == t->pdf);
        }
    }
}

TEST_CASE("clustered lamps: of one place, of places far apart, and of no light") {
    Lights lights;
    for (int i = 0; i < 50; ++i) lights.add(AnyPointLight(PointLight({1, 2, 3}, glm::vec3(1.0f))));
    for (int i = 0; i < 50; ++i)
        lights.add(SphereLight({std::pow(10.0f, static_cast<float>(i % 30) - 15.0f), 0, 0}, 1e-17f, glm::vec3(1e30f)));
    for (int i = 0; i < 10; ++i) lights.add(SphereLight({-1, 0, 0}, 0.1f, glm::vec3(0.0f)));
    lights.cluster_lamps();
    Uniform random(8);
    int samples = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto s = lights.sample(glm::vec3(1, 1, 1), random.two());
        if (!s) continue;
        REQUIRE(s->pdf > 0.0f);
        REQUIRE(std::isfinite(s->pdf));
        ++samples;
    }
    CHECK(samples > 300);
    CHECK(lights.point_light_probability(glm::vec3(1, 1, 1), 49) > 0.0f);

    Lights dark;
    for (int i = 0; i < 50; ++i) dark.add(SphereLight({static_cast<float>(i), 0, 0}, 0.1f, glm::vec3(0.0f)));
    dark.cluster_lamps();
    CHECK_FALSE(dark.sample(glm::vec3(0, 1, 0), {0.5f, 0.5f}));
    CHECK(dark.pdf(glm::vec3(0, 1, 0), {0, -1, 0}) == 0.0f);
}

TEST_CASE("clustered lamps: the brightest of a crowd") {
    Lights lights;
    Uniform random(9);
    for (int i = 0; i < 200; ++i)
        lights.add(AnyPointLight(PointLight(10.0f * three(random) + glm::vec3(5, 0, 0), glm::vec3(0.1f))));
    lights.add(AnyPointLight(PointLight({0, 1, 1}, glm::vec3(100.0f))));
    lights.cluster_lamps();
    const glm::vec3 towards = lights.towards_brightest(glm::vec3(0), {0, 0, 1}).value();
    CHECK(glm::distance(towards, glm::normalize(glm::vec3(0, 1, 1))) < 1e-6f);
}

}  // namespace test_light_tree
