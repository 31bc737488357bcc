// The choice between reflection and refraction by the lights in both directions: it is unbiased, a lamp's reflection in
// glass has little noise, and planes of the film are the same as with the probabilities of Fresnel's equations.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "integrator/interface_choice.hpp"
#include "tracer/support/closed_form.hpp"
#include "tracer/support/paths.hpp"

namespace test_interface_choice {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;
using phasetree::tests::Layer;
using phasetree::tests::Response;
using phasetree::tests::stack;

namespace {

// An upright pane of glass, seen 30 degrees from its normal. `lamp` is on the camera's side, where the pane mirrors it.
// Everything behind the pane is a hundred times darker.
constexpr double lamp_radiance = 10, behind_radiance = 0.1;
const double cosine = std::cos(std::numbers::pi / 6);
const glm::vec3 from(1.0f, -std::sqrt(3.0f), 0.0f);  // where the camera is, too

Scene pane(const std::string& glass, const std::string& lights, const std::string& more = "",
           const std::string& more_phases = "") {
    return scene_of(
        R"("glass": {"clear": {"ior": 1.5)" + glass + "}}" + more_phases,
        R"({"over": [{"set": {"phase": "glass", "of": {"box": {"size": [20, 0.02, 20]}}}})" + more + "]}",
        R"("lights": [)" + lights +
            R"(], "camera": {"position": [1, -1.7320508, 0], "look_at": [0, 0, 0], "fov": 0.5}, "render": {"width": 8, "height": 8})");
}
// Around the direction in which a pane reflects rays from the camera.
const std::string lamp =
    R"({"rectangle": {"centre": [-2, -3.4641016, 0], "target": [0, 0, 0], "width": 0.8, "height": 0.8, "radiance": [10, 10, 10]}})";
const std::string behind =
    R"({"rectangle": {"centre": [-2, 3.4641016, 0], "target": [0, 0, 0], "width": 3, "height": 3, "radiance": [0.1, 0.1, 0.1]}})";

}  // namespace

TEST_CASE("each outcome is as likely as the choice says, and so counts as often as by Fresnel's odds") {
    for (const char* const film : {"", R"(, "film_ior": 1.33, "film_thickness": 300)"}) {
        CAPTURE(film);
        const Scene scene = pane(film, lamp);
        const World world(scene);
        const auto surface = surface_met(world, from, -from);
        REQUIRE(surface);
        const Bsdf bsdf = surface->bsdf();
        const Frame frame = surface->frame();
        const glm::vec3 wo = frame.to_local(glm::normalize(from));
        const float f = bsdf.sample(wo, 0.0f, {})->pdf;
        constexpr int steps = 20000;
        int reflected = 0;
        double counted = 0;
        float odds = 0;
        for (int i = 0; i < steps; ++i) {
            const float u = (static_cast<float>(i) + 0.5f) / steps;
            const InterfaceChoice choice = chosen_by_lights(scene, *surface, bsdf, frame, wo, u);
            REQUIRE(choice.u_lobe >= 0.0f);
            REQUIRE(choice.u_lobe < 1.0f);
            if (bsdf.sample(wo, choice.u_lobe, {})->transmitted) continue;
            ++reflected;
            odds = choice.probability_over_fresnel;
            counted += 1 / static_cast<double>(odds);
        }
        // Only the lamp is bright, so it gets half of the probability.
        CHECK(static_cast<double>(reflected) / steps ==
              doctest::Approx(0.5 + 0.5 * static_cast<double>(f)).epsilon(1e-3));
        CHECK(odds == doctest::Approx(0.5f * (1.0f + 1.0f / f)).epsilon(1e-4));
        CHECK(counted / steps == doctest::Approx(f).epsilon(1e-3));
    }
}

TEST_CASE("what glows, and a flame, are chosen as lamps are") {
    const auto odds_with_ball_of = [](const std::string& material, const std::string& at) {
        const Scene scene = pane("", "",
                                 R"(, {"set": {"phase": "ball", "of": {"translate": {"by": )" + at +
                                     R"(, "of": {"sphere": {"radius": 0.4}}}}}})",
                                 R"(, "ball": )" + material);
        const World world(scene);
        const auto surface = surface_met(world, from, -from);
        REQUIRE(surface);
        const glm::vec3 wo = surface->frame().to_local(glm::normalize(from));
        const InterfaceChoice choice = chosen_by_lights(scene, *surface, surface->bsdf(), surface->frame(), wo, 0.0f);
        return choice.probability_over_fresnel * surface->bsdf().sample(wo, 0.0f, {})->pdf;
    };
    const std::string mirrored = "[-2, -3.4641016, 0]", behind_pane = "[-2, 3.4641016, 0]", elsewhere = "[5, -2, 5]";
    for (const char* const material : {R"({"glowing": {"radiance": 3}})",
                                       R"({"clear": {"ior": 1, "emission": [3, 2, 1], "absorption": [1, 1, 1]}})"}) {
        CAPTURE(material);
        const float f = odds_with_ball_of(material, elsewhere);
        CHECK(f == doctest::Approx(0.0415).epsilon(0.1));  // Fresnel's
        CHECK(odds_with_ball_of(material, mirrored) == doctest::Approx(0.5f + 0.5f * f).epsilon(1e-4));
        CHECK(odds_with_ball_of(material, behind_pane) == doctest::Approx(0.5f * f).epsilon(1e-4));
    }
}

TEST_CASE("where no light is seen, or all of it is reflected, the choice is Fresnel's") {
    const Scene scene = pane("", R"({"sphere": {"centre": [50, 50, 50], "radius": 0.1, "radiance": [1, 1, 1]}})");
    const World world(scene);
    const auto surface = surface_met(world, from, -from);
    REQUIRE(surface);
    const glm::vec3 wo = surface->frame().to_local(glm::normalize(from));
    const InterfaceChoice choice = chosen_by_lights(scene, *surface, surface->bsdf(), surface->frame(), wo, 0.3f);
    CHECK(choice.u_lobe == 0.3f);
    CHECK(choice.probability_over_fresnel == 1.0f);

    const Scene lit = pane("", R"({"constant": {}})");
    const World lit_world(lit);
    const auto within = surface_met(lit_world, {0, 0, 0}, {1, 0.1f, 0});
    REQUIRE(within);
    const glm::vec3 grazing = within->frame().to_local(-glm::normalize(glm::vec3(1, 0.1f, 0)));
    CHECK(chosen_by_lights(lit, *within, within->bsdf(), within->frame(), grazing, 0.7f).probability_over_fresnel ==
          1.0f);
}

TEST_CASE("a lamp in a pane is as bright as theory says, with little noise") {
    const Scene scene = pane("", lamp + "," + behind);
    const World world(scene);
    constexpr std::uint32_t samples = 400000;
    const auto found = radiance_along(world, scene, from, -from, samples)[1];
    const Response response = stack(cosine, std::array{Layer{1.5, 0, 0.02}});
    const double expected = response.reflected * lamp_radiance + response.transmitted * behind_radiance;
    CAPTURE(found.mean());
    CAPTURE(found.standard_error());
    CHECK(mean_p_value(found, expected, 1e-4 * expected) > sidak(1e-4, 2));
    CHECK(mean_p_value(found, 1.01 * expected, 1e-4 * expected) < sidak(1e-4, 2));
    // Had the path been reflected by the probabilities of Fresnel's equations alone, the relative variance would be R
    // (1 − R) (L − L')² / L̄², nearly 9, where R is the pane's reflectance, L the lamp's radiance, L' the radiance
    // behind, and L̄ their mean.
    const double variance = found.standard_error() * found.standard_error() * samples;
    CHECK(variance / (expected * expected) < 1.5);
}

TEST_CASE("planes count what is behind a pane by Fresnel's odds, however often the lamp that it mirrors is chosen") {
    // There is a wall behind the pane. On the camera's side is only the lamp, so reflected paths meet nothing.
    const Scene scene = pane(
        "", lamp,
        R"(, {"set": {"phase": "wall", "of": {"translate": {"by": [0, 3, 0], "of": {"box": {"size": [40, 1, 40]}}}}}})",
        R"(, "wall": {"diffuse": {"color": [0.5, 0.5, 0.5]}})");
    const World world(scene);
    const Ray ray{from, -glm::normalize(from), world.geometry().label(from), {}};
    PathCounters counters;
    PathRecord record;
    Moments weight, normal, in_glass, albedo;
    bool is_varied = false;
    for (std::uint32_t i = 0; i < 20000; ++i) {
        Sampler sampler(i, 0, 0, 1);
        trace_path(world, scene, ray, sampler, counters, &record, {});
        weight.add(static_cast<double>(record.weight));
        is_varied = is_varied || record.weight != 1.0f;
        const auto w = static_cast<double>(record.behind ? record.weight : 0.0f);
        normal.add(record.behind ? w * static_cast<double>(record.behind->normal.y) : 0);
        albedo.add(record.behind ? static_cast<double>(record.behind->albedo.y) : 0);
        in_glass.add(static_cast<double>(record.weight * record.lengths[1]));
        CHECK(record.weight <= PathRecord::weight_limit);
        REQUIRE(record.first);
        CHECK(record.first->albedo == glm::vec3(1.0f));
    }
    CHECK(is_varied);
    const Response response = stack(cosine, std::array{Layer{1.5, 0, 0.02}});
    const double way_through = 0.02 / phasetree::tests::cosine_within(cosine, 1.5);
    const double significance = sidak(1e-4, 4);
    CHECK(mean_p_value(weight, 1, 1e-5) > significance);
    CHECK(mean_p_value(normal, -response.transmitted, 1e-5) > significance);
    CHECK(mean_p_value(albedo, 0.5 * response.transmitted, 1e-5) > significance);
    // A share 1 − F enters. It crosses the glass once more with probability F each time, which adds up to one crossing
    // on average.
    CHECK(mean_p_value(in_glass, way_through, 1e-5) > significance);
}

TEST_CASE("what is recorded of a film in wavelengths is of the way that the path takes") {
    // If a path that is refracted into glass were recorded as reflected, its recorded albedo would be wrong by the
    // square of the index. The film's colours differ from its reflectance at the one wavelength that decides the path.
    Scene scene = pane(
        R"(, "film_ior": 2, "film_thickness": 500)", lamp,
        R"(, {"set": {"phase": "wall", "of": {"translate": {"by": [0, 3, 0], "of": {"box": {"size": [40, 1, 40]}}}}}})",
        R"(, "wall": {"diffuse": {"color": [0.5, 0.5, 0.5]}})");
    scene.settings.spectral = true;
    const World world(scene);
    const Ray ray{from, -glm::normalize(from), world.geometry().label(from), {}};
    PathCounters counters;
    PathRecord record;
    float least = 1, greatest = 1;
    int straight = 0;
    const double way_through = 0.02 / phasetree::tests::cosine_within(cosine, 1.5);
    for (std::uint32_t i = 0; i < 20000; ++i) {
        Sampler sampler(i, 0, 0, 1);
        trace_path(world, scene, ray, sampler, counters, &record, {});
        // Only paths that went straight through, because light that is reflected within the pane may be equally
        // coloured.
        if (!record.behind || static_cast<double>(record.lengths[1]) > 1.5 * way_through) continue;
        ++straight;
        const float of_wall = record.behind->albedo.y / (0.5f * record.weight);
        least = std::min(least, of_wall);
        greatest = std::max(greatest, of_wall);
    }
    CAPTURE(least);
    CAPTURE(greatest);
    CHECK(straight > 2000);
    CHECK(least > 0.7f);
    CHECK(greatest < 1.4f);
}

TEST_CASE("behind many panes that mirror a lamp, paths keep their weights within the limit, and their mean") {
    std::string panes;
    for (int i = 1; i < 12; ++i)
        panes += R"(, {"set": {"phase": "glass", "of": {"translate": {"by": [0, )" + std::to_string(0.1 * i) +
                 R"(, 0], "of": {"box": {"size": [20, 0.02, 20]}}}}}})";
    const std::string large =
        R"({"rectangle": {"centre": [-2, -3.4641016, 0], "target": [0, 0, 0], "width": 4, "height": 4, "radiance": [10, 10, 10]}})";
    const Scene scene = pane("", large, panes);
    const World world(scene);
    const Ray ray{from, -glm::normalize(from), world.geometry().label(from), {}};
    PathCounters counters;
    PathRecord record;
    Moments weight;
    float greatest = 0;
    for (std::uint32_t i = 0; i < 20000; ++i) {
        Sampler sampler(i, 0, 0, 1);
        trace_path(world, scene, ray, sampler, counters, &record, {});
        weight.add(static_cast<double>(record.weight));
        greatest = std::max(greatest, record.weight);
    }
    CHECK(greatest > 4);
    CHECK(greatest <= PathRecord::weight_limit);
    CHECK(mean_p_value(weight, 1, 1e-4) > 1e-4);
}

TEST_CASE("planes of a picture are means of what a pane mirrors and what is behind it, by Fresnel's odds") {
    // The pane would mirror the lamp if a wall did not hide it. So paths are often reflected, and meet that wall.
    const std::string walls =
        R"(, {"set": {"phase": "near", "of": {"translate": {"by": [0, 3.5, 0], "of": {"box": {"size": [40, 1, 40]}}}}}},
             {"set": {"phase": "far", "of": {"translate": {"by": [0, -8.5, 0], "of": {"box": {"size": [40, 1, 40]}}}}}})";
    const std::string hidden =
        R"({"rectangle": {"centre": [-6, -10.392305, 0], "target": [0, 0, 0], "width": 8, "height": 8, "radiance": [10, 10, 10]}})";
    for (const bool is_spectral : {false, true}) {
        CAPTURE(is_spectral);
        Scene scene = pane(
            "", hidden, walls,
            R"(, "near": {"diffuse": {"color": [0.8, 0.8, 0.8]}}, "far": {"diffuse": {"color": [0.2, 0.2, 0.2]}})");
        scene.settings.spectral = is_spectral;
        scene.settings.samples = 512;
        scene.film.planes = Planes::all();
        const World world(scene);
        const Image image = image_of(world, scene);
        const auto mean_of = [&](const std::string& name) {
            for (const Channel& channel : image.extra_channels)
                if (channel.name == name)
                    return std::accumulate(channel.values.begin(), channel.values.end(), 0.0) /
                           static_cast<double>(channel.values.size());
            FAIL("there is no channel " << name);
            return 0.0;
        };
        const Response response = stack(cosine, std::array{Layer{1.5, 0, 0.02}});
        const double mirrored = response.reflected, seen = response.transmitted;
        const double to_near = 2 + 3 / cosine, to_far = 2 + 8 / cosine;
        CHECK(mean_of("normal_behind.Y") == doctest::Approx(mirrored - seen).epsilon(0.005));
        // One half of the samples may have more of one outcome than the other half. Without weights, the difference
        // would be 0.08.
        CHECK(mean_of("half_normal_behind.Y") == doctest::Approx(mirrored - seen).epsilon(0.05));
        CHECK(mean_of("depth_behind.Z") == doctest::Approx(mirrored * to_far + seen * to_near).epsilon(0.005));
        CHECK(mean_of("length_vacuum.X") == doctest::Approx(mirrored * to_far + seen * to_near).epsilon(0.005));
        CHECK(mean_of("albedo_behind.R") == doctest::Approx(mirrored * 0.2 + seen * 0.8).epsilon(0.005));
        CHECK(mean_of("albedo.R") == 1.0);
    }
}

}  // namespace test_interface_choice
