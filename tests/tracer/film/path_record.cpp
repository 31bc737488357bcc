// What a path records: surfaces, lengths and parts of the radiance against closed forms. Neither the radiance nor the
// random numbers depend on whether it records.
#include "film/path_record.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tracer/support/closed_form.hpp"
#include "tracer/support/paths.hpp"

namespace test_path_record {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

struct Recorded {
    glm::vec3 radiance;
    PathRecord record;
};

// The `count` independent paths of radiance_along(), with their records.
template <class Each>
void trace_recorded(const Scene& scene, const glm::vec3& origin, const glm::vec3& direction, std::uint32_t count,
                    Each&& each) {
    const phasetree::FlushSubnormals flush;
    const World world(scene);
    PathCounters counters;
    const Ray ray{origin, glm::normalize(direction), world.geometry().label(origin), {}};
    Recorded path;
    for (std::uint32_t i = 0; i < count; ++i) {
        Sampler sampler(i & 0xffffu, i >> 16, 0, 1);
        path.radiance = trace_path(world, scene, ray, sampler, counters, &path.record);
        each(std::as_const(path));
    }
}

Recorded one_path(const Scene& scene, const glm::vec3& origin, const glm::vec3& direction) {
    Recorded found;
    trace_recorded(scene, origin, direction, 1, [&](const Recorded& path) { found = path; });
    return found;
}

constexpr const char* slab_of_glass = R"({"set": {"phase": "glass", "of": {"box": {"size": [40, 40, 1]}}}})";

// A diffuse ball and a mirror in glass over a floor, two lamps, a sun and a sky, of three groups.
Scene many_groups() {
    return scene_of(
        R"("glass": {"clear": {"ior": 1.5, "absorption": [0.2, 0.1, 0.3]}}, "clay": {"coated": {"color": [0.6, 0.3, 0.2]}},
           "metal": {"conductor": {"metal": "gold"}})",
        R"({"under": [{"set": {"phase": "clay", "of": {"sphere": {"radius": 0.4}}}},
                      {"set": {"phase": "metal", "of": {"translate": {"by": [1.2, 0, 0], "of": {"sphere": {"radius": 0.4}}}}}},
                      {"set": {"phase": "glass", "of": {"sphere": {"radius": 0.8}}}}]})",
        R"("meshes": [{"floor": {"height": -1, "material": {"diffuse": {"color": [0.5, 0.5, 0.5]}}}}],
           "lights": [{"rectangle": {"centre": [0, 0, 3], "target": [0, 0, 0], "width": 1, "height": 1, "radiance": [9, 8, 7], "group": "key"}},
                      {"sphere": {"centre": [-2, -2, 1], "radius": 0.3, "radiance": [3, 4, 5]}},
                      {"sun": {"direction": [1, -1, 1], "irradiance": [3, 2, 1], "group": "sun"}},
                      {"gradient": {"zenith": [0.5, 0.6, 0.9], "horizon": [0.5, 0.5, 0.5], "ground": [0.1, 0.1, 0.1], "group": "key"}}])");
}

}  // namespace

TEST_CASE("the first surface of a ball: where it is, how it faces, which phases and objects it parts") {
    const Scene scene =
        scene_of(R"("clay": {"diffuse": {"color": [0.6, 0.3, 0.2]}})",
                 R"({"set": {"phase": "clay", "of": {"sphere": {"radius": 2}}}})",
                 R"("meshes": [{"floor": {"height": -3, "material": {"diffuse": {"color": [0.1, 0.2, 0.3]}}}}], )" +
                     std::string(white_environment));
    for (const float z : {0.0f, 0.7f, -1.9f}) {
        CAPTURE(z);
        const PathRecord record = one_path(scene, {0, -10, z}, {0, 1, 0}).record;
        const float half = std::sqrt(4 - z * z);
        REQUIRE(record.first);
        CHECK(record.first->distance == doctest::Approx(10 - half).epsilon(1e-5));
        CHECK(glm::distance(record.first->position, {0, -half, z}) < 1e-4f);
        CHECK(glm::distance(record.first->normal, glm::vec3(0, -half, z) / 2.0f) < 1e-3f);
        CHECK(record.first->object == 0);
        CHECK(record.first->phase_from == phasetree::vacuum);
        CHECK(record.first->phase_to == phasetree::Phase{1});
        CHECK(glm::distance(record.first->albedo, {0.6f, 0.3f, 0.2f}) < 1e-5f);
        REQUIRE(record.behind);
        CHECK(record.behind->position == record.first->position);
        CHECK(record.behind->albedo == record.first->albedo);
        REQUIRE(record.lengths.size() == 2);
        CHECK(record.lengths[0] == record.first->distance);
        CHECK(record.lengths[1] == 0);
    }
    const PathRecord floor = one_path(scene, {0, -10, 0}, {0, 1, -1}).record;
    REQUIRE(floor.first);
    CHECK(floor.first->object == 1);
    CHECK_FALSE(floor.first->phase_to);
    CHECK(floor.first->distance == doctest::Approx(3 * std::sqrt(2.0)).epsilon(1e-5));
    CHECK(glm::distance(floor.first->albedo, {0.1f, 0.2f, 0.3f}) < 1e-5f);
    CHECK_FALSE(one_path(scene, {0, -10, 0}, {0, 0, 1}).record.first);
}

// A ray that is reflected at once does not enter. A ray inside continues for another passage d' with probability F each
// time, so the mean length is (1 − F) d'/(1 − F) = d'.
TEST_CASE("the length of the camera ray in a slab of glass, and what is seen behind it") {
    const Scene scene =
        scene_of(R"("glass": {"clear": {"ior": 1.5}}, "paper": {"diffuse": {"color": [0.8, 0.4, 0.2]}})", slab_of_glass,
                 R"("meshes": [{"floor": {"height": -2, "material": {"diffuse": {"color": [0.8, 0.4, 0.2]}}}}], )" +
                     std::string(white_environment));
    const double cosine = 0.6;
    const glm::vec3 down(0.8f, 0, -0.6f);
    Moments length, albedo, seen;
    trace_recorded(scene, glm::vec3(0.1f, 0.2f, 0.5f) - 2.0f * down, down, 40000, [&](const Recorded& path) {
        length.add(static_cast<double>(path.record.lengths[1]));
        albedo.add(path.record.behind ? static_cast<double>(path.record.behind->albedo.r) : 0.0);
        seen.add(path.record.behind ? 1.0 : 0.0);
        REQUIRE(path.record.first);
        CHECK(path.record.first->distance == doctest::Approx(2).epsilon(1e-4));
        CHECK(path.record.first->phase_to == phasetree::Phase{1});
        CHECK(path.record.first->albedo.r == doctest::Approx(1).epsilon(1e-5));
        if (path.record.behind) CHECK(path.record.behind->object == 1);
    });
    const double expected = 1 / phasetree::tests::cosine_within(cosine, 1.5);
    const double through = phasetree::tests::slab(cosine, {1.5, 0, 1}).transmitted;
    CHECK(mean_p_value(length, expected, 1e-4) > 1e-4);
    CHECK(mean_p_value(length, 1.01 * expected, 1e-4) < 1e-4);
    CHECK(mean_p_value(seen, through, 1e-4) > 1e-4);
    CHECK(mean_p_value(seen, 1.02 * through, 1e-4) < 1e-4);
    CHECK(mean_p_value(albedo, 0.8 * through, 1e-4) > 1e-4);
}

TEST_CASE("a camera in water sees what is in it by its own colour, whatever the index") {
    const Scene scene = scene_of(
        R"("water": {"clear": {"ior": 1.33}}, "clay": {"diffuse": {"color": [0.6, 0.3, 0.2]}}, "glass": {"clear": {"ior": 1.7}})",
        R"({"under": [{"set": {"phase": "clay", "of": {"sphere": {"radius": 0.5}}}},
                      {"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}},
                      {"set": {"phase": "water", "of": {"sphere": {"radius": 9}}}}]})");
    Moments albedo;
    trace_recorded(scene, {0, -5, 0}, {0, 1, 0}, 4000, [&](const Recorded& path) {
        albedo.add(path.record.behind ? static_cast<double>(path.record.behind->albedo.r) : 0.6);
    });
    CHECK(albedo.mean() == doctest::Approx(0.6).epsilon(1e-4));
}

TEST_CASE("direct light: scattered once, and not at smooth glass") {
    // A black ball scatters nothing. A floor under light from above is lit directly, and indirectly only by a wall.
    const std::string floor =
        R"("meshes": [{"floor": {"height": -1, "material": {"diffuse": {"color": [0.5, 0.5, 0.5]}}}}], )";
    const Scene open = scene_of(R"("glass": {"clear": {"ior": 1.5}})", slab_of_glass, floor + white_environment);
    Moments indirect;
    double direct = 0;
    trace_recorded(open, {0, 0, 2}, {0.1f, 0, -1}, 4000, [&](const Recorded& path) {
        CHECK((path.record.direct + path.record.indirect).g == doctest::Approx(path.radiance.g).epsilon(1e-6));
        indirect.add(static_cast<double>(path.record.indirect.g));
        direct += static_cast<double>(path.record.direct.g);
    });
    // Between a floor of reflectance 1/2 and a plate that reflects, most light is direct and some is not.
    CHECK(indirect.mean() > 0.01);
    CHECK(direct / 4000 > 0.3);
    const Scene alone = scene_of(R"("glass": {"clear": {"ior": 1.5}})", slab_of_glass, white_environment);
    trace_recorded(alone, {0, 0, 2}, {0.1f, 0, -1}, 100, [&](const Recorded& path) {
        CHECK(path.record.indirect == glm::vec3(0));
        CHECK(path.record.direct == path.radiance);
    });
}

TEST_CASE("direct light of a medium is what it scatters once, whichever technique finds that") {
    Scene scene = scene_of(R"("fog": {"clear": {"ior": 1, "scattering": [0.8, 0.8, 0.8]}})",
                           R"({"set": {"phase": "fog", "of": {"sphere": {"radius": 1}}}})",
                           R"("lights": [{"constant": {"radiance": [1, 1, 1]}}])");
    struct Mean {
        double sum = 0, squares = 0;
        double mean(double n) const { return sum / n; }
        double variance(double n) const { return (squares / n - mean(n) * mean(n)) / n; }
    };
    constexpr std::uint32_t paths = 40'000;
    const auto direct_by = [&](Techniques techniques) {
        scene.settings.techniques = techniques;
        Mean direct;
        trace_recorded(scene, {0.3f, -5, 0.2f}, {0, 1, 0}, paths, [&](const Recorded& path) {
            const double found = static_cast<double>(path.record.direct.y);
            direct.sum += found;
            direct.squares += found * found;
        });
        return direct;
    };
    const Mean by_directions = direct_by(Techniques::directions_alone);
    // In a furnace the radiance is 1. Some of it is scattered more than once.
    CHECK(by_directions.mean(paths) < 0.95);
    for (const Techniques techniques : {Techniques::shadow_rays_alone, Techniques::all}) {
        const Mean direct = direct_by(techniques);
        const double off = direct.mean(paths) - by_directions.mean(paths);
        CHECK(std::abs(off) < 4 * std::sqrt(direct.variance(paths) + by_directions.variance(paths)));
        CHECK(std::abs(off) < 0.01);
    }
}

TEST_CASE("parts of the radiance add up, and recording changes nothing") {
    const Scene scene = many_groups();
    REQUIRE(scene.lights.groups() == std::vector<std::string>{"default", "key", "sun"});
    const World world(scene);
    PathCounters counters;
    PathRecord record;
    glm::dvec3 most(0);
    for (std::uint32_t i = 0; i < 2000; ++i) {
        const phasetree::FlushSubnormals flush;
        const float x = static_cast<float>(i % 50) / 25 - 1, z = static_cast<float>(i / 50) / 20 - 1;
        const Ray ray{{0, -5, 0.5f}, glm::normalize(glm::vec3(x, 5, z - 0.5f)), phasetree::vacuum, {}};
        Sampler one(i, 0, 0, 7), other(i, 0, 0, 7);
        const glm::vec3 radiance = trace_path(world, scene, ray, one, counters);
        CHECK(trace_path(world, scene, ray, other, counters, &record) == radiance);
        CHECK(one.next() == other.next());
        glm::vec3 sum(0), parts = record.direct + record.indirect;
        for (const glm::vec3& group : record.groups) {
            sum += group;
            most = glm::max(most, glm::dvec3(group));
        }
        for (int c = 0; c < 3; ++c) {
            CHECK(sum[c] == doctest::Approx(radiance[c]).epsilon(1e-5));
            CHECK(parts[c] == doctest::Approx(radiance[c]).epsilon(1e-6));
        }
    }
    CHECK(most.r > 0);
}

TEST_CASE("a lamp's light is of its group, however it is found") {
    // One lamp at a time emits. The others then contribute nothing, and this lamp contributes everything.
    for (int shining = 0; shining < 3; ++shining) {
        CAPTURE(shining);
        const auto radiance = [&](int lamp) { return std::string(lamp == shining ? "[5, 4, 3]" : "[0, 0, 0]"); };
        const Scene scene =
            scene_of(R"("glass": {"clear": {"ior": 1.5}}, "clay": {"coated": {"color": [0.6, 0.3, 0.2]}})",
                     R"({"under": [{"set": {"phase": "clay", "of": {"sphere": {"radius": 0.4}}}},
                          {"set": {"phase": "glass", "of": {"sphere": {"radius": 0.8}}}}]})",
                     R"("meshes": [{"floor": {"height": -1, "material": {"diffuse": {"color": [0.5, 0.5, 0.5]}}}}],
               "lights": [{"rectangle": {"centre": [0, 0, 3], "target": [0, 0, 0], "width": 3, "height": 3, "group": "a", "radiance": )" +
                         radiance(0) + R"(}}, {"constant": {"group": "b", "radiance": )" + radiance(1) +
                         R"(}}, {"sphere": {"centre": [-1, -2, 1], "radius": 0.3, "group": "c", "radiance": )" +
                         radiance(2) + "}}]");
        float brought = 0;
        for (const float z : {-0.9f, -0.3f, 0.2f, 0.6f})
            trace_recorded(scene, {0, -5, 0.5f}, {0.05f, 5, z - 0.5f}, 200, [&](const Recorded& path) {
                const std::vector<glm::vec3>& groups = path.record.groups;
                REQUIRE(groups.size() == 4);
                CHECK(groups[static_cast<std::size_t>(shining + 1)] == path.radiance);
                for (int other = 0; other < 4; ++other)
                    if (other != shining + 1) CHECK(groups[static_cast<std::size_t>(other)] == glm::vec3(0));
                brought += path.radiance.g;
            });
        CHECK(brought > 0.1f);
    }
}

TEST_CASE("a ray that starts in something opaque records nothing") {
    const Scene scene = scene_of(R"("clay": {"diffuse": {"color": [0.6, 0.3, 0.2]}})",
                                 R"({"set": {"phase": "clay", "of": {"sphere": {"radius": 2}}}})");
    const PathRecord record = one_path(scene, {0, 0, 0}, {0, 1, 0}).record;
    CHECK_FALSE(record.first);
    CHECK(record.groups == std::vector<glm::vec3>{glm::vec3(0)});
}

TEST_CASE("names of groups") {
    const auto lit_by = [](const std::string& group) {
        return scene_of(R"("clay": {"diffuse": {"color": [0.6, 0.3, 0.2]}})",
                        R"({"set": {"phase": "clay", "of": {"sphere": {"radius": 2}}}})",
                        R"("lights": [{"constant": {"group": )" + group + "}}]");
    };
    CHECK(lit_by(R"("Key_light-2")").lights.groups().back() == "Key_light-2");
    CHECK(lit_by(R"("default")").lights.groups().size() == 1);
    for (const char* bad : {R"("")", R"("key.R")", R"("a b")", R"("schlüssel")", "7"})
        CHECK_THROWS_AS(lit_by(bad), phasetree::SceneError);
}

}  // namespace test_path_record
