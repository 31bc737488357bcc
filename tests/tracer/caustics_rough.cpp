// Photons that rough interfaces scatter on their way: against paths alone.
#include <doctest/doctest.h>

#include <algorithm>

#include "integrator/shadow_ray.hpp"
#include "photons.hpp"
#include "shading/frame.hpp"

namespace test_caustics_rough {

using namespace phasetree::tracer;
using phasetree::Bounds;
using namespace phasetree::tracer::tests;

namespace {

const std::string grey_floor = R"("meshes": [{"floor": {"material": {"diffuse": {"color": [0.6, 0.6, 0.6]}}}}], )";
const std::string ball = R"({"translate": {"by": [0, 0, 1.1], "of": {"sphere": {"radius": 1}}}})";

std::string in_phase(const std::string& phase, const std::string& shape) {
    return R"({"set": {"phase": ")" + phase + R"(", "of": )" + shape + "}}";
}
std::string clear(const std::string& name, double ior, double roughness, const std::string& more = "") {
    return "\"" + name + R"(": {"clear": {"ior": )" + std::to_string(ior) + R"(, "roughness": )" +
           std::to_string(roughness) + more + "}}";
}
// So many photons that they and the other techniques each have some of the weight.
std::string lit_by(const std::string& light, double photons = 0.4) {
    return R"("lights": [)" + light + R"(], "render": {"width": 64, "height": 64, "photon_radius": 2, "photons": )" +
           std::to_string(photons) + "}";
}

const std::string sun = R"({"sun": {"direction": [0.2, 0.3, 1], "irradiance": [4, 4, 4], "diameter": 60}})";
const std::string rectangle = R"({"rectangle": {"centre": [1, 1, 4], "target": [0, 0, 0], "width": 3, "height": 3,
                                  "radiance": [5, 5, 5]}})";
const glm::vec3 point_position(0.5f, 0.3f, 3);
const std::string point = R"({"point": {"position": [0.5, 0.3, 3], "intensity": 20}})";

Scene pool_of_rough_water(const std::string& light, bool in_oil = false) {
    const std::string ground =
        in_phase("ground", R"({"translate": {"by": [0, 0, -1], "of": {"box": {"size": [3, 3, 1]}}}})");
    const std::string water = in_phase("water", R"({"box": {"size": [3, 3, 2]}})");
    // Smooth oil all around, up to beyond the lamps.
    const std::string oil = in_phase("oil", R"({"box": {"size": [12, 12, 12]}})");
    return scene_of(clear("water", 1.3, 0.1) + R"(, "ground": {"diffuse": {"color": [0.2, 0.2, 0.2]}})" +
                        (in_oil ? ", " + clear("oil", 1.1, 0) : ""),
                    R"({"over": [)" + ground + ", " + water + (in_oil ? ", " + oil : "") + "]}", lit_by(light));
}

}  // namespace

TEST_CASE("behind a ball of ground glass it is as bright as by paths alone") {
    struct Case {
        std::string light;
        double roughness, photons;
        int passes;
    };
    const Case cases[] = {{sun, 0.3, 0.4, 3}, {sun, 0.8, 0.4, 7}, {rectangle, 0.1, 0.4, 3}, {point, 0.3, 3, 1}};
    const double significance = sidak(1e-4, std::size(cases));
    for (const Case& c : cases) {
        CAPTURE(c.light);
        CAPTURE(c.roughness);
        const Scene scene = scene_of(clear("glass", 1.3, c.roughness), in_phase("glass", ball),
                                     grey_floor + lit_by(c.light, c.photons));
        check_against_paths(scene, {-2, -2, 0.1f}, {1.9f, 1.9f, -0.1f}, c.passes * passes, significance);
    }
}

TEST_CASE("smooth interfaces and rough ones behind each other: as bright as by paths alone") {
    const double significance = sidak(1e-4, 2);
    const auto check = [&](const std::string& phases, const std::string& first, const std::string& second,
                           int passes_of_photons) {
        const Scene scene =
            scene_of(phases, R"({"over": [)" + first + ", " + second + "]}", grey_floor + lit_by(rectangle));
        check_against_paths(scene, {-2, -2, 0.1f}, {1.9f, 1.9f, -0.1f}, passes_of_photons, significance);
    };
    // An interface is as rough as the rougher of its sides.
    const std::string core =
        in_phase("core", R"({"translate": {"by": [0.2, 0, 1.2], "of": {"sphere": {"radius": 0.6}}}})");
    SUBCASE("a rough ball within a smooth one") {
        check(clear("shell", 1.3, 0) + ", " + clear("core", 1.6, 0.25), core, in_phase("shell", ball), 3 * passes);
    }
    SUBCASE("a smooth ball below a rough pane") {
        check(clear("pane", 1.2, 0.1) + ", " + clear("glass", 1.3, 0),
              in_phase("pane", R"({"translate": {"by": [0, 0, 2.4], "of": {"box": {"size": [3, 3, 0.2]}}}})"),
              in_phase("glass", ball), 10 * passes);
    }
}

TEST_CASE("a rough interface bends photons of one wavelength as the d line, and scales their power as that") {
    // The sun through a smooth shell that disperses strongly, onto a ball of paint within rough glass within it.
    const Scene scene = scene_of(R"("shell": {"clear": {"ior": 1.7, "abbe_number": 10}}, )" + clear("core", 1.3, 0.1) +
                                     R"(, "paint": {"diffuse": {"color": [0.5, 0.5, 0.5]}})",
                                 R"({"over": [)" + in_phase("paint", R"({"sphere": {"radius": 0.4}})") + ", " +
                                     in_phase("core", R"({"sphere": {"radius": 0.7}})") + ", " +
                                     in_phase("shell", R"({"sphere": {"radius": 1}})") + "]}",
                                 lit_by(sun));
    const World world(scene);
    const PhotonEmission emission(world, scene);
    for (const float u : {0.1f, 0.9f}) {
        CAPTURE(u);
        const Wavelength wavelength = sampled_wavelength(u);
        std::vector<float> left;
        for_each_photon(
            world, scene, emission, 3000,
            [&](const EmittedPhoton& emitted, const Photon& photon) {
                left.push_back(photon.power.x / for_light(emitted.power, &wavelength).x);
            },
            wavelength);
        REQUIRE(left.size() > 200);
        // Fresnel's odds take nothing of those that pass, and a rough interface little.
        std::ranges::nth_element(left, left.begin() + static_cast<std::ptrdiff_t>(left.size() / 2));
        CHECK(left[left.size() / 2] == doctest::Approx(1).epsilon(0.02));
    }
}

TEST_CASE("where the index is not 1, or a medium scatters, behind a rough interface: as bright as by paths alone") {
    const double significance = sidak(1e-4, 2);
    SUBCASE("the ground of rough water") {
        const Scene scene = pool_of_rough_water(sun);
        check_against_paths(scene, {-0.5f, -0.5f, 0.2f}, {0.5f, 0.5f, -0.7f}, 12 * passes, significance);
    }
    SUBCASE("a medium") {
        const Scene scene =
            scene_of(clear("murk", 1.3, 0.3, R"(, "scattering": [1, 1, 1], "absorption": [0.2, 0.2, 0.2])"),
                     in_phase("murk", ball), lit_by(rectangle));
        check_against_paths(scene, {-3, -3, 1.1f}, {1, 1, 0.05f}, 3 * passes, significance);
    }
}

TEST_CASE("a photon and a path that comes along its way backwards know the same densities") {
    struct Case {
        std::string light;
        bool in_oil;
    };
    for (const Case& c : {Case{rectangle, false}, Case{rectangle, true}, Case{point, false}, Case{point, true}}) {
        CAPTURE(c.light);
        CAPTURE(c.in_oil);
        const bool is_point = c.light == point;
        const Scene scene = pool_of_rough_water(c.light, c.in_oil);
        const World world(scene);
        const PhotonEmission emission(world, scene);
        const PhotonMap map({}, 1, 0.1f);
        PathCounters counters;
        int compared = 0;
        for_each_photon(world, scene, emission, 2000, [&](const EmittedPhoton&, const Photon& photon) {
            // Of those that the surface of the water alone scattered, once.
            const Hit hit = world.geometry().intersect({photon.position, photon.direction, photon.phase, {}}, counters);
            const Surface* surface = std::get_if<Surface>(&hit);
            REQUIRE(surface);
            const Frame frame(surface->normal);
            const glm::vec3 wo = frame.to_local(-photon.direction), wi = frame.to_local(photon.towards_light);
            if (!(wi.z < 0)) return;
            const Ray on = surface->transmitted(photon.towards_light);
            const glm::vec3 to_point = point_position - on.origin;
            LightSample light{on.direction, glm::length(to_point), glm::vec3(1), 1, OfPointLight{0}};
            if (is_point) {
                if (glm::dot(to_point / light.distance, on.direction) < 0.999999f) return;
            } else {
                const auto seen = scene.lights.area_light_seen(on.origin, on.direction, Bounds::infinity, false);
                if (!seen) return;
                light = {on.direction, seen->distance, seen->radiance, scene.lights.pdf(on.origin, on.direction),
                         seen->source};
            }
            Sampler sampler(0, 0, 0, 0);
            const Wavelength hero;
            const auto arrival = trace_shadow_ray({world, scene, {&emission, &map}, sampler, counters}, on, light,
                                                  {.hero = hero, .single = nullptr}, 1);
            REQUIRE(arrival);
            // The line density that shadow rays know is, of a point light, over n² d² already.
            const Bsdf bsdf = surface->bsdf();
            const float ior = c.in_oil ? 1.1f : 1.0f;
            const float factor = rough_factor(bsdf.reverse_pdf(wo, wi), ior, wi.z, 1.3f, wo.z);
            const float by_photons = arrival->line_density * factor / photon.line_density;
            CHECK(photon.rough.by_directions ==
                  doctest::Approx(is_point ? 0 : bsdf.pdf(wo, wi) / by_photons).epsilon(5e-3));
            CHECK(photon.rough.by_shadow_rays.value() == doctest::Approx(light.pdf / by_photons).epsilon(5e-3));
            if (!is_point) CHECK(by_photons == doctest::Approx(factor).epsilon(5e-3));
            // Of a point light, by its definition.
            const float squared = ior * ior * light.distance * light.distance;
            if (is_point) CHECK(by_photons == doctest::Approx(factor / squared).epsilon(5e-3));
            ++compared;
        });
        CHECK(compared > 20);
    }
}

}  // namespace test_caustics_rough
