// Photons in scattering media: compared with a closed form behind a plane, and with paths alone behind curved
// interfaces.
#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "caustics/photon_placement.hpp"
#include "shading/fresnel.hpp"
#include "tracer/caustics/photons.hpp"
#include "tracer/support/phase_function_equations.hpp"
#include "world/chain.hpp"

namespace test_caustics_in_media {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;
using phasetree::tests::draine_density;
using phasetree::tests::droplets_density;

namespace {

constexpr float half_length = 0.1f;

// How often places count for points at these depths, compared with the coverage.
void check_coverage(const PhotonPlacement& placement, std::initializer_list<float> at_depths) {
    Sampler sampler(1, 2, 3, 4);
    constexpr int count = 500000;
    std::vector<float> depths(count);
    for (float& depth : depths) depth = placement.sample(sampler.next());
    for (const float depth : at_depths) {
        CAPTURE(depth);
        Moments counted;
        for (const float at : depths) counted.add(std::abs(at - depth) <= half_length ? 1.0 : 0.0);
        const auto expected = static_cast<double>(placement.coverage(depth));
        CHECK(mean_p_value(counted, expected, 0) > 1e-4);
        if (expected > 0.01) CHECK(mean_p_value(counted, planted * expected, 0) < 1e-4);
    }
}

PhotonPlacement placement_in(const glm::vec3& absorption, const glm::vec3& scattering) {
    const HomogeneousMedium medium({.absorption = absorption, .scattering = scattering});
    return PhotonPlacement::in(medium, half_length).value();
}

}  // namespace

TEST_CASE("a place on a line counts for a point as often as the coverage says") {
    // The third channel does not scatter, and its extinction does not matter.
    check_coverage(placement_in({0.5f, 0.1f, 9}, {2, 0.4f, 0}), {-0.05f, 0.0f, 0.07f, 0.3f, 1.5f, 4.0f});
    const Scene varying = scene_of(
        R"("fog": {"clear": {"ior": 1.2, "scattering": [3, 1, 2], "density": {"sphere": {"radius": 1}}, "density_depth": 0.5}})",
        R"({"set": {"phase": "fog", "of": {"sphere": {"radius": 1}}}})");
    check_coverage(PhotonPlacement::in(std::get<Clear>(varying.materials[1]).interior, half_length).value(),
                   {-0.05f, 0.0f, 0.07f, 0.3f, 1.5f, 4.0f});
    // Even where almost no light is left, nothing is infinite.
    for (const float depth : {-0.1f, 0.0f, 0.1f, 1e6f}) {
        const float coverage = placement_in({0, 0, 0}, {1e-30f, 1e30f, 1}).coverage(depth);
        CHECK(coverage >= 0);
        CHECK(coverage <= 1);
    }
    CHECK_FALSE(PhotonPlacement::in(AbsorbingMedium{glm::vec3(1)}, half_length).has_value());
}

TEST_CASE("the map tells how deep on a photon's line the point next to another is, and which count there") {
    // A line that enters at the origin and goes down, kept at the depth 2.
    const glm::vec3 back(0, 0, 1);
    TracedPhotons traced;
    traced.in_media.push_back({{{0, 0, -2}, back, glm::vec3(1), 1, phasetree::Phase{1}, {}, back}, 2});
    const float radius = 0.3f;
    const PhotonMap map(traced, 1, radius);
    const auto depths_at = [&](const glm::vec3& point, std::uint8_t phase) {
        std::vector<float> depths;
        map.near_in_medium(point, phasetree::Phase{phase},
                           [&](const Photon&, float depth) { depths.push_back(depth); });
        return depths;
    };
    REQUIRE(depths_at({0.2f, 0.1f, -2.25f}, 1).size() == 1);
    CHECK(depths_at({0.2f, 0.1f, -2.25f}, 1).front() == doctest::Approx(2.25));
    REQUIRE(depths_at({0.1f, -0.2f, -1.75f}, 1).size() == 1);
    CHECK(depths_at({0.1f, -0.2f, -1.75f}, 1).front() == doctest::Approx(1.75));
    CHECK(depths_at({0.1f, -0.2f, -1.75f}, 2).empty());                   // of another phase
    CHECK(depths_at({0.31f, 0, -2}, 1).empty());                          // too far across
    CHECK(depths_at({0, 0, -2 - 1.02f * map.half_length()}, 1).empty());  // too far along
}

TEST_CASE("roulette of chains keeps the mean of what is left") {
    Sampler sampler(5, 6, 7, 8);
    const glm::vec3 left(0.03f, 0.01f, 0.02f);
    Moments red, blue;
    for (int i = 0; i < 200000; ++i) {
        glm::vec3 share = left;
        const bool survives = chain_survives(share, sampler);
        red.add(survives ? static_cast<double>(share.x) : 0.0);
        blue.add(survives ? static_cast<double>(share.z) : 0.0);
    }
    CHECK(mean_p_value(red, 0.03, 0) > 1e-4);
    CHECK(mean_p_value(blue, 0.02, 0) > 1e-4);
    CHECK(mean_p_value(red, 1.03 * 0.03, 0) < 1e-4);
    glm::vec3 much(0.2f, 0.0f, 0.0f);
    CHECK(chain_survives(much, sampler));
    CHECK(much.x == 0.2f);
}

TEST_CASE("a point above a tank of murky water: a closed form") {
    // A field may determine the density, which is 1 everywhere in the tank.
    std::string density, phase_function = R"("anisotropy": -0.3)";
    double backwards = draine_density(-0.3, 0, -1);
    SUBCASE("homogeneous") {}
    // The short form varies the density in a ball, below.
    if (long_form) {
        SUBCASE("of a density that a field tells") {
            density = R"(, "density": {"box": {"size": [9, 9, 9]}}, "density_depth": 0.5)";
        }
    }
    SUBCASE("with another phase function") {
        phase_function = R"("phase_function": {"mix": {"first": {"droplets": {"diameter": 10}},
                            "second": {"draine": {"g": 0.1, "alpha": 6}}, "amount": 0.6}})";
        backwards = 0.4 * droplets_density(10, -1) + 0.6 * draine_density(0.1, 6, -1);
    }
    // At the depth z on the axis, the point light, which is h above the plane, appears at the distance h + z/n. Light
    // that is scattered back along the axis once is ∫ σs p(180°) I (1 − R)/(h + z/n)² exp(−2 σt z) dz. Light that is
    // scattered more often is negligible.
    constexpr double scattering = 0.006, extinction = 3, intensity = 20, height = 1, index = 1.5;
    const auto r = static_cast<double>(fresnel_dielectric(1, 1.5f).reflectance);
    double expected = 0;
    constexpr int steps = 20000;
    constexpr double from = 0.2, depth = 2;
    for (int i = 0; i < steps; ++i) {
        const double z = from + (depth - from) * (i + 0.5) / steps, away = height + z / index;
        expected += std::exp(-extinction * (2 * z - from)) / (away * away) * (depth - from) / steps;
    }
    expected *= scattering * backwards * intensity * (1 - r);
    const Scene scene = scene_of(
        R"("water": {"clear": {"ior": 1.5, "absorption": [2.994, 2.994, 2.994], "scattering": [0.006, 0.006, 0.006], )" +
            phase_function + density + "}}",
        R"({"set": {"phase": "water", "of": {"translate": {"by": [0, 0, -1], "of": {"box": {"size": [3, 3, 2]}}}}}})",
        R"("lights": [{"point": {"position": [0, 0, 1], "intensity": 20}}],
           "render": {"width": 32, "height": 32, "photons": 8, "photon_radius": 1.5})");
    const glm::vec3 origin(0, 0, -0.2f), direction(0, 0, -1);
    // Where the density varies, fewer photons count, and each counts more often.
    const Moments m = with_photons(scene, origin, direction, (density.empty() ? 3 : 12) * passes);
    CAPTURE(m.mean() / expected);
    CAPTURE(m.standard_error() / expected);
    // The disc in which photons are gathered is darker by 3/4 of (radius/distance)² on average.
    const double significance = sidak(1e-4, 2);
    CHECK(mean_p_value(m, expected, 3e-3 * expected) > significance);
    CHECK(mean_p_value(m, planted * expected, 3e-3 * expected) < significance);
    // Only photons find this light.
    CHECK(radiance_along(World(scene), scene, origin, direction, 1000)[0].mean() < 1e-4 * expected);
}

TEST_CASE("within a ball that scatters it is as bright as by paths alone") {
    const std::string sun = R"({"sun": {"direction": [0.2, 0.3, 1], "irradiance": [4, 4, 4], "diameter": 60}})";
    const std::string rectangle = R"({"rectangle": {"centre": [1, 1, 4], "target": [0, 0, 0], "width": 5, "height": 5,
                                      "radiance": [5, 5, 5]}})";
    const std::string thin = R"("absorption": [0.3, 0.3, 0.3], "scattering": [0.9, 0.9, 0.9], "anisotropy": 0.4)";
    const std::string thinnest = R"("absorption": [0.02, 0.02, 0.02], "scattering": [0.4, 0.4, 0.4])";
    const std::string thick = R"("absorption": [0.5, 0.5, 0.5], "scattering": [6, 6, 6])";
    // The other channels differ much from the first one, which is examined.
    const std::string coloured = R"("absorption": [0.2, 2, 0.1], "scattering": [1.5, 12, 0.2], "anisotropy": -0.2)";
    // Many photons find all of the light. A few share it with the other techniques, according to the weights.
    struct Case {
        std::string light, inside, around, photons;
    };
    // A line ends where it leaves the ball. It does not continue straight into the next ball, which is of the same
    // phase.
    const std::string neighbour =
        R"(, {"set": {"phase": "jelly", "of": {"translate": {"by": [0.45, 0.65, 2.2], "of": {"sphere": {"radius": 1}}}}}})";
    const std::string water = R"(, {"set": {"phase": "water", "of": {"box": {"size": [4, 4, 4]}}}})";
    std::vector<Case> cases{{sun, coloured, "", "3"}, {rectangle, thin, water, "0.1"}};
    if (long_form)
        cases.insert(cases.end(),
                     {{sun, thin, "", "0.1"}, {rectangle, thick, "", "0.2"}, {sun, thinnest, neighbour, "3"}});
    const double significance = sidak(1e-4, cases.size());
    for (const Case& c : cases) {
        CAPTURE(c.light);
        CAPTURE(c.inside);
        CAPTURE(c.around);
        const Scene scene = scene_of(
            R"("jelly": {"clear": {"ior": 1.45, )" + c.inside + R"(}}, "water": {"clear": {"ior": 1.2}})",
            R"({"over": [{"set": {"phase": "jelly", "of": {"sphere": {"radius": 1}}}})" + c.around + "]}",
            R"("lights": [)" + c.light + R"(], "render": {"width": 64, "height": 64, "photon_radius": 2, "photons": )" +
                c.photons + "}");
        check_against_paths(scene, {0.3f, -3, 0.4f}, {0, 1, 0}, passes, significance);
    }
}

TEST_CASE("within a ball whose density varies it is as bright as by paths alone") {
    const std::string sun = R"({"sun": {"direction": [0.2, 0.3, 1], "irradiance": [4, 4, 4], "diameter": 60}})";
    const std::string rectangle = R"({"rectangle": {"centre": [1, 1, 4], "target": [0, 0, 0], "width": 5, "height": 5,
                                      "radiance": [5, 5, 5]}})";
    // Dense in the middle, thin at the rim; or in waves, from nothing on.
    const std::string core = R"("density": {"sphere": {"radius": 0.9}}, "density_depth": 0.7)";
    const std::string waves = R"("density": {"gyroid": {"period": 1.1, "thickness": 0.25}}, "density_depth": 0.1)";
    struct Case {
        std::string light, density, coefficients, photons;
    };
    std::vector<Case> cases{
        {sun, core, R"("absorption": [0.3, 0.1, 0.2], "scattering": [1.5, 6, 0.4], "anisotropy": 0.3)", "0.3"}};
    if (long_form)
        cases.push_back({rectangle, waves, R"("absorption": [0.2, 0.2, 0.2], "scattering": [4, 4, 4])", "1"});
    const double significance = sidak(1e-4, cases.size());
    for (const Case& c : cases) {
        CAPTURE(c.density);
        const Scene scene = scene_of(R"("jelly": {"clear": {"ior": 1.45, )" + c.coefficients + ", " + c.density + "}}",
                                     R"({"set": {"phase": "jelly", "of": {"sphere": {"radius": 1}}}})",
                                     R"("lights": [)" + c.light +
                                         R"(], "render": {"width": 64, "height": 64, "photon_radius": 2, "photons": )" +
                                         c.photons + "}");
        check_against_paths(scene, {0.3f, -3, 0.4f}, {0, 1, 0}, 4 * passes, significance);
    }
}

TEST_CASE("a lamp in the same medium is seen straight, beside photons through a ball of glass") {
    const Scene scene = scene_of(
        R"("glass": {"clear": {"ior": 1.5}}, "fog": {"clear": {"ior": 1, "absorption": [0.1, 0.1, 0.1], "scattering": [0.3, 0.3, 0.3]}})",
        R"({"over": [{"set": {"phase": "glass", "of": {"sphere": {"radius": 0.6}}}},
                     {"set": {"phase": "fog", "of": {"box": {"size": [8, 8, 8]}}}}]})",
        R"("lights": [{"sphere": {"centre": [0, 0, 3], "radius": 0.8, "radiance": [5, 5, 5]}}],
           "render": {"width": 64, "height": 64, "photon_radius": 2, "photons": 0.3})");
    check_against_paths(scene, {-3, -0.5f, -0.9f}, {1, 0.1f, -0.05f}, 3 * passes, 1e-4);
}

}  // namespace test_caustics_in_media
