// Thin meshes in scenes: panes against closed forms and against slabs with a thickness, sheets, and two sides.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "support/uniform.hpp"
#include "tracer/caustics/photons.hpp"
#include "tracer/support/closed_form.hpp"
#include "tracer/support/paths.hpp"

namespace test_thin_surfaces {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;
using phasetree::tests::Layer;
using phasetree::tests::normal_two_sided;
using phasetree::tests::Response;
using phasetree::tests::slab;

namespace {

constexpr double half_turn = std::numbers::pi;

// Something small and far from the rays, because a scene has a tree or a mesh alone.
const std::string bead =
    R"({"set": {"phase": "bead", "of": {"translate": {"by": [4, 4, 0.5], "of": {"sphere": {"radius": 0.1}}}}}})";
const std::string black_bead = R"("bead": {"diffuse": {"color": [0, 0, 0]}})";

std::string sheet(double height, const std::string& material, double size = 20) {
    return R"({"floor": {"height": )" + std::to_string(height) + R"(, "size": )" + std::to_string(size) +
           R"(, "material": )" + material + "}}";
}
Scene with_meshes(const std::string& meshes, const std::string& lights = white_environment,
                  const std::string& tree = bead, const std::string& phases = black_bead) {
    return scene_of(phases, tree, R"("meshes": [)" + meshes + "], " + lights);
}

// The share that crosses the glass once, of the three channels, as a colour and as absorption over 0.01.
constexpr std::array<double, 3> once{0.9, 0.5, 1.0};
const std::string coloured = R"({"thin_glass": {"color": [0.9, 0.5, 1]}})";

const std::string grey_floor = sheet(0, R"({"diffuse": {"color": [0.5, 0.5, 0.5]}})");

// A ray from above or below, to a point, at this angle.
struct Line {
    glm::vec3 origin, direction;
};
Line towards(const glm::vec3& point, double degrees, bool from_below = false) {
    const double angle = degrees * half_turn / 180, s = std::sin(angle), c = std::cos(angle);
    const glm::vec3 direction(s * 0.96, s * 0.28, from_below ? c : -c);
    return {point - 2.0f * direction, direction};
}

}  // namespace

TEST_CASE("a pane in white light is as bright as all its reflections together, without noise") {
    const Scene scene = with_meshes(sheet(1, coloured));
    const World world(scene);
    for (const double degrees : {0.0, 40.0, 75.0})
        for (const bool from_below : {false, true}) {
            CAPTURE(degrees);
            const Line line = towards({0.1f, 0.2f, 1}, degrees, from_below);
            const auto found = radiance_along(world, scene, line.origin, line.direction, 2000);
            for (std::size_t c = 0; c < 3; ++c) {
                const Response right = slab(std::cos(degrees * half_turn / 180), {1.5, -std::log(once[c]), 1});
                // A choice between the two lobes by the mean of the channels is all that varies.
                CHECK(mean_p_value(found[c], right.reflected + right.transmitted, 1e-5) > 1e-5);
                if (degrees < 50 && c < 2)
                    CHECK(mean_p_value(found[c], 1.01 * (right.reflected + right.transmitted), 1e-5) < 1e-5);
            }
        }
}

TEST_CASE("a point light shines straight through a pane, without noise") {
    const glm::dvec3 light(0.5, 0.3, 2), at(-0.2, 0.1, 0);
    const Scene scene = with_meshes(grey_floor + ", " + sheet(1, coloured) + ", " + sheet(1.2, coloured),
                                    R"("lights": [{"point": {"position": [0.5, 0.3, 2], "intensity": 30}}])");
    const World world(scene);
    // From below the panes, so that only the light passes them.
    const auto found = radiance_along(world, scene, {-1.2f, 0.1f, 0.6f}, {1, 0, -0.6f}, 3000);
    const glm::dvec3 way = light - at;
    const double squared = glm::dot(way, way), cosine = way.z / std::sqrt(squared);
    for (std::size_t c = 0; c < 3; ++c) {
        const double passes = slab(cosine, {1.5, -std::log(once[c]), 1}).transmitted;
        const double direct = 30 * cosine / squared * passes * passes * 0.5 / half_turn;
        // The floor lights itself by way of the panes, which only adds light; shadow rays alone have no noise.
        CHECK(found[c].mean() > direct * (1 - 1e-4));
        CHECK(found[c].mean() < direct * 1.2);
    }
    Scene alone = scene;
    alone.settings.max_depth = 1;
    const World small(alone);
    const auto direct = radiance_along(small, alone, {-1.2f, 0.1f, 0.6f}, {1, 0, -0.6f}, 200);
    for (std::size_t c = 0; c < 3; ++c) {
        const double passes = slab(cosine, {1.5, -std::log(once[c]), 1}).transmitted;
        const double right = 30 * cosine / squared * passes * passes * 0.5 / half_turn;
        CHECK(direct[c].mean() == doctest::Approx(right).epsilon(2e-4));
        CHECK(direct[c].variance() < 1e-8 * right * right);
    }
}

TEST_CASE("a pane lights and mirrors like a thin slab of clear glass, with and without water around") {
    // Shadow rays, sampled directions and paths to the camera pass the pane; a rectangle and the sky shine on the
    // floor.
    // The slab is so thin that it hardly displaces light, and its cells know its thickness to about 2 %. So it is
    // nearly clear; the closed forms above are tested with more absorption.
    constexpr double thickness = 1e-3;
    constexpr std::array<double, 3> share{0.99, 0.97, 1.0};
    const std::string pale = R"({"thin_glass": {"color": [0.99, 0.97, 1]}})";
    const std::string lights =
        R"("lights": [{"constant": {"radiance": [0.2, 0.2, 0.2]}}, {"rectangle": {"centre": [0.3, 0.2, 2], "target": [0.3, 0.2, 0], "width": 1.2, "height": 0.8, "radiance": [8, 8, 8]}}])";
    const auto box = [](const std::string& phase, double z, double height, double width) {
        return R"({"set": {"phase": ")" + phase + R"(", "of": {"translate": {"by": [0, 0, )" + std::to_string(z) +
               R"(], "of": {"box": {"size": [)" + std::to_string(width) + ", " + std::to_string(width) + ", " +
               std::to_string(height) + "]}}}}}}";
    };
    const double significance = sidak(1e-4, 2 * 2 * 3);
    for (const bool in_water : {false, true}) {
        CAPTURE(in_water);
        const std::string phases =
            black_bead + R"(, "water": {"clear": {"ior": 1.33}}, "glass": {"clear": {"ior": 1.5, "absorption": [)" +
            std::to_string(-std::log(share[0]) / thickness) + ", " + std::to_string(-std::log(share[1]) / thickness) +
            ", 0]}}";
        const std::string water = in_water ? box("water", 0.75, 1.5, 12) + ", " : std::string();
        const auto seen = [&](bool is_modelled, double floor, const Line& line) {
            const std::string glass = is_modelled ? box("glass", 1, thickness, 12) + ", " : std::string();
            const std::string ground = sheet(0.001, R"({"diffuse": {"color": [)" + std::to_string(floor) + ", " +
                                                        std::to_string(floor) + ", " + std::to_string(floor) + "]}}");
            const Scene scene = with_meshes(ground + (is_modelled ? "" : ", " + sheet(1, pale, 12)), lights,
                                            R"({"over": [)" + glass + water + bead + "]}", phases);
            const World world(scene);
            return radiance_along(world, scene, line.origin, line.direction, 60000);
        };
        for (const double degrees : {20.0, 60.0}) {
            const Line line = towards({0.1f, 0.2f, in_water ? 1.5f : 1.0f}, degrees);
            const auto modelled = seen(true, 0.5, line), thin = seen(false, 0.5, line);
            for (std::size_t c = 0; c < 3; ++c) {
                const auto p_value = [&](double factor) {
                    return normal_two_sided((factor * thin[c].mean() - modelled[c].mean()) /
                                            std::hypot(thin[c].standard_error(), modelled[c].standard_error()));
                };
                CAPTURE(degrees);
                CAPTURE(c);
                CAPTURE(thin[c].mean() / modelled[c].mean());
                CAPTURE(thin[c].standard_error() / thin[c].mean());
                CHECK(p_value(1) > significance);
                // There is less noise where more of the light is mirrored.
                if (!in_water && degrees == 60.0) CHECK(p_value(1.01) < significance);
                CHECK(p_value(1.06) < significance);
            }
        }
    }
}

TEST_CASE("a sheet of paper transmits and reflects by Lambert's law, from both sides") {
    const std::string paper = R"({"thin_diffuse": {"color": [0.5, 0.4, 0.1], "transmission": [0.3, 0.2, 0.6]}})";
    const Scene white = with_meshes(sheet(1, paper));
    const World in_white(white);
    const glm::dvec3 light(0.5, 0.3, 3), at(0.1, 0.2, 1);
    const Scene lit =
        with_meshes(sheet(1, paper), R"("lights": [{"point": {"position": [0.5, 0.3, 3], "intensity": 30}}])");
    const World in_lamp(lit);
    const glm::dvec3 way = light - at;
    const double squared = glm::dot(way, way), irradiance = 30 * way.z / std::sqrt(squared) / squared;
    constexpr double reflected[] = {0.5, 0.4, 0.1}, transmitted[] = {0.3, 0.2, 0.6};
    const double significance = sidak(1e-4, 12);
    for (const bool from_below : {false, true}) {
        const Line line = towards(glm::vec3(at), 30, from_below);
        const auto sky = radiance_along(in_white, white, line.origin, line.direction, 150000);
        const auto lamp = radiance_along(in_lamp, lit, line.origin, line.direction, 100);
        for (std::size_t c = 0; c < 3; ++c) {
            CAPTURE(c);
            CHECK(mean_p_value(sky[c], reflected[c] + transmitted[c], 1e-5) > significance);
            const double share = from_below ? transmitted[c] : reflected[c];
            CHECK(lamp[c].mean() == doctest::Approx(share / half_turn * irradiance).epsilon(1e-3));
        }
        CHECK(mean_p_value(sky[2], 0.707, 1e-5) < significance);
    }
}

TEST_CASE("two sides differ, whichever way a mesh is placed") {
    const std::string card =
        R"({"two_sided": {"front": {"diffuse": {"color": [0.8, 0, 0]}}, "back": {"diffuse": {"color": [0, 0, 0.6]}}}})";
    const Scene scene = with_meshes(sheet(1, card));
    const World world(scene);
    const double significance = sidak(1e-4, 2);
    const Line above = towards({0.1f, 0.2f, 1}, 30), below = towards({0.1f, 0.2f, 1}, 30, true);
    const auto front = radiance_along(world, scene, above.origin, above.direction, 20000);
    const auto back = radiance_along(world, scene, below.origin, below.direction, 20000);
    CHECK(mean_p_value(front[0], 0.8, 1e-5) > significance);
    CHECK(front[2].mean() == 0);
    CHECK(mean_p_value(back[2], 0.6, 1e-5) > significance);
    CHECK(back[0].mean() == 0);
}

TEST_CASE("a pane exactly on a face of a clear object, or nearly so, is met together with the face") {
    for (const double off : {0.0, 1e-7, -1e-7, 3e-6, -3e-6}) {
        CAPTURE(off);
        const Scene scene = with_meshes(
            sheet(1 + off, R"({"thin_glass": {}})"), white_environment,
            R"({"set": {"phase": "glass", "of": {"translate": {"by": [0, 0, 0.5], "of": {"box": {"size": [2, 2, 1]}}}}}})",
            R"("glass": {"clear": {"ior": 1.5}})");
        const World world(scene);
        phasetree::tests::Uniform random(7);
        const auto between = [&](float low, float high) { return low + (high - low) * random(); };
        PathCounters counters;
        for (int i = 0; i < 500; ++i) {
            const bool from_inside = i % 2 == 0;
            const glm::vec3 origin(between(-0.5f, 0.5f), between(-0.5f, 0.5f), from_inside ? 0.6f : 1.4f);
            const glm::vec3 direction =
                glm::normalize(glm::vec3(between(-0.4f, 0.4f), between(-0.4f, 0.4f), from_inside ? 1.0f : -1.0f));
            Ray ray{origin, direction, world.geometry().label(origin), {}};
            CHECK(ray.phase.index == (from_inside ? 1 : 0));
            // Straight on: a pane and an interface, in either order, and then the other phase.
            int panes = 0, faces = 0;
            for (int met = 0; met < 2; ++met) {
                const Hit hit = world.geometry().intersect(ray, counters);
                const Surface* surface = std::get_if<Surface>(&hit);
                REQUIRE(surface != nullptr);
                REQUIRE(surface->far_side);
                (surface->entered ? faces : panes) += 1;
                ray = surface->transmitted(direction);
            }
            CHECK(panes == 1);
            CHECK(faces == 1);
            CHECK(ray.phase.index == (from_inside ? 0 : 1));
        }
    }
}

TEST_CASE("shadow rays end at a sheet that scatters, and pass a pane") {
    const auto seen = [&](const std::string& material) {
        const Scene scene = with_meshes(sheet(1, material));
        const World world(scene);
        PathCounters counters;
        return world.geometry().visibility({{0, 0, 0}, {0, 0, 1}, {}, {}}, 10, counters);
    };
    CHECK(
        std::holds_alternative<Blocked>(seen(R"({"thin_diffuse": {"color": [1, 1, 1], "transmission": [0, 0, 0]}})")));
    CHECK(std::holds_alternative<Surface>(seen(R"({"thin_glass": {}})")));
    CHECK(std::holds_alternative<Surface>(seen(R"({"thin_glass": {"roughness": 0.3}})")));
}

TEST_CASE("photons pass panes, are mirrored by them, and land on sheets") {
    struct Case {
        std::string name, meshes;
    };
    const std::string pane = R"({"thin_glass": {"color": [0.5, 0.5, 0.5], "ior": 2}})";
    const std::string frosted = R"({"thin_glass": {"ior": 2, "roughness": 0.2}})";
    const std::string paper = R"({"thin_diffuse": {"color": [0.4, 0.4, 0.4], "transmission": [0.5, 0.5, 0.5]}})";
    for (const Case& c :
         {Case{"a pane between the lamp and the ball", sheet(2.2, pane)},
          Case{"a pane below the ball", sheet(0.3, pane)}, Case{"a frosted pane below the ball", sheet(0.3, frosted)},
          Case{"paper below the ball", sheet(0.3, paper)}}) {
        CAPTURE(c.name);
        check_pictures(
            [&](bool caustics) {
                Scene scene = with_meshes(
                    sheet(0, R"({"diffuse": {"color": [0.6, 0.6, 0.6]}})") + ", " + c.meshes,
                    R"("lights": [{"sphere": {"centre": [0.5, 0.3, 3], "radius": 0.5, "radiance": [20, 20, 20]}}],
                       "camera": {"position": [0, -2, 1], "look_at": [0, 0, 0.15], "fov": 30},
                       "render": {"width": 24, "height": 24})",
                    R"({"set": {"phase": "glass", "of": {"translate": {"by": [0, 0, 0.9], "of": {"sphere": {"radius": 0.4}}}}}})",
                    R"("glass": {"clear": {"ior": 1.5}})");
                scene.settings.caustics = caustics;
                scene.settings.samples = long_form ? 500 : 20;
                scene.settings.photons = long_form ? 16.0f : 6.0f;
                scene.settings.photon_radius = long_form ? 0.1f : 0.2f;
                return scene;
            },
            planted, sidak(1e-4, 2 * 4));
    }
}

TEST_CASE("materials for meshes alone are rejected in phases, and where they cannot be combined") {
    const auto said = [](const std::string& phase) -> std::string {
        try {
            (void)scene_of("\"bead\": " + phase, bead);
        } catch (const std::exception& e) {
            return e.what();
        }
        return "";
    };
    const std::string matt = R"({"diffuse": {"color": [1, 1, 1]}})";
    for (const std::string& phase :
         {std::string(R"({"thin_glass": {}})"),
          std::string(R"({"thin_diffuse": {"color": [1, 1, 1], "transmission": [0, 0, 0]}})"),
          R"({"two_sided": {"front": )" + matt + R"(, "back": )" + matt + "}}",
          R"({"mix": {"first": )" + matt + R"(, "second": {"thin_glass": {}}}})"})
        CHECK(said(phase).find("a phase cannot be thin or two-sided") != std::string::npos);
    CHECK(said(R"({"two_sided": {"front": {"glowing": {}}, "back": )" + matt + "}}").find("emits light") !=
          std::string::npos);
    CHECK(said(R"({"two_sided": {"front": )" + matt + R"(, "back": {"thin_glass": {}}}})")
              .find("cannot contain \"thin_glass\"") != std::string::npos);
    CHECK(said(R"({"thin_glass": {"color_distance": 1}})").find("requires \"thickness\"") != std::string::npos);
}

}  // namespace test_thin_surfaces
