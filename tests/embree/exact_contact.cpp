// Phases that are meant to touch do: along random rays through every scene of the gallery, no film of any phase, the
// vacuum included, lies between two others but where its author wants one.
//
// A film is a stretch of one phase that is thin and has parallel sides. A ray that clips a corner, or grazes a ball, is
// in a phase for a short stretch, too; but there the sides that it enters and leaves by are at an angle, or face the
// same way.
#include <doctest/doctest.h>

#include <filesystem>
#include <map>

#include "embree/embree.hpp"
#include "phasetree/cells/cells.hpp"
#include "phasetree/embree.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/handle.hpp"
#include "source_directory.hpp"
#include "support/random_tree.hpp"

using namespace phasetree;
using namespace phasetree::tests;

namespace {

// How thick a film is at most, as a part of the object's diagonal.
constexpr double thin = 1e-3;

// Whatever ends in a sharp edge is thin there, so a few rays meet a film of nearly every phase: as many as this share
// of them.
constexpr double share_of_edges = 0.008;

// What is thin, and between which phases it lies; from either side.
struct Film {
    std::string phase, one, other;
    auto operator<=>(const Film&) const = default;
};

Film film(const std::string& before, const std::string& phase, const std::string& after) {
    return {phase, std::min(before, after), std::max(before, after)};
}

// The films that are meant.
const std::map<std::string, std::vector<Film>> meant = {
    // Twisted strands lie a hair from each other.
    {"cable", {film("copper", "vacuum", "copper")}},
    // A drink creeps up its glass, and ends there as thin as can be; two cubes of ice nearly touch.
    {"drinks",
     {film("glass", "cosmopolitan", "vacuum"), film("glass", "tonic", "vacuum"), film("glass", "whisky", "vacuum"),
      film("ice", "tonic", "vacuum"), film("ice", "whisky", "vacuum"), film("ice", "tonic", "ice")}},
    {"entremet", {film("nut", "skin", "cream"), film("nut", "skin", "mousse")}},
    {"interface", {film("vacuum", "brass", "vacuum")}},
    // The chocolates are pressed into the paper that their wells are lined with.
    {"box_of_operators", {film("raspberry", "paper", "wood")}},
};

struct Found {
    int rays = 0;  // that meet it
    double thickness = 0;
    Ray example{};
};

struct Step {
    Crossing crossing;
    glm::vec3 normal{0};
};

// Every crossing of a ray that starts in the vacuum, outside.
std::vector<Step> crossings(RTCScene scene, const InterfaceCells& cells, const Ray& ray) {
    std::vector<Step> all;
    glm::vec3 origin = ray.origin;
    Phase carried = vacuum;
    for (int i = 0; i < 1000; ++i) {
        embree::Query query;
        query.carried = carried;
        RTCRayHit hit = rayhit({origin, ray.direction});
        embree::intersect(scene, query.context, hit);
        if (!hits(hit)) return all;
        all.push_back({query.crossing, cells.normal(hit.hit.primID, query.crossing, ray.direction).unit});
        origin = query.crossing.p_out;
        carried = query.crossing.to;
    }
    FAIL("a ray does not end");
    return all;
}

std::map<Film, Found> films(RTCDevice device, const SceneTree& tree, int count) {
    const auto cells = std::make_shared<const InterfaceCells>(tree.object);
    embree::TreeGeometry geometry(device, cells, {.rays_carry_phases = true});
    EmbreeScene scene(device);
    scene.add(geometry.handle());
    scene.commit();
    const Bounds bounds = cells->bounds();
    const double diagonal = static_cast<double>(bounds.diagonal());
    std::map<Film, Found> all;
    Random rng(15);
    for (int i = 0; i < count; ++i) {
        const glm::vec3 target = rng.in(bounds);
        const glm::vec3 direction = rng.direction();
        const Ray ray{target - bounds.diagonal() * direction, direction};
        const std::vector<Step> steps = crossings(scene, *cells, ray);
        std::map<Film, double> of_ray;  // their thickness
        for (std::size_t k = 1; k < steps.size(); ++k) {
            const Step &in = steps[k - 1], &out = steps[k];
            // Both point along the ray, so parallel sides have equal normals.
            if (glm::dot(in.normal, out.normal) < 0.9f) continue;
            const double thickness = static_cast<double>(glm::length(out.crossing.p_in - in.crossing.p_out)) *
                                     std::abs(static_cast<double>(glm::dot(in.normal, direction)));
            if (thickness > thin * diagonal) continue;
            const auto& names = tree.phases;
            of_ray.emplace(film(names[in.crossing.from], names[in.crossing.to], names[out.crossing.to]), thickness);
        }
        for (const auto& [film, thickness] : of_ray) all[film] = {all[film].rays + 1, thickness, ray};
    }
    return all;
}

}  // namespace

TEST_CASE("no phase of the gallery is thinner than its author says") {
    const Device device;
    const int count = long_tests() ? 100'000 : 4000;
    std::size_t scenes = 0, seen = 0;
    for (const auto& entry : std::filesystem::directory_iterator(source_directory() + "/scenes")) {
        if (entry.path().extension() != ".json" || entry.path().stem() == "scene.schema") continue;
        ++scenes;
        const std::string scene = entry.path().stem().string();
        const auto listed = meant.find(scene);
        for (const auto& [film, found] : films(device, read_tree(Document::from_file(entry.path())), count)) {
            if (found.rays < share_of_edges * count) continue;
            ++seen;
            const glm::vec3 &o = found.example.origin, &d = found.example.direction;
            CAPTURE(scene);
            CAPTURE(100.0 * found.rays / count);
            CAPTURE(found.thickness);
            INFO(film.phase, " between ", film.one, " and ", film.other, ", on the ray ", o.x, " ", o.y, " ", o.z, " ",
                 d.x, " ", d.y, " ", d.z);
            CHECK((listed != meant.end() && std::ranges::find(listed->second, film) != listed->second.end()));
        }
    }
    CHECK(scenes > 20);
    CHECK(seen >= 5);  // or nothing thin is seen at all
}
