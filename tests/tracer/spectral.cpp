// Paths of three wavelengths: colours, metals, films, media and lights against integrals over the wavelength, furnaces,
// and the same pictures by every technique.
#include <doctest/doctest.h>

#include <cmath>

#include "image/luminance.hpp"
#include "paths.hpp"
#include "photons.hpp"
#include "shading/bsdf.hpp"
#include "shading/fresnel.hpp"
#include "shading/metals.hpp"
#include "shading/thin_film.hpp"
#include "spectrum/colour_matching.hpp"
#include "spectrum/daylight.hpp"
#include "spectrum/light_spectrum.hpp"
#include "spectrum/primaries.hpp"

namespace test_spectral {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

// A scene whose paths have wavelengths. `rest` is as scene_of() has it, without "render".
Scene spectral_scene(const std::string& phases, const std::string& tree, const std::string& rest = white_environment) {
    Scene scene = scene_of(phases, tree, rest);
    scene.settings.spectral = true;
    return scene;
}

// The mean of so many samples of one pixel, whose wavelengths are spread evenly over the spectrum.
glm::dvec3 mean_of_pixel(const Scene& scene, const glm::vec3& origin, const glm::vec3& direction, int count = 1 << 14) {
    const phasetree::FlushSubnormals flush;
    const World world(scene);
    PathCounters counters;
    const Ray ray{origin, glm::normalize(direction), world.geometry().label(origin), {}};
    glm::dvec3 sum(0.0);
    for (int i = 0; i < count; ++i) {
        Sampler sampler(0, 0, static_cast<std::uint32_t>(i), 3);
        sum += glm::dvec3(trace_path(world, scene, ray, sampler, counters));
    }
    return sum / static_cast<double>(count);
}

// The colour of light that is f(λ) times D65.
template <class F>
glm::dvec3 colour_of(F&& f) {
    constexpr int count = 1 << 16;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < count; ++i) {
        const Wavelength wavelength = sampled_wavelength((static_cast<float>(i) + 0.5f) / count);
        sum += glm::dvec3(wavelength.response) * f(static_cast<double>(wavelength.nanometres), wavelength.primaries);
    }
    return sum / static_cast<double>(count);
}

// That a colour is what was expected within a part of its brightness, which an error of one per cent is not.
void check_colour(const glm::dvec3& found, const glm::dvec3& expected, double part = 0.003) {
    const double brightness = std::max({expected.x, expected.y, expected.z});
    const auto is_near = [&](const glm::dvec3& colour) { return glm::length(colour - expected) < part * brightness; };
    CAPTURE(found.x);
    CAPTURE(found.y);
    CAPTURE(found.z);
    CAPTURE(expected.x);
    CAPTURE(expected.y);
    CAPTURE(expected.z);
    CHECK(is_near(found));
    CHECK_FALSE(is_near(1.01 * found));
}

const WavelengthDistribution by_response;

const std::string ball_of_a = R"({"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}})";
// Between x = 0 and 0.5.
const std::string slab_of_a =
    R"({"set": {"phase": "a", "of": {"translate": {"by": [0.25, 0, 0], "of": {"box": {"size": [0.5, 9, 9]}}}}}})";

}  // namespace

TEST_CASE("wavelengths of a path: each is chosen as one alone would be, and white light is white") {
    glm::dvec3 white(0.0);
    constexpr int count = 3000;
    for (int i = 0; i < count; ++i) {
        const Wavelengths all = Wavelengths::three((static_cast<float>(i) + 0.5f) / count, by_response);
        white += glm::dvec3(all.to_rgb * glm::vec3(1.0f));
        for (int k = 0; k < 3; ++k) {
            // The shares of the density that are below two of them are a third apart.
            CHECK(all.nanometres[k] >= 380.0f);
            CHECK(all.nanometres[k] <= 780.0f);
            CHECK(for_light(glm::vec3(1.0f), &all)[k] == doctest::Approx(1.0f).epsilon(1e-5));
            CHECK(for_light({0, 1, 0}, &all)[k] == doctest::Approx(primaries_at(all.nanometres[k]).y).epsilon(1e-4));
        }
    }
    check_colour(white / static_cast<double>(count), glm::dvec3(1.0), 1e-3);
}

TEST_CASE("wavelengths are chosen where lights shine, and colours stay what they are") {
    const std::string bands =
        "[[430, 0], [447, 3.6], [464, 0], [536, 0], [546, 8.2], [556, 0], [601, 0], [611, 4.9], [621, 0]]";
    const auto scene_with = [&](const std::string& light) {
        return spectral_scene(R"("a": {"diffuse": {"color": [0.8, 0.3, 0.1]}})", ball_of_a,
                              R"("lights": [{"constant": {)" + light + "}}]");
    };
    const Scene in_bands = scene_with("\"spectrum\": " + bands), by_day = scene_with("");
    const World narrow(in_bands), day(by_day);
    int within = 0, by_day_within = 0;
    constexpr int count = 2000;
    const auto is_in_band = [](float nm) {
        return std::abs(nm - 447) < 17 || std::abs(nm - 546) < 10 || std::abs(nm - 611) < 10;
    };
    glm::dvec3 white(0.0);
    for (int i = 0; i < count; ++i) {
        const float u = (static_cast<float>(i) + 0.5f) / count;
        const Wavelengths all = narrow.wavelengths(u);
        white += glm::dvec3(all.to_rgb * glm::vec3(1.0f)) / double{count};
        within += is_in_band(all.hero());
        by_day_within += is_in_band(day.wavelengths(u).hero());
    }
    check_colour(white, glm::dvec3(1.0), 3e-3);
    CHECK(within > 0.6 * count);
    CHECK(by_day_within < 0.4 * count);
    const Spectrum power(
        {{430, 0}, {447, 3.6f}, {464, 0}, {536, 0}, {546, 8.2f}, {556, 0}, {601, 0}, {611, 4.9f}, {621, 0}});
    const auto relative = [&](double nm) {
        return static_cast<double>(power.at(static_cast<float>(nm))) / daylight_at(nm);
    };
    const glm::dvec3 of_lamp = colour_of([&](double nm, const glm::vec3&) { return relative(nm); });
    const double brightness = 0.2126 * of_lamp.x + 0.7152 * of_lamp.y + 0.0722 * of_lamp.z;
    const glm::vec3 paint(0.8f, 0.3f, 0.1f);
    check_colour(mean_of_pixel(in_bands, {0, -5, 0.3f}, {0, 1, 0}),
                 colour_of([&](double nm, const glm::vec3& primaries) {
                     return relative(nm) / brightness * static_cast<double>(glm::dot(primaries, paint));
                 }));
}

TEST_CASE("no lamp takes more than half of the wavelengths from the others, however violet it is") {
    for (const char* const spectrum :
         {"[[440, 0], [450, 1], [460, 0]]", "[[395, 0], [405, 1], [415, 0]]", "[[650, 0], [660, 1], [670, 0]]"}) {
        CAPTURE(spectrum);
        const Scene scene = spectral_scene(
            R"("a": {"diffuse": {"color": [1, 1, 1]}})", ball_of_a,
            R"("lights": [{"constant": {}}, {"sphere": {"centre": [0, 0, 9], "radius": 1, "radiance": [0, 0, 0], "spectrum": )" +
                std::string(spectrum) + "}}]");
        const World world(scene);
        int green = 0, green_by_response = 0;
        constexpr int count = 4000;
        for (int i = 0; i < count; ++i) {
            const float u = (static_cast<float>(i) + 0.5f) / count;
            const auto is_green = [](float nm) { return nm > 520 && nm < 580; };
            green += is_green(world.wavelengths(u).hero());
            green_by_response += is_green(Wavelengths::three(u, by_response).hero());
        }
        CHECK(green > 0.49 * green_by_response);
    }
}

TEST_CASE("lines that are narrower than a nanometre have their colour") {
    const auto colour = [](std::vector<Spectrum::Point> points) {
        return LightSpectrum(Spectrum(std::move(points))).colour();
    };
    // Of the two lines of mercury, each also as a band of 4 nm with the same power.
    const glm::vec3 narrow = colour({{435.6f, 0}, {435.8f, 1}, {436.0f, 0}, {545.8f, 0}, {546.0f, 1}, {546.2f, 0}});
    const glm::vec3 wide = colour({{433.8f, 0}, {435.8f, 1}, {437.8f, 0}, {544.0f, 0}, {546.0f, 1}, {548.0f, 0}});
    CHECK(glm::length(narrow - wide) < 0.03f * glm::length(wide));
    CHECK(narrow.z > 1.0f);
    CHECK(LightSpectrum(Spectrum({{588.4f, 0}, {588.5f, 1}, {588.6f, 0}})).visible());
    CHECK_FALSE(LightSpectrum(Spectrum({{800.0f, 0}, {801.0f, 1}})).visible());
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
             Case{R"({"conductor": {"eta": [1, 1, 1], "k": [1e6, 1e6, 1e6], "roughness": 0.3}})"},
         }) {
        CAPTURE(c.material);
        const Scene scene = spectral_scene(std::string("\"a\": ") + c.material, ball_of_a);
        check_colour(mean_of_pixel(scene, {0, -5, 0.3f}, {0.02f, 1, 0.02f}, 1 << 15), glm::dvec3(1.0), c.part);
    }
}

TEST_CASE("colours of surfaces, lights and media look as they do in red, green and blue") {
    const glm::dvec3 orange(0.8, 0.3, 0.1);
    const std::string is_orange = "[0.8, 0.3, 0.1]";
    check_colour(mean_of_pixel(spectral_scene(R"("a": {"diffuse": {"color": )" + is_orange + "}}", ball_of_a),
                               {0, -5, 0.3f}, {0, 1, 0}),
                 orange);
    check_colour(mean_of_pixel(spectral_scene(R"("a": {"diffuse": {"color": [1, 1, 1]}})", ball_of_a,
                                              R"("lights": [{"constant": {"radiance": )" + is_orange + "}}]"),
                               {0, -5, 0.3f}, {0, 1, 0}),
                 orange);
    check_colour(
        mean_of_pixel(spectral_scene(R"("a": {"glowing": {"light": )" + is_orange + "}}", ball_of_a, R"("lights": [])"),
                      {0, -5, 0.3f}, {0, 1, 0}),
        orange);
    // White light that went through the distance for which the colour is given, and through twice that: there it is
    // what is left of each wavelength, which is no product of colours.
    const auto through = [&](float distance) {
        return mean_of_pixel(
            spectral_scene(R"("a": {"clear": {"ior": 1, "color": [0.8, 0.3, 0.1], "color_distance": )" +
                               std::to_string(distance) + "}}",
                           slab_of_a),
            {-1, 0, 0}, {1, 0, 0});
    };
    check_colour(through(0.5f), orange);
    check_colour(through(0.25f), colour_of([&](double, const glm::vec3& primaries) {
                     const double left = glm::dot(glm::dvec3(primaries), orange);
                     return left * left;
                 }));
}

TEST_CASE("metals reflect each wavelength as they were measured, with an oxide too") {
    for (const char* const name : {"gold", "copper", "brass"}) {
        CAPTURE(name);
        const Metal metal = find_metal(name).value();
        const auto seen = [&](const std::string& rest) {
            return mean_of_pixel(
                spectral_scene(R"("a": {"conductor": {"metal": ")" + std::string(name) + "\"" + rest + "}}", slab_of_a),
                {-1, 0, 0}, {1, 0, 0});
        };
        check_colour(seen(""), colour_of([&](double nm, const glm::vec3&) {
                         const MetalPoint n = index_at(metal.spectrum, static_cast<float>(nm));
                         return static_cast<double>(fresnel_conductor(1.0f, n.eta, n.k));
                     }));
        check_colour(seen(R"(, "film_thickness": 250, "film_ior": 1.9)"), colour_of([&](double nm, const glm::vec3&) {
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
                const RoughConductorBsdf spectral(by_spectrum, roughness, 0.0f, &at), colours(by_colours, roughness);
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
    // They look alike either way, also where the path loses all wavelengths but one.
    const std::string phases = R"("a": {"clear": {"glass": "sf11"}}, "grey": {"diffuse": {"color": [0.5, 0.5, 0.5]}})";
    const std::string tree = R"({"over": [{"set": {"phase": "grey", "of": {"translate": {"by": [1.2, 0, 0],
        "of": {"box": {"size": [1, 9, 9]}}}}}}, )" +
                             ball_of_a + "]}";
    const Scene in_colours = scene_of(phases, tree);
    const glm::dvec3 expected = mean_of_pixel(in_colours, {-4, 0.2f, 0.4f}, {1, 0, 0}, 1 << 17);
    check_colour(mean_of_pixel(spectral_scene(phases, tree), {-4, 0.2f, 0.4f}, {1, 0, 0}, 1 << 17), expected, 0.006);
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
        check_pictures(
            [&](bool caustics) {
                Scene scene = spectral_scene(
                    R"("a": {"clear": {)" + std::string(glass) +
                        R"(}}, "floor": {"diffuse": {"color": [0.7, 0.5, 0.4]}})",
                    R"({"over": [{"set": {"phase": "floor", "of": {"translate": {"by": [0, 0, -1.7], "of": {"box": {"size": [6, 6, 1]}}}}}},
                                 )" +
                        ball_of_a + "]}",
                    R"("lights": [{"sphere": {"centre": [0.6, 0, 3], "radius": 0.4, "radiance": [20, 16, 9]}}],
                       "camera": {"position": [0, -5, 3], "look_at": [0, 0, -1], "fov": 45},
                       "render": {"width": 40, "height": 32, "samples": 128})");
                scene.settings.caustics = caustics;
                return scene;
            },
            1.03, sidak(1e-4, 2), luminance);
    }
}

TEST_CASE("measured spectra: of light, of what reflects it, and of what absorbs it") {
    // A lamp of the temperature of a light bulb, and paint that is blue in daylight and brown in its light.
    const Spectrum paint({{400, 0.05f}, {480, 0.3f}, {500, 0.5f}, {540, 0.1f}, {600, 0.1f}, {640, 0.7f}, {780, 0.9f}});
    const std::string points = "[[400, 0.05], [480, 0.3], [500, 0.5], [540, 0.1], [600, 0.1], [640, 0.7], [780, 0.9]]";
    const LightSpectrum bulb = LightSpectrum::of_temperature(2700);
    const auto bulb_at = [&](double nm) {
        constexpr double c2 = 1.438776877e7;
        return std::pow(nm, -5) / (std::exp(c2 / (2700 * nm)) - 1) / daylight_at(nm);
    };
    const auto luminance_of = [](const glm::dvec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; };
    const double unit = luminance_of(colour_of([&](double nm, const glm::vec3&) { return bulb_at(nm); }));
    const auto seen = [&](const std::string& material, const std::string& light, bool is_spectral = true) {
        Scene scene = spectral_scene("\"a\": " + material, ball_of_a, R"("lights": [{"constant": {)" + light + "}}]");
        scene.settings.spectral = is_spectral;
        return mean_of_pixel(scene, {0, -5, 0.3f}, {0, 1, 0});
    };
    const std::string white = R"({"diffuse": {"color": [1, 1, 1]}})", in_bulb = R"("spectrum": {"blackbody": 2700})";
    const std::string painted = R"({"diffuse": {"color": {"measured": {"reflectance": )" + points + "}}}}";
    const glm::dvec3 of_bulb = colour_of([&](double nm, const glm::vec3&) { return bulb_at(nm) / unit; });
    check_colour(seen(white, in_bulb), of_bulb);
    check_colour(seen(white, in_bulb, false), of_bulb);
    check_colour(seen(white, R"("radiance": [0, 2, 0], )" + in_bulb), 2 * 0.7152 * of_bulb);
    check_colour(seen(painted, ""), glm::dvec3(paint.colour()));
    check_colour(seen(painted, "", false), glm::dvec3(paint.colour()));
    check_colour(seen(painted, in_bulb), colour_of([&](double nm, const glm::vec3&) {
                     return static_cast<double>(paint.at(static_cast<float>(nm))) * bulb_at(nm) / unit;
                 }));
    // Planck's light has the colours that tables have: x and y of CIE's 1931 observer.
    const auto check_xy = [](float kelvin, double x, double y) {
        glm::dvec3 xyz(0.0);
        const LightSpectrum light = LightSpectrum::of_temperature(kelvin);
        const Wavelengths at = Wavelengths::three(0.1f, by_response);
        CHECK(light.light(glm::vec3(1.0f), &at) != light.light(glm::vec3(1.0f), nullptr));
        for (double nm = 380.5; nm < 780; ++nm)
            xyz += std::pow(nm, -5) / (std::exp(1.438776877e7 / (static_cast<double>(kelvin) * nm)) - 1) *
                   phasetree::tracer::colour_matching(nm);
        CHECK(xyz.x / (xyz.x + xyz.y + xyz.z) == doctest::Approx(x).epsilon(5e-4));
        CHECK(xyz.y / (xyz.x + xyz.y + xyz.z) == doctest::Approx(y).epsilon(5e-4));
    };
    check_xy(2856, 0.4476, 0.4074);  // CIE's illuminant A
    check_xy(6500, 0.3135, 0.3237);
    // A slab that absorbs each wavelength as it was measured.
    const Spectrum absorption({{400, 4.0f}, {560, 0.2f}, {590, 6.0f}, {610, 0.3f}, {780, 1.0f}});
    check_colour(mean_of_pixel(spectral_scene(R"("a": {"clear": {"ior": 1, "absorption_spectrum":
                                                 [[400, 4], [560, 0.2], [590, 6], [610, 0.3], [780, 1]]}})",
                                              slab_of_a),
                               {-1, 0, 0}, {1, 0, 0}),
                 colour_of([&](double nm, const glm::vec3&) {
                     return std::exp(-0.5 * static_cast<double>(absorption.at(static_cast<float>(nm))));
                 }));
    // What shines by itself: a surface, and a medium of the optical depth 1.
    const auto shining = [&](const std::string& material) {
        return mean_of_pixel(spectral_scene("\"a\": " + material, slab_of_a, R"("lights": [])"), {-1, 0, 0}, {1, 0, 0});
    };
    check_colour(shining(R"({"glowing": {"radiance": 3, "spectrum": {"blackbody": 2700}}})"), 3.0 * of_bulb);
    // One that loses nothing in red and green shines there all the same.
    for (const bool is_spectral : {false, true}) {
        Scene scene = spectral_scene(R"("a": {"clear": {"ior": 1, "absorption": [0, 0, 1e-4], "emission": [6, 6, 6],
                                        "emission_spectrum": {"blackbody": 2700}}})",
                                     slab_of_a, R"("lights": [])");
        scene.settings.spectral = is_spectral;
        check_colour(mean_of_pixel(scene, {-1, 0, 0}, {1, 0, 0}), 3.0 * of_bulb);
    }
    check_colour(shining(R"({"clear": {"ior": 1, "absorption": [2, 2, 2], "emission": [6, 6, 6],
                                       "emission_spectrum": {"blackbody": 2700}}})"),
                 3.0 * (1 - std::exp(-1.0)) * of_bulb);
}

TEST_CASE("a spectrum of which nothing is seen, as one in micrometres, is refused") {
    for (const char* const points : {"[[0.4, 1], [0.7, 0.5]]", "[[800, 1]]", "[[200, 1], [379, 0]]"}) {
        CAPTURE(points);
        CHECK_THROWS_WITH_AS(
            spectral_scene(R"("a": {"diffuse": {"color": {"measured": {"reflectance": )" + std::string(points) + "}}}}",
                           ball_of_a),
            doctest::Contains("light is from 380 to 780 nanometres"), phasetree::SceneError);
    }
}

TEST_CASE("groups of lights at infinity have their shares at each wavelength") {
    const std::string bulb = R"({"constant": {"spectrum": {"blackbody": 2700}, "group": "bulb"}})";
    const std::string sky = R"({"constant": {"radiance": [0.2, 0.4, 1], "group": "sky"}})";
    const auto scene_with = [&](const std::string& lights) {
        return spectral_scene(
            R"("a": {"clear": {"ior": 1, "absorption_spectrum": [[400, 4], [560, 0.2], [590, 6], [610, 0.3]]}})",
            slab_of_a, R"("lights": [)" + lights + "]");
    };
    const Scene both = scene_with(bulb + ", " + sky);
    const World world(both);
    PathCounters counters;
    const Ray ray{glm::vec3(-1, 0, 0), glm::vec3(1, 0, 0), world.geometry().label({-1, 0, 0}), {}};
    std::vector<glm::dvec3> groups(3);
    constexpr int count = 1 << 14;
    for (std::uint32_t i = 0; i < count; ++i) {
        Sampler sampler(0, 0, i, 3);
        PathRecord record;
        trace_path(world, both, ray, sampler, counters, &record);
        REQUIRE(record.groups.size() == groups.size());
        for (std::size_t g = 0; g < groups.size(); ++g) groups[g] += glm::dvec3(record.groups[g]) / double{count};
    }
    CHECK(groups[0] == glm::dvec3(0.0));  // that of lights without a group
    check_colour(groups[1], mean_of_pixel(scene_with(bulb), ray.origin, ray.direction));
    check_colour(groups[2], mean_of_pixel(scene_with(sky), ray.origin, ray.direction));
}

TEST_CASE("all techniques find the same light of a lamp with a spectrum, of a point too") {
    for (const char* const lamp : {R"({"sphere": {"centre": [0.6, 0, 3], "radius": 0.4, "radiance": [20, 20, 20],
                                                  "spectrum": {"blackbody": 3000}}})",
                                   R"({"rectangle": {"centre": [0.6, 0, 3], "target": [0, 0, 0], "width": 0.7,
                                       "height": 0.7, "radiance": [20, 20, 20], "spectrum": [[500, 0], [600, 2]]}})"}) {
        CAPTURE(lamp);
        check_pictures(
            [&](bool caustics) {
                Scene scene = spectral_scene(
                    R"("a": {"clear": {"ior": 1.5, "absorption_spectrum": [[450, 0], [580, 2], [620, 0]]}},
                       "floor": {"diffuse": {"color": {"measured": {"reflectance": [[450, 0.2], [650, 0.9]]}}}})",
                    R"({"over": [{"set": {"phase": "floor", "of": {"translate": {"by": [0, 0, -1.7], "of": {"box": {"size": [6, 6, 1]}}}}}},
                                 )" +
                        ball_of_a + "]}",
                    R"("lights": [)" + std::string(lamp) + R"(],
                       "camera": {"position": [0, -5, 3], "look_at": [0, 0, -1], "fov": 45},
                       "render": {"width": 40, "height": 32, "samples": 128})");
                scene.settings.caustics = caustics;
                return scene;
            },
            1.03, sidak(1e-4, 2), luminance);
    }
}

}  // namespace test_spectral
