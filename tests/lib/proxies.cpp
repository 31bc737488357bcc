// What proxies, bounding volumes and levels of detail promise beyond what holds for every node (labels.cpp,
// lipschitz.cpp and bounds.cpp draw them, too): where the child alone counts, where the stand-in alone does, and that
// nothing jumps.
#include <doctest/doctest.h>

#include <functional>

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/copies/grid.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/displace.hpp"
#include "phasetree/nodes/fields/offset.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/layered.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/proxies/bounding_volume.hpp"
#include "phasetree/nodes/proxies/level_of_detail.hpp"
#include "phasetree/nodes/proxies/proxy.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/scale.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/twist.hpp"
#include "phasetree/tree/levels_of_detail.hpp"
#include "support/random_tree.hpp"

namespace test_proxies {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

const Phase stone{1}, moss{2};

Field rough_ball() {
    return Displace{.of = Sphere{.radius = 1}, .amplitude = 0.1f, .scale = 0.3f, .octaves = 2};
}

// The steepest slope of a function between near points.
double steepest(const std::function<double(const glm::vec3&)>& f) {
    Random rng(3);
    double most = 0;
    for (int i = 0; i < 40'000; ++i) {
        const glm::vec3 p = rng.in(Bounds::centred(glm::vec3(2)));
        const glm::vec3 q = p + 0.002f * rng.direction();
        most = std::max(most, std::abs(f(p) - f(q)) / static_cast<double>(glm::distance(p, q)));
    }
    return most;
}

}  // namespace

TEST_CASE("a bounding volume stands in from its margin on, and nothing jumps there") {
    const Field ball = rough_ball();
    const Field bounded = FieldBoundingVolume{{.of = ball, .volume = Sphere{.radius = 1.15f}, .margin = 0.2f}};
    Random rng(1);
    int far = 0, near = 0;
    for (int i = 0; i < 20'000; ++i) {
        const glm::vec3 p = rng.in(Bounds::centred(glm::vec3(2.5f)));
        const float volume = glm::length(p) - 1.15f, f = distance(ball, p), g = distance(bounded, p);
        if (volume >= 0.2f) {
            CHECK(g == doctest::Approx(volume).epsilon(1e-5));
            ++far;
        }
        // In the volume the child counts, as far as it is not beyond the volume's own depth or twice the margin.
        if (volume < 0 && f > volume && f < 0.4f) {
            CHECK(g == f);
            ++near;
        }
        CHECK((g < 0) == (f < 0));
    }
    CHECK(far > 5000);
    CHECK(near > 500);
    CHECK(steepest([&](const glm::vec3& p) { return distance(bounded, p); }) < 1.001);
    // The test can fail: a plain switch between both has a jump, which is detected.
    CHECK(steepest([&](const glm::vec3& p) {
              const float volume = glm::length(p) - 1.15f;
              return volume >= 0.2f ? volume : distance(ball, p);
          }) > 2);
}

TEST_CASE("the box that a bounding volume takes by itself changes no label of any object") {
    Random rng(2);
    std::size_t inside = 0;
    for (int n = 0; n < 60; ++n) {
        Phased object;
        do object = random_object(rng, 4);
        while (!bounds(object).finite() || bounds(object).empty());
        const float margin = rng.uniform(0.01f, 0.5f);
        const Phased bounded = PhasedBoundingVolume{{.of = object, .volume = {}, .margin = margin}};
        const Bounds region = bounds(object).inflated(0.3f);
        for (int i = 0; i < 400; ++i) {
            const glm::vec3 p = rng.in(region);
            const Phases<float> before = distances(object, p), after = distances(bounded, p);
            float first = Bounds::infinity, second = Bounds::infinity;
            for_each_phase(before.present, [&](int k) {
                second = std::min(second, std::max(first, before[k]));
                first = std::min(first, before[k]);
            });
            if (second < 2e-5f || (label(before) != vacuum && !bounds(object).contains(p))) continue;
            CHECK(label(before) == label(after));
            inside += label(before) != vacuum;
        }
    }
    CHECK(inside > 1000);
    CHECK_THROWS_AS(Phased(PhasedBoundingVolume{{.of = Set{stone, Offset{rough_ball(), -3}}}}), ModelError);
}

TEST_CASE("a proxy stands in on both sides, and fills an object with the phase it is told") {
    const Field ball = rough_ball(), plain = Sphere{.radius = 1};
    const Field field = FieldProxy{{.of = ball, .proxy = plain, .error = 0.12f, .margin = 0.1f}};
    const Phased object = PhasedProxy{{.of = Layered{.of = Set{stone, ball}, .phase = moss, .thickness = 0.05f},
                                       .proxy = plain,
                                       .error = 0.18f,
                                       .margin = 0.1f,
                                       .inside = PhaseSet::of(stone)}};
    Random rng(4);
    for (int i = 0; i < 10'000; ++i) {
        const glm::vec3 p = rng.in(Bounds::centred(glm::vec3(1.6f)));
        const float r = glm::length(p) - 1;
        CHECK((distance(field, p) < 0) == (distance(ball, p) < 0));
        if (r > 0.22f) CHECK(distance(field, p) == doctest::Approx(r - 0.12f).epsilon(1e-4));
        if (r < -0.22f) CHECK(distance(field, p) == doctest::Approx(r + 0.12f).epsilon(1e-4));
        if (r < -0.28f) CHECK(distances(object, p)[stone.index] == doctest::Approx(r + 0.18f).epsilon(1e-4));
    }
    CHECK(steepest([&](const glm::vec3& p) { return distance(field, p); }) < 1.001);
    CHECK_THROWS_AS(Field(FieldProxy{{.of = ball, .proxy = plain, .inside = PhaseSet::of(stone)}}), ModelError);
    CHECK_THROWS_AS(Phased(PhasedProxy{{.of = Set{stone, ball}, .proxy = plain, .inside = PhaseSet::of(vacuum)}}),
                    ModelError);
}

TEST_CASE("each level of detail stands between its distances, without a wall where both agree") {
    const Field fine = rough_ball(), coarse = Sphere{.radius = 1};
    const Field both =
        FieldLevelOfDetail{{.of = {fine, coarse}, .viewpoint = {3, 0, 0}, .distances = {3}, .errors = {}}};
    Random rng(5);
    for (int i = 0; i < 10'000; ++i) {
        const glm::vec3 p = rng.in(Bounds::centred(glm::vec3(1.4f)));
        const Field& there = glm::distance(p, glm::vec3(3, 0, 0)) < 3 ? fine : coarse;
        CHECK((distance(both, p) < 0) == (distance(there, p) < 0));
    }
    // Midway between both, on the sphere where one replaces the other, there is no zero.
    CHECK(distance(both, glm::vec3(0)) < -0.8f);
    CHECK(steepest([&](const glm::vec3& p) { return distance(both, p); }) < 1.001);
    CHECK_THROWS_AS(
        Field(FieldLevelOfDetail{{.of = {fine, coarse}, .viewpoint = {}, .distances = {1, 2}, .errors = {}}}),
        ModelError);
    CHECK_THROWS_AS(
        Field(FieldLevelOfDetail{{.of = {fine, coarse, coarse}, .viewpoint = {}, .distances = {2, 1}, .errors = {}}}),
        ModelError);
}

TEST_CASE("a view chooses the levels by how large their errors look, through what moves, turns and scales") {
    const float error = 0.02f, angle = 0.01f;  // the coarse level is used from distance 2 on, in the object's scale
    const Field fine = Sphere{.radius = 1}, coarse = Box{.size = glm::vec3(0.5f)};
    const Field levels =
        FieldLevelOfDetail{{.of = {fine, coarse}, .viewpoint = {}, .distances = {}, .errors = {error}}};
    const auto object = [&](Field of) { return Phased(Set{stone, std::move(of)}); };
    // Without a view, the finest level is used.
    CHECK(label(distances(object(levels), {0, 0, 0.9f})) == stone);

    const auto is_coarse = [&](const Phased& a, const glm::vec3& at, float scale) {
        // Within the ball and outside of the box.
        return label(distances(a, at + glm::vec3(0, 0, 0.9f * scale))) == vacuum;
    };
    for (const float away : {1.f, 1.8f, 2.3f, 5.f}) {
        for (const float scale : {0.25f, 1.f, 3.f}) {
            const glm::vec3 at(1, 2, 3), viewer = at + scale * away * glm::vec3(0.6f, 0.8f, 0);
            const Phased placed = object(
                warped(Translate{at}, warped(Scale{scale}, warped(Rotate{.axis = {0, 0, 1}, .angle = 70}, levels))));
            const Phased seen = with_levels_of_detail(placed, {viewer, angle});
            const float there = glm::distance(viewer, at + glm::vec3(0, 0, 0.9f * scale));
            CAPTURE(away);
            CAPTURE(scale);
            CHECK(is_coarse(seen, at, scale) == (there > 2 * scale));
        }
    }
    // If a node occurs in several places or is bent, the finest level stays, and the tree is unchanged.
    for (const Phased& kept : {object(FieldGrid{{{.of = levels}, glm::vec3(3), 2, 1, 1}}),
                               object(warped(Twist{.rate = 20}, levels)), object(fine)}) {
        CHECK(with_levels_of_detail(kept, {{0, 9, 0}, angle}) == kept);
    }
    CHECK_THROWS_AS(with_levels_of_detail(object(levels), {{0, 9, 0}, 0}), ModelError);
}

}  // namespace test_proxies
