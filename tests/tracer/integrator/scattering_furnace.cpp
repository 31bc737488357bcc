// The white furnace of media that scatter and do not absorb: in light of radiance 1 from everywhere, they are
// invisible. Also, shadow rays and sampled directions find the same light, each alone.
//
// Where directions alone find the light, each path has the value 1, whatever happens to it: in every channel if all are
// equal, otherwise in the mean of the channels. So a few samples show exactly whether any light is lost or found twice.
// With shadow rays, only the mean over paths is 1.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "phasetree_support/temporary_directory.hpp"
#include "support/long_tests.hpp"
#include "tracer/support/paths.hpp"

namespace test_scattering_furnace {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

const bool long_form = phasetree::tests::long_tests();

const std::string ball = R"({"set": {"phase": "milk", "of": {"sphere": {"radius": 1}}}})";
// In exact contact with its glass, and half full: above the milk is vacuum.
const std::string glass =
    R"({"intersect_shape": {"phases": "milk", "shape": {"plane": {"normal": [0.1, 0.05, 1], "offset": 0.15}},
    "of": {"thin_shell": {"shell": "glass", "inside": "milk", "half_thickness": 0.04, "of": {"sphere": {"radius": 1}}}}}})";

std::string phases(const std::string& milk) {
    return R"("glass": {"clear": {"ior": 1.5}}, "milk": {"clear": {)" + milk + "}}";
}

struct Case {
    std::string name, milk, tree;
    bool is_grey;
};

const std::string cloud =
    R"("density": {"displace": {"amplitude": 0.1, "scale": 0.4, "of": {"sphere": {"radius": 0.9}}}}, "density_depth": 0.3)";

// Most of it is empty, and blocks of its voxels are of different densities.
const std::string& smoke() {
    static const phasetree::support::TemporaryDirectory folder;
    static const std::string grid = [] {
        for (int layer = 0; layer < 20; ++layer) {
            std::string image = "P5 20 20 255\n";
            for (int i = 0; i < 400; ++i) {
                const int x = i % 20, y = i / 20;
                const bool is_empty = (x / 5 + y / 5 + layer / 5) % 3 == 0;
                image +=
                    static_cast<char>(is_empty ? 0 : 10 + (37 * x + 91 * y + 53 * layer) % (layer < 10 ? 60 : 240));
            }
            phasetree::support::write_text(folder / fmt::format("smoke_{:02}.pgm", layer), image);
        }
        return fmt::format(
            R"("density_grid": {{"file": "{}", "spacing": [0.09, 0.09, 0.09], "rotate_z": 20, "factor": 2}})",
            (folder / "smoke_##.pgm").string());
    }();
    return grid;
}

const Case cases[] = {
    {"isotropic", R"("ior": 1, "scattering": [3, 3, 3])", ball, true},
    {"forwards", R"("ior": 1, "scattering": [8, 8, 8], "anisotropy": 0.9)", ball, true},
    {"backwards, an index of its own", R"("ior": 1.35, "scattering": [3, 3, 3], "anisotropy": -0.5)", ball, true},
    {"droplets", R"("ior": 1, "scattering": [8, 8, 8], "phase_function": {"droplets": {"diameter": 15}})", ball, true},
    {"a mix in a glass", R"("ior": 1.35, "scattering": [4, 4, 4], "phase_function": {"mix": {"first": {"rayleigh": {}},
                            "second": {"draine": {"g": -0.6, "alpha": 3}}, "amount": 0.7}})",
     glass, true},
    {"in a glass", R"("ior": 1.35, "scattering": [4, 4, 4], "anisotropy": 0.3)", glass, true},
    {"of varying density", R"("ior": 1, "scattering": [9, 9, 9], )" + cloud, ball, true},
    {"of varying density in a glass", R"("ior": 1.35, "scattering": [9, 9, 9], )" + cloud, glass, true},
    {"of voxels", R"("ior": 1, "scattering": [9, 9, 9], )" + smoke(), ball, true},
    {"colours of voxels in a glass", R"("ior": 1.35, "scattering": [1, 3, 9], )" + smoke(), glass, false},
    {"colours", R"("ior": 1, "scattering": [0.5, 2, 6])", ball, false},
    {"colours of varying density in a glass", R"("ior": 1.35, "scattering": [1, 3, 9], )" + cloud, glass, false},
};

const glm::vec3 from(0.3f, -4, 0.2f), towards(-0.06f, 1, -0.07f);

}  // namespace

TEST_CASE("furnace: paths through what scatters and absorbs nothing are worth 1, each") {
    const phasetree::FlushSubnormals flush;
    const std::uint32_t count = long_form ? 200000 : 1000;
    const auto farthest_from_1 = [&](const Case& c, const std::string& further) {
        Scene scene = scene_of(phases(c.milk + further), c.tree);
        scene.settings.techniques = Techniques::directions_alone;
        const World world(scene);
        const Ray ray{from, glm::normalize(towards), world.geometry().label(from), {}};
        PathCounters counters;
        double farthest = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            Sampler sampler(i & 0xffffu, i >> 16, 0, 1);
            const glm::dvec3 radiance(trace_path(world, scene, ray, sampler, counters));
            farthest = std::max(farthest, std::abs((radiance.x + radiance.y + radiance.z) / 3 - 1));
            if (!c.is_grey) continue;
            for (int channel = 0; channel < 3; ++channel)
                farthest = std::max(farthest, std::abs(radiance[channel] - 1));
        }
        return farthest;
    };
    for (const Case& c : cases) {
        CAPTURE(c.name);
        CHECK(farthest_from_1(c, "") < 0.001);
    }
    // A medium that absorbs a thousandth of what it scatters is detected.
    CHECK(farthest_from_1(cases[0], R"(, "absorption": [0.003, 0.003, 0.003])") > 0.001);
}

TEST_CASE("furnace: so are paths through two objects of one such phase that touch") {
    const phasetree::FlushSubnormals flush;
    const auto farthest_from_1 = [](const std::string& medium) {
        const std::string box = R"("of": {"box": {"size": [1, 1, 1]}}}}}})";
        Scene scene = read_scene(phasetree::Document::from_text(
            R"({"version": 1, "phases": {"m": {"clear": {)" + medium + R"(}}}, "objects": [
                {"name": "a", "tree": {"set": {"phase": "m", "of": {"translate": {"by": [-0.5, 0, 0], )" +
                box + R"(},
                {"name": "b", "tree": {"set": {"phase": "m", "of": {"translate": {"by": [0.5, 0, 0], )" +
                box + "}], " + white_environment + R"(, "camera": {"position": [0, -5, 0], "look_at": [0, 0, 0]}})",
            "test.json"));
        scene.settings.techniques = Techniques::directions_alone;
        const World world(scene);
        const Ray ray{from, glm::normalize(towards), phasetree::vacuum, {}};
        PathCounters counters;
        double farthest = 0;
        for (std::uint32_t i = 0; i < 1000; ++i) {
            Sampler sampler(i, 0, 0, 1);
            const glm::dvec3 radiance(trace_path(world, scene, ray, sampler, counters));
            farthest = std::max(farthest, std::abs((radiance.x + radiance.y + radiance.z) / 3 - 1));
        }
        return farthest;
    };
    CHECK(farthest_from_1(R"("ior": 1, "scattering": [1, 1, 1])") < 0.001);
    CHECK(farthest_from_1(R"("ior": 1.5, "scattering": [2, 2, 2])") < 0.001);
}

TEST_CASE("furnace: with shadow rays, and with colours, the mean is 1") {
    const double significance = sidak(1e-4, 3 * std::size(cases));
    for (const Case& c : cases) {
        CAPTURE(c.name);
        const Scene scene = scene_of(phases(c.milk), c.tree);
        const World world(scene);
        const auto right = radiance_along(world, scene, from, towards, long_form ? 400000 : 8000);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            CAPTURE(channel);
            CAPTURE(right[channel].mean());
            CAPTURE(right[channel].standard_error());
            CHECK(mean_p_value(right[channel], 1, 2e-5) > significance);
        }
    }
}

TEST_CASE("shadow rays alone, sampled directions alone, and both find the same light") {
    const std::string lights = R"("lights": [{"constant": {"radiance": [0.2, 0.3, 0.4]}},
        {"sphere": {"centre": [2, -1, 2], "radius": 0.8, "radiance": [6, 5, 4]}},
        {"rectangle": {"centre": [-2, 0, 1.5], "target": [0, 0, 0], "width": 2, "height": 2, "radiance": [3, 4, 5]}}])";
    const std::string murky[] = {
        R"("ior": 1.35, "scattering": [2, 3, 4], "absorption": [0.3, 0.1, 0.6], "phase_function": {"mix": {
           "first": {"draine": {"g": 0.6, "alpha": 3}}, "second": {"draine": {"g": -0.5, "alpha": 2}}, "amount": 0.4}})",
        R"("ior": 1.35, "scattering": [2, 3, 4], "absorption": [0.3, 0.1, 0.6], "anisotropy": 0.4,
                                   "emission": [0.02, 0.05, 0.1])",
        R"("ior": 1.35, "scattering": [4, 6, 9], "absorption": [0.3, 0.1, 0.6], )" + cloud};
    const double significance = sidak(1e-4, 18);
    for (const std::string& milk : murky) {
        const auto by = [&](Techniques techniques, std::uint32_t count) {
            Scene scene = scene_of(phases(milk), glass, lights);
            scene.settings.techniques = techniques;
            const World world(scene);
            return radiance_along(world, scene, from, towards, count);
        };
        const std::uint32_t count = long_form ? 400000 : 8000;
        const auto both = by(Techniques::all, count);
        for (const Techniques alone : {Techniques::shadow_rays_alone, Techniques::directions_alone}) {
            const auto found = by(alone, 2 * count);
            for (std::size_t c = 0; c < 3; ++c) {
                CAPTURE(c);
                const double error = std::hypot(both[c].standard_error(), found[c].standard_error());
                CHECK(phasetree::tests::normal_two_sided((both[c].mean() - found[c].mean()) / error) > significance);
                CHECK(error < (long_form ? 0.01 : 0.07) * both[c].mean());
            }
        }
    }
}

}  // namespace test_scattering_furnace
