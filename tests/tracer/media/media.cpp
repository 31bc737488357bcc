// Light in media, by next-event estimation and without: closed forms for a diffuse floor under a layer.
//
// E is the exponential integral's relative 2 E₃(τ) = 2 ∫ μ e^(−τ/μ) dμ, the share of diffuse light that a layer of
// optical thickness τ transmits. Reference: van de Hulst, Multiple Light Scattering, 1980; for water over a diffuse
// floor, Saunderson, J. Opt. Soc. Am. 32 (1942), 727-736, here with absorption.
#include <doctest/doctest.h>

#include "tracer/support/closed_form.hpp"
#include "tracer/support/paths.hpp"

namespace test_media {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;
using phasetree::tests::cosine_within;
using phasetree::tests::fresnel;
using phasetree::tests::integrate_cosines;

namespace {

constexpr double degree = 3.14159265358979324 / 180;

// A layer from the floor at z = 0 up to z = 1. It extends below the floor, so that the floor is inside it.
std::string layer(double width) {
    const std::string w = std::to_string(width);
    return R"({"set": {"phase": "layer", "of": {"box": {"size": [)" + w + ", " + w + ", 2]}}}}";
}

std::string floor_of(const char* albedo) {
    return std::string(R"("meshes": [{"floor": {"size": 1000, "material": {"diffuse": {"color": [)") + albedo + ", " +
           albedo + ", " + albedo + "]}}}}], ";
}

std::array<Moments, 3> seen(const Scene& scene, double angle, std::uint32_t count) {
    const World world(scene);
    const double s = std::sin(angle * degree), c = std::cos(angle * degree);
    const glm::vec3 direction(s * 0.96, s * 0.28, -c);
    const glm::vec3 origin = glm::vec3(0.1f, 0.2f, 1) - 2.0f * direction;
    return radiance_along(world, scene, origin, direction, count);
}

}  // namespace

// The two use the same random numbers: shadow rays and paths cross the block as if it were not there.
TEST_CASE("a block of the index around it casts no shadow") {
    const std::string phases = R"("layer": {"clear": {"ior": 1.0}}, "far": {"diffuse": {"color": [0.5, 0.5, 0.5]}})";
    const std::string far =
        R"({"set": {"phase": "far", "of": {"translate": {"by": [0, 0, -3], "of": {"sphere": {"radius": 1}}}}}})";
    const std::string rest =
        floor_of("0.7") +
        R"("lights": [{"constant": {}}, {"rectangle": {"centre": [2, 1, 4], "target": [0, 0, 0], "width": 1, "height": 2, "radiance": [30, 20, 10]}}])";
    const auto without = seen(scene_of(phases, far, rest), 30, 20000);
    const auto with = seen(scene_of(phases, R"({"under": [)" + far + ", " + layer(4) + "]}", rest), 30, 20000);
    for (std::size_t c = 0; c < 3; ++c) CHECK(with[c].mean() == doctest::Approx(without[c].mean()).epsilon(1e-4));
}

TEST_CASE("a medium takes its share of the light that is sampled directly") {
    const auto scene_with = [](const char* absorption) {
        return scene_of(std::string(R"("layer": {"clear": {"ior": 1.0, "absorption": )") + absorption + "}}", layer(40),
                        floor_of("0.7") + white_environment);
    };
    constexpr std::array<double, 3> absorption{0.2, 0.6, 1.2};
    const auto right = seen(scene_with("[0.2, 0.6, 1.2]"), 30, 100000);
    const auto wrong = seen(scene_with("[0.202, 0.606, 1.212]"), 30, 100000);
    const double significance = sidak(1e-4, 3);
    for (std::size_t c = 0; c < 3; ++c) {
        CAPTURE(c);
        const double passed = 2 * integrate_cosines([&](double mu) { return mu * std::exp(-absorption[c] / mu); });
        const double expected = 0.7 * passed * std::exp(-absorption[c] / std::cos(30 * degree));
        // Rays leave a mesh at an offset of 10⁻⁵ of the object's diagonal of 57, so they start that much nearer to the
        // light.
        const double rounding = 6e-4 * absorption[c] * 2 * expected;
        CHECK(std::abs(right[c].mean() / expected - 1) < 0.005);
        CHECK(mean_p_value(right[c], expected, rounding) > significance);
        CHECK(mean_p_value(wrong[c], expected, rounding) < significance);
    }
}

TEST_CASE("a diffuse floor under water: light that is refracted on its way is neither lost nor found twice") {
    constexpr double ior = 1.33, albedo = 0.8, angle = 40;
    constexpr std::array<double, 3> absorption{0, 0.1, 0.5};
    const auto scene_with = [](const char* white) {
        return scene_of(R"("layer": {"clear": {"ior": 1.33, "absorption": [0, 0.1, 0.5]}})", layer(120),
                        floor_of(white) + white_environment);
    };
    const auto right = seen(scene_with("0.8"), angle, 250000);
    const auto wrong = seen(scene_with("0.792"), angle, 250000);
    const double significance = sidak(1e-4, 3);
    for (std::size_t c = 0; c < 3; ++c) {
        CAPTURE(c);
        // Diffuse light from above that reaches the floor, over the cosine μ in vacuum; and light that leaves the floor
        // diffusely and is reflected by the surface, over the cosine μ in water.
        const double entering =
            2 * integrate_cosines([&](double mu) {
                return mu * (1 - fresnel(mu, 1, ior)) * std::exp(-absorption[c] / cosine_within(mu, ior));
            });
        const double returned = 2 * integrate_cosines([&](double mu) {
                                    return mu * fresnel(mu, ior, 1) * std::exp(-2 * absorption[c] / mu);
                                });
        const double cosine = std::cos(angle * degree);
        const double f = fresnel(cosine, 1, ior);
        // The camera receives the floor's radiance in water over η².
        const double from_floor = albedo * entering / (1 - albedo * returned) / (ior * ior) * (1 - f) *
                                  std::exp(-absorption[c] / cosine_within(cosine, ior));
        // A share of 60⁻² of the totally reflected light leaves through the sides of the layer, which are sixty depths
        // away. The offset of rays from a mesh is 0.0017 here.
        const double rounding = (3e-4 + 2e-3 * absorption[c]) * from_floor;
        CAPTURE(right[c].mean());
        CAPTURE(f + from_floor);
        CHECK(std::abs(right[c].mean() / (f + from_floor) - 1) < 0.005);
        CHECK(mean_p_value(right[c], f + from_floor, rounding) > significance);
        CHECK(mean_p_value(wrong[c], f + from_floor, rounding) < significance);
    }
}

}  // namespace test_media
