// Photons that rough interfaces scatter: their power, their density, and the densities of paths that they record.
#include <doctest/doctest.h>

#include <algorithm>

#include "integrator/shadow_ray.hpp"
#include "sampling/warps.hpp"
#include "shading/frame.hpp"
#include "tracer/caustics/photons.hpp"
#include "tracer/caustics/rough_scenes.hpp"

namespace test_rough_photons {

using namespace phasetree::tracer;
using phasetree::Bounds;
using namespace phasetree::tracer::tests;

namespace {

// The rough surface of water that scattered a photon last, for a path that follows the photon backwards from the
// ground: it arrives from wo, continues to wi, and then sends the shadow ray.
struct ChainEnd {
    Bsdf bsdf;
    glm::vec3 wo, wi;
    Ray shadow;
};

// nullopt if the photon was scattered more than once, or was not refracted there.
std::optional<ChainEnd> chain_end(const World& world, const Photon& photon, const EmittedPhoton& emitted,
                                  PathCounters& counters) {
    const Hit hit = world.geometry().intersect({photon.position, photon.direction, photon.phase, {}}, counters);
    const Surface* surface = std::get_if<Surface>(&hit);
    REQUIRE(surface);
    const Frame frame(surface->normal);
    const glm::vec3 wi = frame.to_local(photon.towards_light);
    if (!(wi.z < 0)) return std::nullopt;
    const Ray shadow = surface->transmitted(photon.towards_light);
    // The photon's own line leads there if nothing else was in the way.
    const glm::vec3 off = shadow.origin - emitted.ray.origin;
    if (glm::length(glm::cross(off, emitted.ray.direction)) > 1e-3f) return std::nullopt;
    return ChainEnd{surface->bsdf(), frame.to_local(-photon.direction), wi, shadow};
}

// R of rough_chain.hpp, written out.
float factor_of(const ChainEnd& end, float light_ior) {
    const float etendue = light_ior * light_ior * std::abs(end.wi.z) / (ior_of_water * ior_of_water * end.wo.z);
    return end.bsdf.reverse_pdf(end.wo, end.wi) * etendue;
}

doctest::Approx nearly(float v) {
    return doctest::Approx(v).epsilon(5e-3).scale(0);
}

}  // namespace

TEST_CASE("a rough interface scales the power of photons of one wavelength by the indices of the d line") {
    // The sun through a smooth shell that disperses strongly, onto a ball of paint within rough glass within it.
    const Scene scene = scene_of(R"("shell": {"clear": {"ior": 1.7, "abbe_number": 10}}, )" + clear("core", 1.3, 0.1) +
                                     R"(, "paint": {"diffuse": {"color": [0.5, 0.5, 0.5]}})",
                                 R"({"over": [)" + in_phase("paint", R"({"sphere": {"radius": 0.4}})") + ", " +
                                     in_phase("core", R"({"sphere": {"radius": 0.7}})") + ", " +
                                     in_phase("shell", R"({"sphere": {"radius": 1}})") + "]}",
                                 lit_by(sun));
    const World world(scene);
    const PhotonEmission emission(world, scene);
    for (const float u : {0.02f, 0.98f}) {
        CAPTURE(u);
        const Wavelengths wavelength = Wavelengths::of_dispersed_colours(sampled_wavelength(u));
        std::vector<float> left;
        for_each_photon(
            world, scene, emission, 3000,
            [&](const EmittedPhoton& emitted, const Photon& photon) {
                left.push_back(photon.power.x / for_light(emitted.power, &wavelength).x);
            },
            wavelength);
        REQUIRE(left.size() > 200);
        // The choice by Fresnel's equations has weight 1, and a rough interface has a weight near 1.
        std::ranges::nth_element(left, left.begin() + static_cast<std::ptrdiff_t>(left.size() / 2));
        CHECK(left[left.size() / 2] == doctest::Approx(1).epsilon(0.01).scale(0));
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
        // Shadow rays ask for line densities only if there are photons.
        const PhotonMap map({}, 1, 0.1f);
        PathCounters counters;
        int compared = 0;
        for_each_photon(world, scene, emission, 2000, [&](const EmittedPhoton& emitted, const Photon& photon) {
            const auto end = chain_end(world, photon, emitted, counters);
            if (!end) return;
            const float distance = glm::length(point_position - end->shadow.origin);
            LightSample light{end->shadow.direction, distance, glm::vec3(1), 1, OfPointLight{0}};
            if (!is_point) {
                const auto seen =
                    scene.lights.area_light_seen(end->shadow.origin, end->shadow.direction, Bounds::infinity, false);
                REQUIRE(seen);
                light = {end->shadow.direction, seen->distance, seen->radiance,
                         scene.lights.pdf(end->shadow.origin, end->shadow.direction), seen->source};
            }
            Sampler sampler(0, 0, 0, 0);
            const auto arrival =
                trace_shadow_ray({world, scene, {&emission, &map}, sampler, counters}, end->shadow, light, {}, 1);
            REQUIRE(arrival.light);
            // For a point light, the line density of a shadow ray is q/(n'² d²), and that of the photon is q.
            const float light_ior = c.in_oil ? ior_of_oil : 1;
            const float by_photons = arrival.light->line_density * factor_of(*end, light_ior) / photon.line_density;
            if (is_point)
                CHECK(photon.quotients.by_directions == 0.0f);
            else
                CHECK(photon.quotients.by_directions == nearly(end->bsdf.pdf(end->wo, end->wi) / by_photons));
            CHECK(photon.quotients.by_shadow_rays.value() == nearly(light.pdf / by_photons));
            const float divided_by = is_point ? light_ior * light_ior * distance * distance : 1;
            CHECK(by_photons == nearly(factor_of(*end, light_ior) / divided_by));
            ++compared;
        });
        CHECK(compared > 20);
    }
}

// The sum of 1/density over the photons in a region is an estimate of the region's size. So is the mean of 1/pdf over
// directions that are sampled from the points where they fall. The two agree only if the density of photons is correct.
// The region is a square of the ground, all directions, and those lamp directions for which the density is not tiny.
// (Otherwise a few photons would dominate the sum.)
TEST_CASE("photons behind a rough interface are as dense as their density says") {
    const Scene scene = pool_of_rough_water(rectangle, false, 0.6);
    const World world(scene);
    const PhotonEmission emission(world, scene);
    constexpr float half_side = 0.4f, height = -0.5f;
    constexpr std::uint32_t count = 3000000;
    // The density of photons by area, direction and direction to the lamp, over their number.
    const auto density_of = [&](const ChainEnd& end, float cosine) {
        const float line = emission.line_density(end.shadow.origin, end.shadow.direction, end.shadow.phase);
        const float density = ior_of_water * ior_of_water * cosine * line * factor_of(end, 1);
        return density > 1e-2f ? density : 0.0f;
    };
    PathCounters counters;
    Moments by_photons;
    double sum = 0;
    const auto photons = [&](const EmittedPhoton& emitted, const Photon& photon) {
        const glm::vec3& p = photon.position;
        if (std::abs(p.x) > half_side || std::abs(p.y) > half_side || std::abs(p.z - height) > 1e-3f) return;
        const auto end = chain_end(world, photon, emitted, counters);
        const float density = end ? density_of(*end, photon.direction.z) : 0.0f;
        if (density > 0) sum += 1 / static_cast<double>(density);
    };
    constexpr std::uint32_t batches = 100;
    for (std::uint32_t batch = 0; batch < batches; ++batch) {
        sum = 0;
        for_each_photon(world, scene, emission, count / batches, photons, {}, batch);
        by_photons.add(sum / (count / batches));
    }
    Moments by_directions;
    for (std::uint32_t i = 0; i < 400000; ++i) {
        Sampler sampler(i & 0xffffu, i >> 16, 1, 5);
        const glm::vec2 u = sampler.next2();
        const glm::vec3 ground(half_side * (2 * u.x - 1), half_side * (2 * u.y - 1), height + 1e-4f);
        const glm::vec3 direction = square_to_cosine_hemisphere(sampler.next2());
        double size = 0;
        const Hit hit = world.geometry().intersect({ground, direction, phasetree::Phase{1}, {}}, counters);
        if (const Surface* surface = std::get_if<Surface>(&hit); surface && surface->far_side) {
            const auto light = scene.lights.sample(surface->far_side->origin, sampler.next2());
            const Frame frame(surface->normal);
            const glm::vec3 wi = light ? frame.to_local(light->wi) : glm::vec3(0, 0, 1);
            if (wi.z < 0) {
                const ChainEnd end{surface->bsdf(), frame.to_local(-direction), wi, surface->transmitted(light->wi)};
                if (density_of(end, direction.z) > 0)
                    size = 4 * half_side * half_side * std::numbers::pi / static_cast<double>(direction.z * light->pdf);
            }
        }
        by_directions.add(size);
    }
    const double error = std::hypot(by_photons.standard_error(), by_directions.standard_error());
    CAPTURE(by_photons.mean() / by_directions.mean());
    CAPTURE(error / by_directions.mean());
    const auto p_value = [&](double factor) {
        return phasetree::tests::normal_two_sided((factor * by_photons.mean() - by_directions.mean()) / error);
    };
    CHECK(p_value(1) > 1e-4);
    CHECK(p_value(1.1) < 1e-4);
}

}  // namespace test_rough_photons
