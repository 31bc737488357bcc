// Paths of three wavelengths: colours, metals, films and media against integrals over the wavelength, furnaces, and the
// same pictures with every technique.
#include <doctest/doctest.h>

#include <cmath>

#include "shading/bsdf.hpp"
#include "shading/fresnel.hpp"
#include "shading/metals.hpp"
#include "shading/thin_film.hpp"
#include "spectrum/primaries.hpp"
#include "tracer/support/spectral_pixels.hpp"

namespace test_spectral {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

TEST_CASE("wavelengths of a path: each is chosen as one alone would be, and white light is white") {
    glm::dvec3 white(0.0);
    constexpr int count = 3000;
    for (int i = 0; i < count; ++i) {
        const Wavelengths all = Wavelengths::three((static_cast<float>(i) + 0.5f) / count, by_response);
        white += glm::dvec3(all.to_rgb * glm::vec3(1.0f));
        for (int k = 0; k < 3; ++k) {
            // The cumulative distribution differs by a third from one wavelength to the next.
            CHECK(all.nanometres[k] >= 380.0f);
            CHECK(all.nanometres[k] <= 780.0f);
            CHECK(for_light(glm::vec3(1.0f), &all)[k] == doctest::Approx(1.0f).epsilon(1e-5));
            CHECK(for_light({0, 1, 0}, &all)[k] == doctest::Approx(primaries_at(all.nanometres[k]).y).epsilon(1e-4));
        }
    }
    check_colour(white / static_cast<double>(count), glm::dvec3(1.0), 1e-3);
}

TEST_CASE("spectral furnace: all kinds of surfaces and media give back what they got") {
    struct Case {
        std::string material;
        double part = 0.003;
    };
    for (const Case& c : {
             Case{R"({"clear": {"ior": 1.5}})"},
             Case{R"({"clear": {"glass": "sf11"}})"},
             Case{R"({"clear": {"ior": 1.5, "film_thickness": 400}})"},
             Case{R"({"clear": {"ior": 1.5, "roughness": 0.3}})", 0.009},
             Case{R"({"clear": {"ior": 1.5, "roughness": 0.3, "film_thickness": 400}})", 0.009},
             Case{R"({"clear": {"ior": 1.3, "scattering": [2, 2, 2]}})"},
             Case{R"({"diffuse": {"color": [1, 1, 1]}})"},
             Case{R"({"coated": {"color": [1, 1, 1], "roughness": 0.2, "film_thickness": 300}})"},
             Case{R"({"coated": {"color": [1, 1, 1], "film_thickness": 300}})"},
             Case{R"({"principled": {"base_color": [1, 1, 1], "base_metalness": 0.5, "coat_weight": 0.5,
                                     "fuzz_weight": 0.5}})"},
             Case{R"({"principled": {"base_color": [1, 1, 1], "film_thickness": 300, "film_weight": 0.5}})"},
             Case{R"({"conductor": {"eta": [1, 1, 1], "k": [1e6, 1e6, 1e6], "roughness": 0.3}})"},
         }) {
        CAPTURE(c.material);
        const Scene scene = spectral_scene(std::string("\"a\": ") + c.material, ball_of_a);
        check_colour(mean_along_ray(scene, {0, -5, 0.3f}, {0.02f, 1, 0.02f}, 1 << 15), glm::dvec3(1.0), c.part);
    }
}

TEST_CASE("colours of surfaces, lights and media look as they do in red, green and blue") {
    const glm::dvec3 orange(0.8, 0.3, 0.1);
    const std::string is_orange = "[0.8, 0.3, 0.1]";
    check_colour(mean_along_ray(spectral_scene(R"("a": {"diffuse": {"color": )" + is_orange + "}}", ball_of_a),
                                {0, -5, 0.3f}, {0, 1, 0}),
                 orange);
    check_colour(mean_along_ray(spectral_scene(R"("a": {"diffuse": {"color": [1, 1, 1]}})", ball_of_a,
                                               R"("lights": [{"constant": {"radiance": )" + is_orange + "}}]"),
                                {0, -5, 0.3f}, {0, 1, 0}),
                 orange);
    check_colour(mean_along_ray(
                     spectral_scene(R"("a": {"glowing": {"light": )" + is_orange + "}}", ball_of_a, R"("lights": [])"),
                     {0, -5, 0.3f}, {0, 1, 0}),
                 orange);
    // White light after the distance for which the colour is given, and after twice that. The latter follows from what
    // is left of each wavelength, and is not a product of colours.
    const auto through = [&](float distance) {
        return mean_along_ray(
            spectral_scene(R"("a": {"clear": {"ior": 1, "color": [0.8, 0.3, 0.1], "color_distance": )" +
                               std::to_string(distance) + "}}",
                           slab_of_a),
            {-1, 0, 0}, {1, 0, 0});
    };
    check_colour(through(0.5f), orange);
    check_colour(through(0.25f), expected_colour([&](double, const glm::vec3& primaries) {
                     const double left = glm::dot(glm::dvec3(primaries), orange);
                     return left * left;
                 }));
}

TEST_CASE("metals reflect each wavelength as they were measured, with an oxide too") {
    for (const char* const name : {"gold", "copper", "brass"}) {
        CAPTURE(name);
        const Metal metal = find_metal(name).value();
        const auto seen = [&](const std::string& rest) {
            return mean_along_ray(
                spectral_scene(R"("a": {"conductor": {"metal": ")" + std::string(name) + "\"" + rest + "}}", slab_of_a),
                {-1, 0, 0}, {1, 0, 0});
        };
        check_colour(seen(""), expected_colour([&](double nm, const glm::vec3&) {
                         const MetalPoint n = index_at(metal.spectrum, static_cast<float>(nm));
                         return static_cast<double>(fresnel_conductor(1.0f, n.eta, n.k));
                     }));
        check_colour(seen(R"(, "film_thickness": 250, "film_ior": 1.9)"),
                     expected_colour([&](double nm, const glm::vec3&) {
                         const MetalPoint n = index_at(metal.spectrum, static_cast<float>(nm));
                         return thin_film_reflectance(1.0, static_cast<double>(1.9f), static_cast<double>(n.eta),
                                                      static_cast<double>(n.k), 1.0, 250.0, nm);
                     }));
    }
}

TEST_CASE("at three wavelengths a metal is one whose red, green and blue have its index there") {
    const Metal copper = find_metal("copper").value();
    for (const float u : {0.0f, 0.2f, 0.31f}) {
        const Wavelengths at = Wavelengths::three(u, by_response);
        glm::vec3 eta, k;
        for (int i = 0; i < 3; ++i) {
            const MetalPoint index = index_at(copper.spectrum, at.nanometres[i]);
            eta[i] = index.eta;
            k[i] = index.k;
        }
        for (const float ior : {1.0f, 1.33f}) {
            const ValueRange range{0.1f, 0.5f};
            const ConductorSurface by_spectrum(ior, copper.eta, copper.k, range, {}, copper.spectrum);
            const ConductorSurface by_colours(ior, eta, k, range);
            for (const float roughness : {0.1f, 0.5f}) {
                const RoughConductorBsdf spectral(by_spectrum, roughness, {.wavelengths = &at}),
                    colours(by_colours, roughness);
                for (const float slope : {0.1f, 0.5f, 0.9f}) {
                    const glm::vec3 wo(slope, 0, std::sqrt(1 - slope * slope)),
                        wi = glm::normalize(glm::vec3(-0.3f, 0.4f, 0.7f));
                    const glm::vec3 found = spectral.evaluate(wo, wi), expected = colours.evaluate(wo, wi);
                    CHECK(spectral.pdf(wo, wi) == colours.pdf(wo, wi));
                    // The spectrum's table has a node every 5 nm, between which it is linear.
                    for (int i = 0; i < 3; ++i) CHECK(found[i] == doctest::Approx(expected[i]).epsilon(2e-3));
                }
            }
        }
    }
}

TEST_CASE("a soap film reflects each wavelength by itself, from either side") {
    const Wavelengths at = Wavelengths::three(0.27f, by_response);
    for (const auto& [from, to] : {std::pair(1.0f, 1.0f), std::pair(1.0f, 1.5f), std::pair(1.5f, 1.0f)}) {
        const DielectricSurface surface(from, to, {}, FilmOfSurface{1.33f, {420.0f, 420.0f}});
        const SmoothDielectricBsdf bsdf(surface, 420.0f, &at);
        for (const float cosine : {1.0f, 0.9f, 0.8f}) {
            const auto reflected = bsdf.sample({std::sqrt(1 - cosine * cosine), 0, cosine}, 0.0f, {});
            const auto refracted = bsdf.sample({std::sqrt(1 - cosine * cosine), 0, cosine}, 0x1.fffffep-1f, {});
            REQUIRE((reflected && refracted && !reflected->transmitted && refracted->transmitted));
            for (int i = 0; i < 3; ++i) {
                const double expected = thin_film_reflectance(static_cast<double>(from), static_cast<double>(1.33f),
                                                              static_cast<double>(to), 0.0, static_cast<double>(cosine),
                                                              420.0, static_cast<double>(at.nanometres[i]));
                CHECK(reflected->weight[i] * reflected->pdf == doctest::Approx(expected).epsilon(1e-4));
                CHECK(refracted->weight[i] * refracted->pdf * (to / from) * (to / from) ==
                      doctest::Approx(1 - expected).epsilon(1e-4));
            }
        }
    }
}

TEST_CASE("grey things behind glass that disperses: by paths of colours and of wavelengths") {
    // They look the same either way, even where the path loses all wavelengths but one.
    const std::string phases = R"("a": {"clear": {"glass": "sf11"}}, "grey": {"diffuse": {"color": [0.5, 0.5, 0.5]}})";
    const std::string tree = R"({"over": [{"set": {"phase": "grey", "of": {"translate": {"by": [1.2, 0, 0],
        "of": {"box": {"size": [1, 9, 9]}}}}}}, )" +
                             ball_of_a + "]}";
    const Scene in_colours = scene_of(phases, tree);
    const glm::dvec3 expected = mean_along_ray(in_colours, {-4, 0.2f, 0.4f}, {1, 0, 0}, 1 << 17);
    check_colour(mean_along_ray(spectral_scene(phases, tree), {-4, 0.2f, 0.4f}, {1, 0, 0}, 1 << 17), expected, 0.006);
}

TEST_CASE("albedos are recorded in colours, without the noise of wavelengths") {
    const Scene scene = spectral_scene(
        R"("a": {"clear": {"ior": 1.5, "color": [0.9, 0.5, 0.2], "color_distance": 0.5}},
           "paint": {"diffuse": {"color": [0.8, 0.3, 0.1]}})",
        R"({"over": [{"set": {"phase": "paint", "of": {"translate": {"by": [0.75, 0, 0], "of": {"box": {"size": [0.5, 9, 9]}}}}}},
                     )" +
            slab_of_a + "]}");
    const World world(scene);
    PathCounters counters;
    const glm::vec3 origin(-1, 0, 0);
    const Ray ray{origin, glm::vec3(1, 0, 0), world.geometry().label(origin), {}};
    int seen = 0;
    for (std::uint32_t i = 0; i < 32; ++i) {
        Sampler sampler(0, 0, i, 3);
        PathRecord record;
        trace_path(world, scene, ray, sampler, counters, &record);
        if (!record.behind) continue;
        ++seen;
        const glm::vec3 expected = glm::vec3(0.9f, 0.5f, 0.2f) * glm::vec3(0.8f, 0.3f, 0.1f);
        for (int c = 0; c < 3; ++c) CHECK(record.behind->albedo[c] == doctest::Approx(expected[c]).epsilon(1e-4));
    }
    CHECK(seen > 20);
}

TEST_CASE("spectral pictures are as bright with photons as by paths alone, with dispersion too") {
    for (const char* const glass :
         {R"("ior": 1.5, "color": [0.9, 0.6, 0.3], "color_distance": 0.5)", R"("glass": "sf11")"}) {
        CAPTURE(glass);
        check_ball_on_floor(R"({"clear": {)" + std::string(glass) + "}}", R"({"diffuse": {"color": [0.7, 0.5, 0.4]}})",
                            R"({"sphere": {"centre": [0.6, 0, 3], "radius": 0.4, "radiance": [20, 16, 9]}})",
                            sidak(1e-4, 2 * 2));
    }
}

}  // namespace test_spectral
