// Paths that a guide sends to where light was found: they find the same light, with less noise where light is scattered
// often.
#include <doctest/doctest.h>

#include <atomic>
#include <cmath>

#include "guiding/path_guide_samples.hpp"
#include "integrator/guided.hpp"
#include "render/guide_training.hpp"
#include "shading/bsdf/coating_albedo.hpp"
#include "support/long_tests.hpp"
#include "support/uniform.hpp"
#include "tracer/support/paths.hpp"

namespace test_guiding {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;
using phasetree::tests::normal_two_sided;
using phasetree::tests::Uniform;

namespace {

std::optional<Guide> guide_for(const World& world, const Scene& scene, const Caustics* caustics = nullptr) {
    const CameraPaths cameras(world, scene);
    return trained_guide({world, scene, cameras, caustics, [](double) {}, [] { return false; }});
}

// Two rooms with an opening between them. One has a lamp and a ball of glass. The other has the camera and a second
// ball of glass, which light passes on its way.
Scene rooms(const std::string& more = "") {
    return scene_of(
        R"("wall": {"diffuse": {"color": [0.75, 0.7, 0.6]}}, "glass": {"clear": {"ior": 1.5}}, "board": {"diffuse": {"color": [0.5, 0.3, 0.2]}})",
        R"({"over": [
            {"set": {"phase": "glass", "of": {"translate": {"by": [-0.5, 0.6, 0.5], "of": {"sphere": {"radius": 0.5}}}}}},
            {"set": {"phase": "glass", "of": {"translate": {"by": [-0.2, 3.6, 1.2], "of": {"sphere": {"radius": 0.4}}}}}},
            {"set": {"phase": "board", "of": {"translate": {"by": [1, 0.5, 0.4], "of": {"box": {"size": [0.8, 0.8, 0.8]}}}}}},
            {"set": {"phase": "wall", "of": {"difference": {
                "from": {"translate": {"by": [0, 1, 1.25], "of": {"box": {"size": [4.4, 8.4, 2.9]}}}},
                "subtract": [{"translate": {"by": [0, -0.5, 1.25], "of": {"box": {"size": [4, 5, 2.5]}}}},
                             {"translate": {"by": [0, 3.6, 1.25], "of": {"box": {"size": [4, 2.8, 2.5]}}}},
                             {"translate": {"by": [-0.9, 2.1, 1], "of": {"box": {"size": [2, 1, 2]}}}}]}}}}]})",
        R"("lights": [{"sphere": {"centre": [1.2, 4.2, 2], "radius": 0.3, "radiance": [60, 50, 40]}}],
           "camera": {"position": [0.3, -2.6, 1.4], "look_at": [-0.2, 1, 0.8], "fov": 60},
           "render": {"width": 32, "height": 24, "samples": 2, "guiding": true)" +
            more + "}");
}

// The rooms without photons, and their guide, which two test cases share: training it takes longer than either.
struct GuidedRooms {
    Scene scene = rooms();
    World world{scene};
    std::optional<Guide> guide = guide_for(world, scene);
};
const GuidedRooms& guided_rooms() {
    static const GuidedRooms& made = *new GuidedRooms;
    return made;
}

// A ray in the room without a lamp.
const glm::vec3 in_the_dark(0.3f, -2.5f, 1.4f), to_floor(-0.1f, 1.5f, -1.3f);

// A tree that favours directions of +x.
DirectionTree sideways() {
    std::vector<DirectionTree::Light> light;
    Uniform random(7);
    for (int i = 0; i < 3000; ++i)
        light.push_back({sphere_to_square(glm::normalize(glm::vec3(1, 0, 0.5f) +
                                                         0.4f * (glm::vec3(random(), random(), random()) - 0.5f))),
                         1.0f});
    return DirectionTree(light);
}

void check_guided(const Bsdf& bsdf, double significance) {
    const DirectionTree tree = sideways();
    const Frame frame(glm::normalize(glm::vec3(0.2f, -0.1f, 1)));
    const glm::vec3 wo = glm::normalize(glm::vec3(0.3f, 0.2f, 0.8f));
    const GuidedBsdf guided(bsdf, frame, wo, &tree), alone(bsdf, frame, wo, nullptr);
    Uniform random(8);
    Moments with_guide, without, recorded, from_the_right;
    int rounded_away = 0;  // to the next square of the tree
    int changed_without_guide = 0, wrong_quotients = 0, wrong_weights = 0;
    const auto is_near = [](float found, float expected) { return std::abs(found - expected) < 1e-3f * expected; };
    for (std::uint32_t i = 0; i < samples_of(400'000); ++i) {
        const float lobe = random();
        const glm::vec2 u = random.two();
        const auto next = guided.sample(lobe, u);
        const auto plain = alone.sample(lobe, u);
        const auto shown = guided.unguided_sample(lobe, u);
        with_guide.add(next ? static_cast<double>(next->weight.x) : 0.0);
        without.add(plain ? static_cast<double>(plain->weight.x) : 0.0);
        recorded.add(shown ? static_cast<double>(shown->weight.x) : 0.0);
        from_the_right.add(next && frame.to_world(next->wi).x > 0.5f ? 1.0 : 0.0);
        if (plain && plain->pdf_over_unguided != 1.0f) ++changed_without_guide;
        if (!next || next->delta) continue;
        if (!is_near(guided.pdf(next->wi, frame.to_world(next->wi)), next->pdf)) ++rounded_away;
        if (!is_near(next->pdf_over_unguided, next->pdf / bsdf.pdf(wo, next->wi))) ++wrong_quotients;
        if (!is_near(next->weight.x, bsdf.evaluate(wo, next->wi).x / next->pdf)) ++wrong_weights;
    }
    CHECK(changed_without_guide == 0);
    CHECK(wrong_quotients == 0);
    CHECK(wrong_weights == 0);
    CHECK(rounded_away < 40);
    // Both find the same albedo, and an error of 1 % (2 % in the short form) would be detected.
    const auto p_value = [&](const Moments& other, double factor) {
        const double error = std::hypot(other.standard_error(), without.standard_error());
        return normal_two_sided((factor * other.mean() - without.mean()) / error);
    };
    CHECK(p_value(with_guide, 1) > significance);
    CHECK(p_value(with_guide, detected(1.01)) < significance);
    CHECK((recorded.mean() == doctest::Approx(without.mean()).epsilon(0.003)));
    CHECK(from_the_right.mean() > 0.5);
}

}  // namespace

TEST_CASE("half of the directions are guided, and the albedo is what it was") {
    const double significance = sidak(1e-4, 3);
    SUBCASE("diffuse") {
        check_guided(DiffuseBsdf(glm::vec3(0.7f)), significance);
    }
    SUBCASE("below a smooth coat") {
        const CoatingAlbedo coating(1.5f, 0.0f);
        check_guided(CoatedDiffuseBsdf(coating.at(0.0f), glm::vec3(0.7f)), significance);
    }
    SUBCASE("below a rough coat") {
        const CoatingAlbedo coating(1.5f, 0.3f);
        check_guided(CoatedDiffuseBsdf(coating.at(0.3f), glm::vec3(0.7f)), significance);
    }
}

TEST_CASE("light counts for the points that the path had left before, divided by the throughput that it had there") {
    PathGuideSamples of_path;
    std::vector<GuideSample> samples;
    of_path.add_light(100);  // directly visible to the camera
    of_path.leave({1, 0, 0}, 0, {0, 0, 1}, 2.0f, 0.5f);
    of_path.add_light(3);
    of_path.leave({2, 0, 0}, 1, {0, 1, 0}, 1.0f, 0.25f);
    of_path.add_light(1);
    of_path.leave({3, 0, 0}, 1, {0, 1, 0}, 1.0f, 0.25f);  // no light arrives from there
    of_path.take(samples);
    REQUIRE(samples.size() == 2);
    CHECK(samples[0].point.x == 1.0f);
    CHECK(samples[0].light == doctest::Approx((3 + 1) * 2.0 / 0.5));
    CHECK(samples[1].point.x == 2.0f);
    CHECK(samples[1].light == doctest::Approx(1 * 1.0 / 0.25));
    // The next path keeps nothing of this one.
    of_path.add_light(5);
    of_path.take(samples);
    CHECK(samples.size() == 2);
    // Only the first points of long paths count. Points without throughput do not count, nor does infinite light.
    samples.clear();
    of_path.leave({0, 0, 0}, 0, {0, 0, 1}, 1.0f, 0.0f);
    for (int i = 0; i < 40; ++i)
        of_path.leave({static_cast<float>(i), 0, 0}, 0, {0, 0, 1}, 1.0f, i == 3 ? 1e-38f : 1.0f);
    of_path.add_light(2);
    of_path.take(samples);
    CHECK(samples.size() == 15);
    for (const GuideSample& sample : samples) CHECK(sample.light == 2.0f);
}

TEST_CASE("in the next room paths that are guided find the same light with less noise") {
    const double significance = sidak(1e-4, 2);
    const bool is_long = phasetree::tests::long_tests();
    const std::uint32_t count = is_long ? 120'000 : 20'000;
    for (const bool with_photons : {false, true}) {
        CAPTURE(with_photons);
        const Scene scene = with_photons ? rooms(R"(, "caustics": true)") : guided_rooms().scene;
        std::optional<World> world_of_photons;
        if (with_photons) world_of_photons.emplace(scene);
        const World& world = with_photons ? *world_of_photons : guided_rooms().world;
        std::optional<Guide> guide = guided_rooms().guide;
        std::optional<Caustics> caustics;
        std::optional<PhotonMap> photons;
        PathHelp help;
        if (with_photons) {
            PathCounters counters;
            caustics.emplace(world, scene);
            photons = caustics->photons(0, counters, [] { return false; });
            help.photons = {&caustics->emission(), &*photons};
            guide = guide_for(world, scene, &*caustics);
        }
        REQUIRE(guide.has_value());
        const Moments alone = radiance_along(world, scene, in_the_dark, to_floor, count, 1, help)[0];
        help.guide = &*guide;
        const Moments guided = radiance_along(world, scene, in_the_dark, to_floor, count, 2, help)[0];
        const double error = std::hypot(alone.standard_error(), guided.standard_error());
        CAPTURE(guided.mean() / alone.mean());
        CAPTURE(error / alone.mean());
        CAPTURE(alone.variance() / guided.variance());
        CHECK(normal_two_sided((guided.mean() - alone.mean()) / error) > significance);
        CHECK(normal_two_sided(((is_long ? 1.1 : 1.25) * guided.mean() - alone.mean()) / error) < significance);
        CHECK(alone.variance() > 1.4 * guided.variance());
    }
}

TEST_CASE("paths that are guided see a radiance of 1 within walls that glow with what they do not reflect") {
    const Scene scene = scene_of(
        R"("wall": {"glowing": {"light": [0.3, 0.3, 0.3], "color": [0.7, 0.7, 0.7]}}, "glass": {"clear": {"ior": 1.5}},
           "ball": {"diffuse": {"color": [1, 1, 1]}})",
        R"({"over": [{"set": {"phase": "glass", "of": {"sphere": {"radius": 0.3}}}},
                     {"set": {"phase": "ball", "of": {"translate": {"by": [0.7, 0, 0], "of": {"sphere": {"radius": 0.2}}}}}},
                     {"set": {"phase": "wall", "of": {"difference": {"from": {"box": {"size": [3, 3, 3]}}, "subtract": [{"box": {"size": [2, 2, 2]}}]}}}}]})",
        R"("lights": [], "camera": {"position": [0, -0.9, 0], "look_at": [0, 0, 0], "fov": 90},
           "render": {"width": 32, "height": 32, "guiding": true, "max_depth": 10000})");
    const World world(scene);
    const std::optional<Guide> guide = guide_for(world, scene);
    const Moments m =
        radiance_along(world, scene, {0, -0.9f, 0}, {0.5f, 1, 0.3f}, samples_of(100'000), 3, {.guide = &*guide})[0];
    CHECK(mean_p_value(m, 1, 1e-5) > 1e-4);
    CHECK(mean_p_value(m, detected(1.01), 1e-5) < 1e-4);
    CHECK(m.standard_error() < 0.2 * (detected(1.01) - 1));
}

TEST_CASE("a guide that is wrong everywhere costs noise within bounds, and no light") {
    // In a white room, paths are long, and each direction could double a weight. The guide expects light from one side,
    // but it arrives from all sides.
    const Scene scene = scene_of(
        R"("wall": {"glowing": {"light": [0.05, 0.05, 0.05], "color": [0.95, 0.95, 0.95]}})",
        R"({"set": {"phase": "wall", "of": {"difference": {"from": {"box": {"size": [3, 3, 3]}}, "subtract": [{"box": {"size": [2, 2, 2]}}]}}}})",
        R"("lights": [], "camera": {"position": [0, -0.9, 0], "look_at": [0, 0, 0]}, "render": {"max_depth": 100000})");
    const World world(scene);
    Uniform random(11);
    std::vector<GuideSample> samples;
    for (int i = 0; i < 60'000; ++i) {
        glm::vec3 at = 2.0f * glm::vec3(random(), random(), random()) - 1.0f, normal(0.0f);
        normal[i % 3] = i % 2 == 0 ? 1.0f : -1.0f;
        at[i % 3] = -normal[i % 3];
        samples.push_back({at, facing_of(normal), glm::normalize(normal + glm::vec3(0.4f, 0.3f, 0.2f)), 1.0f});
    }
    const Guide guide(samples);
    const Moments m =
        radiance_along(world, scene, {0, -0.9f, 0}, {0.5f, 1, 0.3f}, samples_of(80'000), 3, {.guide = &guide})[0];
    CAPTURE(m.mean());
    CAPTURE(m.standard_error());
    CAPTURE(m.variance());
    CHECK(mean_p_value(m, 1, 1e-5) > 1e-4);
    CHECK(m.variance() < 20);
}

TEST_CASE("a guide that knows nothing changes no bit, and a good one does not change recorded albedos") {
    const auto& [scene, world, guide] = guided_rooms();
    const Guide nothing;
    PathCounters counters;
    const phasetree::FlushSubnormals flush;
    const Ray ray{in_the_dark, glm::normalize(to_floor), world.geometry().label(in_the_dark), {}};
    for (std::uint32_t i = 0; i < 2000; ++i) {
        std::array<PathRecord, 3> records;
        std::array<glm::vec3, 3> radiance;
        const std::array<const Guide*, 3> guides{nullptr, &nothing, &*guide};
        for (std::size_t k = 0; k < 3; ++k) {
            Sampler sampler(i, 0, 0, 1);
            radiance[k] = trace_path(world, scene, ray, sampler, counters, &records[k], {.guide = guides[k]});
        }
        REQUIRE(radiance[0] == radiance[1]);
        REQUIRE(records[0].first.has_value());
        REQUIRE(records[2].first->albedo == records[0].first->albedo);
    }
}

TEST_CASE("learning can be stopped, and then there is no picture") {
    const Scene scene = rooms();
    const World world(scene);
    std::atomic<double> most = 0;
    RenderJob job;
    job.pixels = scene.film.whole();
    job.learned = [&](double share) { most = std::max(most.load(), share); };
    job.cancelled = [&] { return most > 0.3; };
    const Rendering rendering = render(world, scene, job);
    CHECK(rendering.cancelled);
    CHECK(rendering.samples == 0);
    CHECK(most < 1);
    job.cancelled = [] { return false; };
    CHECK(render(world, scene, job).samples == 2);
    CHECK(most == 1);
}

}  // namespace test_guiding
