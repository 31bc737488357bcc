// Smooth meshes with few triangles: the points at which rays leave them.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "phasetree_support/temporary_directory.hpp"
#include "tracer/support/paths.hpp"

namespace test_shadow_terminator {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr int around = 16, rings = 8;

// A ball of radius 1 as few triangles, with the ball's normals.
std::string coarse_ball() {
    std::string obj, faces;
    const auto corner = [](int ring, int i) {
        const std::string n = std::to_string(1 + ring * around + i % around);
        return " " + n + "//" + n;
    };
    for (int ring = 0; ring <= rings; ++ring)
        for (int i = 0; i < around; ++i) {
            const double a = pi * ring / rings, b = 2 * pi * i / around;
            const std::string at = std::to_string(std::sin(a) * std::cos(b)) + " " +
                                   std::to_string(std::sin(a) * std::sin(b)) + " " + std::to_string(std::cos(a)) + "\n";
            obj += "v " + at + "vn " + at;
            if (ring == rings) continue;
            faces += "f" + corner(ring, i) + corner(ring + 1, i) + corner(ring + 1, i + 1) + "\n";
            faces += "f" + corner(ring, i) + corner(ring + 1, i + 1) + corner(ring, i + 1) + "\n";
        }
    return obj + faces;
}

struct Shown {
    explicit Shown(const std::string& phases, const std::string& tree, const std::string& more = "") {
        phasetree::support::write_text(folder / "ball.obj", coarse_ball());
        scene = scene_of(phases, tree,
                         std::string(white_environment) + R"(, "meshes": [{"obj": {"file": ")" +
                             (folder / "ball.obj").string() + "\"" + more +
                             R"(, "material": {"diffuse": {"color": [1, 1, 1]}}}}])");
        world.emplace(scene);
    }
    std::optional<Surface> met(const glm::vec3& origin, const glm::vec3& direction) const {
        return surface_met(*world, origin, direction);
    }
    phasetree::support::TemporaryDirectory folder;
    Scene scene;
    std::optional<World> world;
};

const std::string far_away =
    R"({"set": {"phase": "a", "of": {"translate": {"by": [99, 99, 0], "of": {"sphere": {"radius": 1}}}}}})";

glm::vec3 direction(int i, int count) {
    const float z = 1 - 2 * (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
    const float turn = 2.399963f * static_cast<float>(i), r = std::sqrt(1 - z * z);
    return {r * std::cos(turn), r * std::sin(turn), z};
}

// The share of points that are in shadow, among those of a ball that the sun lights at a small angle.
double in_shadow(const Shown& shown, const glm::vec3& sun) {
    int lit = 0, dark = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::vec3 from = 3.0f * direction(i, 20000);
        const auto surface = shown.met(from, -from);
        REQUIRE(surface);
        const float cosine = glm::dot(surface->normal, sun);
        if (cosine < 0.02f || cosine > 0.25f) continue;
        ++lit;
        PathCounters counters;
        const Visibility seen = shown.world->geometry().visibility(surface->reflected(sun), 50, counters);
        dark += !std::holds_alternative<Escaped>(seen);
    }
    REQUIRE(lit > 1000);
    return static_cast<double>(dark) / lit;
}

}  // namespace

TEST_CASE("a smooth ball of few triangles has no shadow of its own where the sun lights its smooth surface") {
    const std::string paper = R"("a": {"diffuse": {"color": [1, 1, 1]}})";
    const Shown smooth(paper, far_away);
    const glm::vec3 sun = glm::normalize(glm::vec3(0.3f, 0.8f, 0.5f));
    CHECK(in_shadow(smooth, sun) < 0.01);
    // Rays leave a surface that is no farther from the ball than its triangles are.
    double farthest = 0, flat = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 from = 3.0f * direction(i, 2000);
        const Surface surface = *smooth.met(from, -from);
        farthest = std::max(farthest, std::abs(static_cast<double>(glm::length(surface.near_side.origin)) - 1));
        flat = std::max(flat, 3 - static_cast<double>(surface.distance) < 1
                                  ? 1 - (3 - static_cast<double>(surface.distance))
                                  : 0.0);
    }
    CHECK(flat > 0.03);
    CHECK(farthest < flat);
    // From inside, the ball's triangles are in front of its surface, so rays leave from the triangles themselves: none
    // escapes.
    for (int i = 0; i < 500; ++i) {
        const Surface surface = *smooth.met({0, 0, 0}, direction(i, 500));
        CHECK(glm::length(surface.near_side.origin - surface.place.position) == 0);
    }
    // A mesh that is not smooth is not changed.
    const Shown facets(paper, far_away, R"(, "smooth": false)");
    const Surface facet = *facets.met({0, 0, 3}, {0.1f, 0.12f, -1});
    CHECK(glm::length(facet.near_side.origin - facet.place.position) == 0);
}

TEST_CASE("rays that leave a smooth mesh stay in the phase in which it was met") {
    // A shell of glass that touches the ball's corners and leaves a gap over its faces, and one that is in the way.
    for (const char* const inner : {"1.0005", "0.985"}) {
        CAPTURE(inner);
        const Shown shown(
            R"("a": {"clear": {"ior": 1.5}})",
            std::string(R"({"set": {"phase": "a", "of": {"difference": {"from": {"sphere": {"radius": 1.2}},
                              "subtract": [{"sphere": {"radius": )") +
                inner + "}}]}}}}");
        int met = 0;
        for (int i = 0; i < 5000; ++i) {
            // From within the gap, or from within the glass where that is in the way.
            const glm::vec3 from = 1.0004f * direction(i, 5000);
            const auto surface = shown.met(from, -from);
            if (!surface || surface->object != 1) continue;
            ++met;
            CHECK(shown.world->geometry().label(surface->near_side.origin) == surface->near_side.phase);
        }
        CHECK(met > 1000);
    }
}

}  // namespace test_shadow_terminator
