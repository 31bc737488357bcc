// Proposals for light that enters through a boundary: the density of their directions, and the sun on the ground of a
// lake, which no other technique finds.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "integrator/light_proposal.hpp"
#include "sampling/warps.hpp"
#include "shading/frame.hpp"
#include "support/uniform.hpp"
#include "tracer/support/closed_form.hpp"
#include "tracer/support/paths.hpp"

namespace test_light_proposal {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;
using phasetree::tests::chi_squared_test;
using phasetree::tests::cosine_within;
using phasetree::tests::fresnel;
using phasetree::tests::integrate_cosines;
using phasetree::tests::samples_to_detect;
using phasetree::tests::Uniform;

namespace {

constexpr double half_turn = std::numbers::pi;

}  // namespace

TEST_CASE("directions bent at a plane have the density that is said of them") {
    // In light of the same radiance from everywhere, half of the directions are uniform. In the other half, those from
    // above the plane are refracted, rings of equal height outside into rings of equal height inside, and the rest is
    // lost.
    constexpr int rings = 8, sectors = 6, beyond = rings * sectors, lost = beyond + 1;
    const glm::vec3 normal = glm::normalize(glm::vec3(0.3f, -0.5f, 0.7f));
    const Frame frame(normal);
    Lights lights;
    lights.add(InfiniteLight(ConstantEnvironment(glm::vec3(1))));
    const auto p_values = [&](double eta, double eta_of_test) {
        const LightProposal proposal(glm::vec3{0.1f, 0.2f, 0.3f}, normal, static_cast<float>(eta));
        const auto cosine_of = [&](int ring) {
            return cosine_within(1 - static_cast<double>(ring) / rings, eta_of_test);
        };
        std::vector<double> probability(lost + 1);
        for (int r = 0; r < rings; ++r)
            for (int s = 0; s < sectors; ++s)
                probability[static_cast<std::size_t>(r * sectors + s)] =
                    (0.5 * (cosine_of(r) - cosine_of(r + 1)) / 2 + 0.25 / rings) / sectors;
        probability[beyond] = 0.5 * (1 + cosine_of(rings)) / 2;
        probability[lost] = 0.25;
        const std::size_t count = samples_to_detect(1e-4, static_cast<double>(probability.size()));
        std::vector<double> observed(probability.size()), expected;
        for (const double p : probability) expected.push_back(p * static_cast<double>(count));
        Uniform random(5);
        Moments inverse;
        int others = 0;  // those whose pdf differs from that of their direction
        for (std::size_t i = 0; i < count; ++i) {
            const auto sample = proposal.sample(lights, random.two());
            inverse.add(sample ? 1 / static_cast<double>(sample->pdf) : 0);
            if (!sample) {
                ++observed[lost];
                continue;
            }
            others += sample->pdf != proposal.pdf(lights, sample->wi) || sample->radiance != glm::vec3(1);
            const glm::dvec3 local(frame.to_local(sample->wi));
            const double outside_squared = 1 - (1 - local.z * local.z) * eta_of_test * eta_of_test;
            if (local.z < 0 || outside_squared < 0) {
                ++observed[beyond];
                continue;
            }
            const int ring = std::min(static_cast<int>((1 - std::sqrt(outside_squared)) * rings), rings - 1);
            const double turn = std::atan2(local.y, local.x) / (2 * half_turn) + 0.5;
            ++observed[static_cast<std::size_t>(ring * sectors +
                                                std::min(static_cast<int>(turn * sectors), sectors - 1))];
        }
        CHECK(others == 0);
        // ∫ p · 1/p over all directions; straight ones alone also reach all of them.
        return std::array{chi_squared_test(observed, expected).p_value, mean_p_value(inverse, 4 * half_turn, 1e-3)};
    };
    for (const double eta : {1.33, 1.5, 2.4}) {
        CAPTURE(eta);
        for (const double p : p_values(eta, eta)) CHECK(p > 1e-5);
        CHECK(p_values(1.01 * eta, eta)[0] < 1e-5);
    }
}

TEST_CASE("directions bent at two planes have the density that is said of them") {
    // ∫ over an eighth of all directions, from samples whose density is computed by a proposal with other indices, or
    // by the same one.
    const glm::vec3 normal = glm::normalize(glm::vec3(0.3f, -0.5f, 0.7f));
    const glm::vec3 other = glm::normalize(glm::vec3(-0.8f, -0.4f, 0.1f));
    Lights lights;
    lights.add(InfiniteLight(ConstantEnvironment(glm::vec3(1))));
    const auto proposal_of = [&](float eta) {
        LightProposal proposal(glm::vec3{0.1f, 0.2f, 0.3f}, normal, eta);
        proposal.add_plane(normal);  // no effect
        proposal.add_plane(other);
        return proposal;
    };
    const auto least_p_value = [&](float eta, float said_eta) {
        const LightProposal proposal = proposal_of(eta), said = proposal_of(said_eta);
        std::array<Moments, 8> octants;
        double lost = 0;
        const auto count = static_cast<int>(samples_of(1'000'000));
        Uniform random(11);
        for (int i = 0; i < count; ++i) {
            const auto sample = proposal.sample(lights, random.two());
            lost += !sample;
            for (int k = 0; k < 8; ++k) {
                const glm::vec3 d = sample ? sample->wi : glm::vec3(0);
                const bool is_in = sample && k == (d.x < 0) + 2 * (d.y < 0) + 4 * (d.z < 0);
                octants[static_cast<std::size_t>(k)].add(is_in ? 1 / static_cast<double>(said.pdf(lights, sample->wi))
                                                               : 0);
            }
        }
        // Of each plane's third the half from below is.
        CHECK(std::abs(lost / count - 1.0 / 3) < 5 * std::sqrt(2.0 / 9 / count));
        double least = 1;
        for (const Moments& m : octants) least = std::min(least, mean_p_value(m, half_turn / 2, 2e-4));
        return least;
    };
    const double significance = sidak(1e-5, 8);
    CHECK(least_p_value(1.33f, 1.33f) > significance);
    CHECK(least_p_value(1.33f, 1.33f * static_cast<float>(detected(1.01))) < significance);
}

TEST_CASE("the flat sides of an object that its lamps shine on") {
    const auto found = [](const std::string& tree) {
        const Scene scene =
            scene_of(R"("water": {"clear": {"ior": 1.33}}, "ground": {"diffuse": {"color": [0.2, 0.2, 0.2]}})", tree,
                     R"("lights": [{"sun": {"direction": [0.6, -0.3, 0.8]}}, {"constant": {}}])");
        const World world(scene);
        return world.flat_boundaries();
    };
    const auto set = [](const char* of) { return R"({"set": {"phase": "water", "of": )" + std::string(of) + "}}"; };
    const auto contains = [](const auto& sides, const glm::vec3& n) {
        return std::ranges::any_of(sides, [&](const auto& side) { return glm::distance(side.normal, n) < 1e-4f; });
    };
    const auto of_cube = found(set(R"({"box": {"size": [1, 1, 1]}})"));
    CHECK(of_cube.size() == 3);
    for (const glm::vec3& n : {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, 1)})
        CHECK(contains(of_cube, n));
    for (const auto& side : of_cube) {
        const glm::vec3 extent = side.lit.extent(), across = extent * (glm::vec3(1) - glm::abs(side.normal));
        CHECK(glm::distance(side.lit.centre(), 0.5f * side.normal) < 0.06f);
        CHECK(glm::dot(across, across) > 2);
        CHECK(std::max({extent.x, extent.y, extent.z}) < 1.25f);
    }
    CHECK(found(set(R"({"sphere": {"radius": 1}})")).empty());
    const auto of_cylinder = found(set(R"({"cylinder": {"height": 3, "radius": 0.8}})"));
    CHECK(of_cylinder.size() == 1);
    CHECK(contains(of_cylinder, {0, 0, 1}));
    // Not by opaque phases.
    CHECK(found(R"({"set": {"phase": "ground", "of": {"box": {"size": [1, 1, 1]}}}})").empty());
}

TEST_CASE("the top of a lake is a flat side under a sun exactly above it") {
    // The direction to the sun is then exactly the normal of the side, and no other side faces the sun.
    const Scene scene = scene_of(R"("water": {"clear": {"ior": 1.33}})",
                                 R"({"set": {"phase": "water", "of": {"box": {"size": [4, 3, 1]}}}})",
                                 R"("lights": [{"sun": {"direction": [0, 0, 1]}}, {"constant": {}}])");
    const World world(scene);
    REQUIRE(world.flat_boundaries().size() == 1);
    CHECK(glm::distance(world.flat_boundaries()[0].normal, glm::vec3(0, 0, 1)) < 1e-4f);
}

TEST_CASE("no direction to a lamp's rim is said to be a direction to the sky") {
    // Rounding puts one direction in a few thousand beyond the edge of some lamps, depending on their directions and
    // sizes. With the sky's density, such a direction would be a hundred thousand times too bright.
    Uniform random(5);
    int near = 0, said_to_be_of_the_sky = 0;
    for (int lamp = 0; lamp < 250; ++lamp) {
        glm::vec3 normal = square_to_uniform_sphere(random.two()), towards = square_to_uniform_sphere(random.two());
        if (glm::dot(normal, towards) < 0) towards = -towards;
        const float diameter = 0.002f * std::pow(1000.0f, random());
        Lights lights;
        lights.add(InfiniteLight(Sun(towards, glm::vec3(3), diameter)));
        lights.add(InfiniteLight(ConstantEnvironment(glm::vec3(0.1f))));
        const float eta = 1.33f, cosine = glm::dot(normal, towards);
        const float within = static_cast<float>(cosine_within(static_cast<double>(cosine), 1.33));
        const glm::vec3 image = (towards - normal * cosine) / eta + normal * within;
        const LightProposal proposal(glm::vec3{0.1f, 0.2f, 0.3f}, normal, eta);
        for (int i = 0; i < static_cast<int>(samples_of(8000)); ++i) {
            const auto sample = proposal.sample(lights, random.two());
            if (!sample || glm::distance(sample->wi, image) > diameter * 0.0174533f) continue;
            ++near;
            said_to_be_of_the_sky += sample->pdf < 1;
        }
    }
    CHECK(near > static_cast<int>(samples_of(200'000)));
    CHECK(said_to_be_of_the_sky == 0);
}

namespace {

const std::string lake_phases =
    R"("water": {"clear": {"ior": 1.33}}, "ground": {"diffuse": {"color": [0.2, 0.2, 0.2]}})";

// Water up to z = 0 over ground that is rotated about (0, 0, -0.5), so wide that its ends do not matter.
std::string lake(double tilt) {
    return R"({"under": [{"set": {"phase": "water", "of": {"translate": {"by": [0, 0, -1], "of": {"box": {
        "size": [30, 30, 2]}}}}}}, {"set": {"phase": "ground", "of": {"translate": {"by": [0, 0, -0.5], "of": {"rotate": {
        "axis": [1, 0, 0], "angle": )" +
           std::to_string(tilt) +
           R"(, "of": {"translate": {"by": [0, 0, -1.5], "of": {"box": {"size": [30, 30, 3]}}}}}}}}}}]})";
}
// The sun, and a uniform sky.
std::string light(double irradiance, double sky, int depth) {
    const auto grey = [](double x) {
        return "[" + std::to_string(x) + ", " + std::to_string(x) + ", " + std::to_string(x) + "]";
    };
    return R"("lights": [{"sun": {"direction": [0.6, 0.3, 0.8], "irradiance": )" + grey(irradiance) +
           R"(}}, {"constant": {"radiance": )" + grey(sky) + R"(}}], "render": {"max_depth": )" +
           std::to_string(depth) + "}";
}
const double above = 0.8 / std::sqrt(0.36 + 0.09 + 0.64), below = cosine_within(above, 1.33);

Moments seen(const std::string& tree, const std::string& rest, std::uint32_t count) {
    const Scene scene = scene_of(lake_phases, tree, rest);
    const World world(scene);
    const glm::vec3 from(0.2f, -0.3f, -0.1f);
    return radiance_along(world, scene, from, glm::vec3(0, 0, -0.5f) - from, count)[0];
}

// Checks that the ground reflects this much light within the statistical error, and that one per cent more (two per
// cent in the short form) would be detected.
void check_light(const std::string& tree, double expected, double irradiance, double sky, int depth) {
    const Moments m = seen(tree, light(irradiance, sky, depth), samples_of(400000));
    CAPTURE(m.mean());
    CAPTURE(expected);
    CHECK(m.standard_error() < 0.22 * (detected(1.01) - 1) * expected);
    CHECK(mean_p_value(m, expected, 2e-4 * expected) > 1e-4);
    CHECK(mean_p_value(m, expected / detected(1.01), 2e-4 * expected) < 1e-4);
}
// Light of the sun alone, without reflections from the ground to itself.
void check_sun(const std::string& tree, double expected) {
    check_light(tree, expected, 3, 0, 1);
}

}  // namespace

TEST_CASE("the sun and the sky on the ground of a lake") {
    // Light that enters, and light that is reflected between the ground and the surface above it, which returns a share
    // R of diffuse light: L = ρ/π (T E cos θ + π (1 − R') L_sky) / (1 − ρ R), where R' is returned upwards.
    const double returned = integrate_cosines([](double c) { return 2 * c * fresnel(c, 1.33, 1); });
    const double returned_up = integrate_cosines([](double c) { return 2 * c * fresnel(c, 1, 1.33); });
    for (const double sky : {0.0, 0.3}) {
        CAPTURE(sky);
        const double falls = 3 * above * (1 - fresnel(above, 1, 1.33)) + half_turn * sky * (1 - returned_up);
        const double expected = 0.2 / half_turn * falls / (1 - 0.2 * returned);
        check_light(lake(0), expected, 3, sky, 4096);
    }
}

TEST_CASE("the sun on ground that is not parallel to the water above it") {
    for (const double tilt : {-25.0, 10.0, 30.0}) {
        CAPTURE(tilt);
        // The light within comes from `towards`; E cos θ T falls on the plane above, and so E cos θ T / cos θ' across.
        const glm::dvec3 sun_at = glm::normalize(glm::dvec3(0.6, 0.3, 0.8));
        const glm::dvec3 towards(sun_at.x / 1.33, sun_at.y / 1.33, below);
        const double a = tilt * half_turn / 180;
        const double facing = glm::dot(towards, glm::dvec3(0, -std::sin(a), std::cos(a)));
        const double expected = 0.2 / half_turn * 3 * above * (1 - fresnel(above, 1, 1.33)) * facing / below;
        check_sun(lake(tilt), expected);
    }
}

TEST_CASE("the sun on the ground of a lake that ends at a wall of air") {
    // Light enters through the surface above and through the wall. The result is the sum of both, each as in the
    // previous case.
    const std::string half_a_lake =
        R"({"under": [{"set": {"phase": "water", "of": {"translate": {"by": [-2.5, 0, -1], "of": {"box": {
            "size": [6, 6, 2]}}}}}}, {"set": {"phase": "ground", "of": {"translate": {"by": [-2.5, 0, -2], "of": {
            "box": {"size": [6, 6, 3]}}}}}}]})";
    const glm::dvec3 sun_at = glm::normalize(glm::dvec3(0.6, 0.3, 0.8));
    double expected = 0;
    for (const int axis : {0, 2}) {
        glm::dvec3 towards = sun_at / 1.33;
        towards[axis] = cosine_within(sun_at[axis], 1.33);
        const double enters = 3 * sun_at[axis] * (1 - fresnel(sun_at[axis], 1, 1.33));
        expected += 0.2 / half_turn * enters / towards[axis] * towards.z;
    }
    check_sun(half_a_lake, expected);
}

TEST_CASE("under curved glass and water, and lamps as bright as the sky, white paint is as bright") {
    // A furnace whose walls are partly lamps. Planes are bad guesses here, which must not matter.
    struct Case {
        std::string name, tree;
    };
    const std::string ball =
        R"({"set": {"phase": "paint", "of": {"translate": {"by": [0.3, -0.1, 0.1], "of": {"sphere": {
        "radius": 0.6}}}}}})";
    const std::string corner =
        R"({"set": {"phase": "paint", "of": {"rotate": {"axis": [1, 2, 3], "angle": 40, "of": {"box": {
        "size": [1.1, 0.9, 0.8]}}}}}})";
    const Case cases[] = {
        {"ball near the glass",
         R"({"under": [{"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}}, )" + ball + "]}"},
        {"corners in water",
         R"({"under": [{"thin_shell": {"shell": "glass", "inside": "water", "half_thickness": 0.04, "of":
            {"sphere": {"radius": 1}}}}, )" +
             corner + "]}"}};
    const double significance = sidak(1e-4, std::size(cases));
    for (const Case& c : cases) {
        CAPTURE(c.name);
        const auto p_value = [&](const char* white) {
            const std::string lamps = R"("lights": [{"constant": {}},
                {"rectangle": {"centre": [2, -3, 1], "target": [0, 0, 0], "width": 2, "height": 1.5}},
                {"rectangle": {"centre": [-3, -1, 2], "target": [0, 0, 0], "width": 1, "height": 3}},
                {"sphere": {"centre": [0.5, 0.5, 3], "radius": 0.4}}])";
            const Scene scene = scene_of(R"("water": {"clear": {"ior": 1.33}}, "glass": {"clear": {"ior": 1.5}},
                    "paint": {"diffuse": {"color": [)" +
                                             std::string(white) + ", " + white + ", " + white + "]}}",
                                         c.tree, lamps);
            const World world(scene);
            const Moments m = radiance_along(world, scene, {0.8f, -5, 0.4f}, {-0.7f, 5, -0.3f}, samples_of(200000))[0];
            CAPTURE(m.mean());
            CAPTURE(m.standard_error());
            CHECK(m.standard_error() < 0.3 * (detected(1.01) - 1));
            return mean_p_value(m, 1, 1e-5);
        };
        CHECK(p_value("1.0") > significance);
        CHECK(p_value(phasetree::tests::long_tests() ? "0.99" : "0.98") < significance);
    }
}

}  // namespace test_light_proposal
