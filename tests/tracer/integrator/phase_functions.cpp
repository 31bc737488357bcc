// Single scattering in a half-space, by paths, against quadratures over the light's directions.
//
// The medium absorbs nearly everything, so light that is scattered twice is negligible: less than 10⁻⁴ of the total. In
// a half-space z < 0 of extinction σ, a ray from the surface along d receives, from light of radiance L(l) from the
// directions l, with the phase function p,
//     σs/σ ∫ p(d·l) L(l)/(1 + |d_z|/l_z) dl.
// p is computed here from the equations, in double precision, not by the program.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "support/long_tests.hpp"
#include "tracer/support/paths.hpp"
#include "tracer/support/phase_function_equations.hpp"

namespace test_phase_functions_of_paths {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;
using phasetree::tests::draine_density;
using phasetree::tests::droplets_density;

namespace {

constexpr double full_turn = 2 * std::numbers::pi;
constexpr double albedo = 1e-5, extinction = 2;

struct Case {
    std::string text;  // of the parameter in the scene
    std::function<double(double)> density;
};

std::vector<Case> cases() {
    return {
        {R"("anisotropy": 0.7)", [](double mu) { return draine_density(0.7, 0, mu); }},
        {R"("phase_function": {"henyey_greenstein": {"g": -0.4}})",
         [](double mu) { return draine_density(-0.4, 0, mu); }},
        {R"("phase_function": {"rayleigh": {}})", [](double mu) { return draine_density(0, 1, mu); }},
        {R"("phase_function": {"draine": {"g": 0.5, "alpha": 8}})",
         [](double mu) { return draine_density(0.5, 8, mu); }},
        {R"("phase_function": {"droplets": {"diameter": 8}})", [](double mu) { return droplets_density(8, mu); }},
        {R"("phase_function": {"mix": {"first": {"droplets": {"diameter": 50}}, "second": {"mix": {"first": {"rayleigh": {}},
            "second": {"henyey_greenstein": {"g": -0.6}}, "amount": 0.25}}, "amount": 0.7}})",
         [](double mu) {
             const double backwards = 0.75 * draine_density(0, 1, mu) + 0.25 * draine_density(-0.6, 0, mu);
             return 0.3 * droplets_density(50, mu) + 0.7 * backwards;
         }},
    };
}

Scene half_space(const Case& c, const std::string& lights, Techniques techniques = Techniques::all) {
    const std::string scattering = std::to_string(albedo * extinction);
    const std::string absorption = std::to_string((1 - albedo) * extinction);
    Scene scene = scene_of(R"("fog": {"clear": {"ior": 1, "absorption": [)" + absorption + ", " + absorption + ", " +
                               absorption + R"(], "scattering": [)" + scattering + ", " + scattering + ", " +
                               scattering + "], " + c.text + "}}",
                           R"({"set": {"phase": "fog", "of": {"translate": {"by": [0, 0, -10], "of": {"box": {
                               "size": [80, 80, 20]}}}}}})",
                           R"("lights": [)" + lights + "]");
    scene.settings.techniques = techniques;
    return scene;
}

// Down into the half-space, at this angle to its surface.
glm::dvec3 downwards(double degrees) {
    const double angle = degrees * full_turn / 360;
    return {std::cos(angle), 0, -std::sin(angle)};
}

// In units of σs/σ.
double scattered(const Case& c, const glm::dvec3& d, const glm::dvec3& l) {
    return l.z > 0 ? c.density(glm::dot(d, l)) / (1 + std::abs(d.z) / l.z) : 0.0;
}

// Of light of radiance 1 from all of the hemisphere above. The polar angle is measured from the direction in which the
// path continues, where p may have a narrow peak.
double from_hemisphere(const Case& c, const glm::dvec3& d) {
    constexpr int polar = 4000, around = 500;
    const glm::dvec3 x(-d.z, 0, d.x), y(0, 1, 0);
    double sum = 0;
    for (int i = 0; i < polar; ++i) {
        const double t = (i + 0.5) / polar, height = 2 * t * t * t * t;  // 1 − μ
        const double mu = 1 - height, sine = std::sqrt(height * (2 - height));
        for (int j = 0; j < around; ++j) {
            const double phi = full_turn * (j + 0.5) / around;
            const glm::dvec3 l = mu * d + sine * (std::cos(phi) * x + std::sin(phi) * y);
            sum += scattered(c, d, l) * 8 * t * t * t / polar * full_turn / around;
        }
    }
    return sum;
}

// The number of paths, and the error that they detect.
struct Effort {
    std::uint32_t paths;
    double planted;
};
Effort effort_of(const Effort& long_form, const Effort& short_form) {
    return phasetree::tests::long_tests() ? long_form : short_form;
}

void check(const Case& c, const Scene& scene, const glm::dvec3& d, const Effort& effort, double expected,
           double significance) {
    const World world(scene);
    const glm::vec3 direction(d);
    const Moments m =
        radiance_along(world, scene, glm::vec3(0.1f, 0.2f, 0) - 0.1f * direction, direction, effort.paths)[0];
    CAPTURE(c.text);
    CAPTURE(d.z);
    CAPTURE(m.mean() / expected);
    CAPTURE(m.standard_error() / expected);
    CHECK(mean_p_value(m, expected, 2e-4 * expected) > significance);
    CHECK(mean_p_value(m, (1 + effort.planted) * expected, 2e-4 * expected) < significance);
    CHECK(mean_p_value(m, (1 - effort.planted) * expected, 2e-4 * expected) < significance);
}

}  // namespace

TEST_CASE("a small sun at many angles is scattered by the equation of each phase function") {
    const auto kinds = cases();
    const double significance = sidak(1e-4, 4 * kinds.size());
    // From nearly straight forwards to nearly straight backwards.
    const glm::dvec3 suns[] = {{1, 0.1, 0.3}, {0.3, 0.5, 0.8}, {-0.6, 0.2, 0.7}, {-1, 0, 0.3}};
    for (const Case& c : kinds)
        for (const glm::dvec3& towards : suns) {
            const glm::dvec3 d = downwards(8), l = glm::normalize(towards);
            const std::string direction =
                std::to_string(towards.x) + ", " + std::to_string(towards.y) + ", " + std::to_string(towards.z);
            const Scene scene = half_space(
                c, R"({"sun": {"direction": [)" + direction + R"(], "irradiance": [1, 1, 1], "diameter": 0.05}})");
            check(c, scene, d, effort_of({100'000, 0.01}, {6'000, 0.05}), albedo * scattered(c, d, l), significance);
        }
}

TEST_CASE("light from everywhere above is scattered the same by all techniques") {
    const auto kinds = cases();
    const double significance = sidak(1e-4, 6 * kinds.size());
    for (const Case& c : kinds)
        for (const double angle : {10.0, 60.0}) {
            const glm::dvec3 d = downwards(angle);
            const double expected = albedo * from_hemisphere(c, d);
            for (const Techniques techniques :
                 {Techniques::all, Techniques::directions_alone, Techniques::shadow_rays_alone}) {
                CAPTURE(static_cast<int>(techniques));
                // Of the directions sampled on a steep way down, few lead back up to the light.
                const Effort effort = techniques == Techniques::directions_alone
                                          ? effort_of({5'000'000, 0.03}, {120'000, 0.25})
                                          : effort_of({5'000'000, 0.01}, {40'000, 0.12});
                check(c, half_space(c, R"({"constant": {}})", techniques), d, effort, expected, significance);
            }
        }
}

TEST_CASE("one lobe with the mean cosine of droplets is not mistaken for them") {
    const Case droplets = cases()[4];
    const double g = static_cast<double>(Droplets(8).mean_cosine());
    const glm::dvec3 d = downwards(15), l = glm::normalize(glm::dvec3(-0.6, 0.2, 0.7));
    CHECK(draine_density(g, 0, glm::dot(d, l)) < 0.8 * droplets.density(glm::dot(d, l)));
}

}  // namespace test_phase_functions_of_paths
