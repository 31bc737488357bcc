// Measured spectra of lights, reflectances, absorption and emission, and the choice of wavelengths for lights.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "spectrum/colour_matching.hpp"
#include "spectrum/daylight.hpp"
#include "spectrum/light_spectrum.hpp"
#include "tracer/support/spectral_pixels.hpp"

namespace test_measured_spectra {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

TEST_CASE("wavelengths are chosen where lights shine, and colours stay what they are") {
    const std::string bands =
        "[[430, 0], [447, 3.6], [464, 0], [536, 0], [546, 8.2], [556, 0], [601, 0], [611, 4.9], [621, 0]]";
    const auto scene_with = [&](const std::string& light) {
        return spectral_scene(R"("a": {"diffuse": {"color": [0.8, 0.3, 0.1]}})", ball_of_a,
                              R"("lights": [{"constant": {)" + light + "}}]");
    };
    const Scene in_bands = scene_with("\"spectrum\": " + bands), by_day = scene_with("");
    const World lamp_world(in_bands), daylight_world(by_day);
    constexpr int count = 2000;
    const auto is_in_band = [](float nm) {
        return std::abs(nm - 447) < 17 || std::abs(nm - 546) < 10 || std::abs(nm - 611) < 10;
    };
    double share = 0, share_by_day = 0;
    glm::dvec3 white(0.0);
    for (int i = 0; i < count; ++i) {
        const float u = (static_cast<float>(i) + 0.5f) / count;
        const Wavelengths all = lamp_world.wavelengths(u);
        white += glm::dvec3(all.to_rgb * glm::vec3(1.0f)) / double{count};
        share += is_in_band(all.hero()) / double{count};
        share_by_day += is_in_band(daylight_world.wavelengths(u).hero()) / double{count};
    }
    check_colour(white, glm::dvec3(1.0), 3e-3);
    // Half of the wavelengths are chosen by the lamp, whose light is entirely in the bands, and half by the eye's
    // response.
    CHECK(std::abs(share - (0.5 + 0.5 * share_by_day)) < 0.005);
    CHECK(share_by_day < 0.4);
    const Spectrum power(
        {{430, 0}, {447, 3.6f}, {464, 0}, {536, 0}, {546, 8.2f}, {556, 0}, {601, 0}, {611, 4.9f}, {621, 0}});
    const auto relative = [&](double nm) {
        return static_cast<double>(power.at(static_cast<float>(nm))) / daylight_at(nm);
    };
    const glm::dvec3 of_lamp = expected_colour([&](double nm, const glm::vec3&) { return relative(nm); });
    const double brightness = 0.2126 * of_lamp.x + 0.7152 * of_lamp.y + 0.0722 * of_lamp.z;
    const glm::vec3 paint(0.8f, 0.3f, 0.1f);
    check_colour(mean_along_ray(in_bands, {0, -5, 0.3f}, {0, 1, 0}),
                 expected_colour([&](double nm, const glm::vec3& primaries) {
                     return relative(nm) / brightness * static_cast<double>(glm::dot(primaries, paint));
                 }));
}

TEST_CASE("a lamp of one narrow band takes a quarter of the wavelengths from a white light beside it") {
    for (const char* const spectrum :
         {"[[440, 0], [450, 1], [460, 0]]", "[[395, 0], [405, 1], [415, 0]]", "[[650, 0], [660, 1], [670, 0]]"}) {
        CAPTURE(spectrum);
        // The lamp is black, because the choice of wavelengths depends on its spectrum alone.
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
        // Half of the wavelengths are chosen by the lights, and half of these by the lamp.
        CHECK(std::abs(green / (0.75 * green_by_response) - 1) < 0.01);
    }
}

TEST_CASE("lines that are narrower than a nanometre have their colour") {
    const auto colour = [](std::vector<Spectrum::Point> points) {
        return LightSpectrum(Spectrum(std::move(points))).colour();
    };
    // These are the two lines of mercury, 0.4 nm wide, and the same as bands ten times as wide. Only the shape of a
    // spectrum counts, so their colours differ by no more than the eye's response varies within a band.
    const glm::vec3 narrow = colour({{435.6f, 0}, {435.8f, 1}, {436.0f, 0}, {545.8f, 0}, {546.0f, 1}, {546.2f, 0}});
    const glm::vec3 wide = colour({{433.8f, 0}, {435.8f, 1}, {437.8f, 0}, {544.0f, 0}, {546.0f, 1}, {548.0f, 0}});
    CHECK(glm::length(narrow - wide) < 0.03f * glm::length(wide));
    CHECK(narrow.z > 1.0f);  // The brightness is 1, and the blue line makes it bluer than white.
    CHECK(LightSpectrum(Spectrum({{588.4f, 0}, {588.5f, 1}, {588.6f, 0}})).visible());
    CHECK_FALSE(LightSpectrum(Spectrum({{800.0f, 0}, {801.0f, 1}})).visible());
}

namespace {

const std::string in_bulb = R"("spectrum": {"blackbody": 2700})";

// Planck's law for a light bulb, in arbitrary units, over daylight.
double bulb_over_daylight(double nm) {
    constexpr double c2 = 1.438776877e7;  // Planck's second radiation constant, in nm K
    return std::pow(nm, -5) / (std::exp(c2 / (2700 * nm)) - 1) / daylight_at(nm);
}

double bulb_of_unit_luminance(double nm) {
    static const double unit = [] {
        const glm::dvec3 colour = expected_colour([](double at, const glm::vec3&) { return bulb_over_daylight(at); });
        return glm::dot(colour, glm::dvec3(0.2126, 0.7152, 0.0722));
    }();
    return bulb_over_daylight(nm) / unit;
}

glm::dvec3 colour_of_bulb() {
    return expected_colour([](double nm, const glm::vec3&) { return bulb_of_unit_luminance(nm); });
}

}  // namespace

TEST_CASE("lamps and paint of measured spectra have the colours of the integral over the wavelengths") {
    // The paint reflects a band of blue-green and all deep red: it is a dull pink in daylight and red by a light bulb.
    const Spectrum paint({{400, 0.05f}, {480, 0.3f}, {500, 0.5f}, {540, 0.1f}, {600, 0.1f}, {640, 0.7f}, {780, 0.9f}});
    const std::string points = "[[400, 0.05], [480, 0.3], [500, 0.5], [540, 0.1], [600, 0.1], [640, 0.7], [780, 0.9]]";
    const auto seen = [&](const std::string& material, const std::string& light, bool is_spectral = true) {
        Scene scene = spectral_scene("\"a\": " + material, ball_of_a, R"("lights": [{"constant": {)" + light + "}}]");
        scene.settings.spectral = is_spectral;
        return mean_along_ray(scene, {0, -5, 0.3f}, {0, 1, 0});
    };
    const std::string white = R"({"diffuse": {"color": [1, 1, 1]}})";
    const std::string painted = R"({"diffuse": {"color": {"measured": {"reflectance": )" + points + "}}}}";
    check_colour(seen(white, in_bulb), colour_of_bulb());
    check_colour(seen(white, in_bulb, false), colour_of_bulb());
    check_colour(seen(white, R"("radiance": [0, 2, 0], )" + in_bulb), 2 * 0.7152 * colour_of_bulb());
    check_colour(seen(painted, ""), glm::dvec3(paint.colour()));
    check_colour(seen(painted, "", false), glm::dvec3(paint.colour()));
    check_colour(seen(painted, in_bulb), expected_colour([&](double nm, const glm::vec3&) {
                     return static_cast<double>(paint.at(static_cast<float>(nm))) * bulb_of_unit_luminance(nm);
                 }));
}

TEST_CASE("Planck's light has the chromaticities of CIE's tables") {
    struct Case {
        float kelvin;
        double x, y;  // of CIE's 1931 observer
    };
    for (const Case& c : {Case{2856, 0.4476, 0.4074},  // CIE's illuminant A
                          Case{6500, 0.3135, 0.3237}}) {
        CAPTURE(c.kelvin);
        const LightSpectrum light = LightSpectrum::of_temperature(c.kelvin);
        glm::dvec3 xyz(0.0);
        for (double nm = 380.5; nm < 780; ++nm)
            xyz += static_cast<double>(light.relative_at(static_cast<float>(nm))) * daylight_at(nm) *
                   phasetree::tracer::colour_matching(nm);
        const double sum = xyz.x + xyz.y + xyz.z;
        CHECK(std::abs(xyz.x / sum - c.x) < 2e-4);
        CHECK(std::abs(xyz.y / sum - c.y) < 2e-4);
    }
}

TEST_CASE("a slab absorbs each wavelength as it was measured") {
    const Spectrum absorption({{400, 4.0f}, {560, 0.2f}, {590, 6.0f}, {610, 0.3f}, {780, 1.0f}});
    check_colour(mean_along_ray(spectral_scene(R"("a": {"clear": {"ior": 1, "absorption_spectrum":
                                                  [[400, 4], [560, 0.2], [590, 6], [610, 0.3], [780, 1]]}})",
                                               slab_of_a),
                                {-1, 0, 0}, {1, 0, 0}),
                 expected_colour([&](double nm, const glm::vec3&) {
                     return std::exp(-0.5 * static_cast<double>(absorption.at(static_cast<float>(nm))));
                 }));
}

TEST_CASE("surfaces and media that shine have the colour of their temperature") {
    const auto shining = [&](const std::string& material, bool is_spectral = true) {
        Scene scene = spectral_scene("\"a\": " + material, slab_of_a, R"("lights": [])");
        scene.settings.spectral = is_spectral;
        return mean_along_ray(scene, {-1, 0, 0}, {1, 0, 0});
    };
    check_colour(shining(R"({"glowing": {"radiance": 3, )" + in_bulb + "}}"), 3.0 * colour_of_bulb());
    const std::string emission = R"(, "emission": [6, 6, 6], "emission_spectrum": {"blackbody": 2700}}})";
    // The slab is half a metre thick, with 6 per metre. Its absorption is invisible, but makes blue a different case
    // from red and green, of which nothing is absorbed.
    for (const bool is_spectral : {false, true})
        check_colour(shining(R"({"clear": {"ior": 1, "absorption": [0, 0, 1e-4])" + emission, is_spectral),
                     3.0 * colour_of_bulb());
    // Its optical depth is 1, and deep in such a medium the radiance is emission over absorption, 3.
    check_colour(shining(R"({"clear": {"ior": 1, "absorption": [2, 2, 2])" + emission),
                 3.0 * (1 - std::exp(-1.0)) * colour_of_bulb());
}

TEST_CASE("a spectrum of which nothing is seen, as one in micrometres, is rejected") {
    for (const char* const points : {"[[0.4, 1], [0.7, 0.5]]", "[[800, 1]]", "[[200, 1], [379, 0]]"}) {
        CAPTURE(points);
        CHECK_THROWS_WITH_AS(
            spectral_scene(R"("a": {"diffuse": {"color": {"measured": {"reflectance": )" + std::string(points) + "}}}}",
                           ball_of_a),
            doctest::Contains("visible light ranges from 380 to 780 nanometres"), phasetree::SceneError);
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
    check_colour(groups[1], mean_along_ray(scene_with(bulb), ray.origin, ray.direction));
    check_colour(groups[2], mean_along_ray(scene_with(sky), ray.origin, ray.direction));
}

TEST_CASE("a picture by a lamp with a spectrum is as bright with photons as by paths alone") {
    for (const char* const lamp : {R"({"sphere": {"centre": [0.6, 0, 3], "radius": 0.4, "radiance": [20, 20, 20],
                                                  "spectrum": {"blackbody": 3000}}})",
                                   R"({"rectangle": {"centre": [0.6, 0, 3], "target": [0, 0, 0], "width": 0.7,
                                       "height": 0.7, "radiance": [20, 20, 20], "spectrum": [[500, 0], [600, 2]]}})"}) {
        CAPTURE(lamp);
        check_ball_on_floor(R"({"clear": {"ior": 1.5, "absorption_spectrum": [[450, 0], [580, 2], [620, 0]]}})",
                            R"({"diffuse": {"color": {"measured": {"reflectance": [[450, 0.2], [650, 0.9]]}}}})", lamp,
                            sidak(1e-4, 2 * 2));
    }
}

}  // namespace test_measured_spectra
