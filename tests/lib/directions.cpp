// Directions that a node normalises may have any length.
#include <doctest/doctest.h>

#include <cmath>

#include "phasetree/io/write.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/plane.hpp"
#include "phasetree/nodes/fields/polyhedron.hpp"
#include "phasetree/nodes/fields/slab.hpp"
#include "phasetree/nodes/phased/layers.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/strata.hpp"
#include "phasetree/nodes/warps/mirror.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "support/random_tree.hpp"

namespace test_directions {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

void check_written(const Phased& tree) {
    const std::string text = write_tree({{{"vacuum", "a", "b"}}, tree});
    CHECK(write_tree(read_tree(Document::from_text(text))) == text);
}

}  // namespace

TEST_CASE("a direction whose coordinates differ by more than numbers reach is written as it is read") {
    for (const float size : {1e37f, 3.4e38f}) {
        const glm::vec3 d(-0.5f, 1e-3f, size);
        check_written(Set{.phase = Phase{1}, .of = Plane{.normal = d}});
        check_written(Set{.phase = Phase{1}, .of = Slab{.normal = d}});
        check_written(Set{.phase = Phase{1}, .of = warped(Mirror{.normal = d}, Field(Box{}))});
        check_written(Set{.phase = Phase{1}, .of = warped(Rotate{.axis = d, .angle = 40}, Field(Box{}))});
        check_written(
            Set{.phase = Phase{1},
                .of = Polyhedron{.normals = {d, -d, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, .offsets = {1}}});
    }
}

TEST_CASE("a direction of any length is that of length one, also where its square is no float") {
    const auto moved = [](auto warp) { return Phased(Set{.phase = Phase{1}, .of = warped(warp, Field(Box{}))}); };
    const auto solid = [](auto field) { return Phased(Set{.phase = Phase{1}, .of = std::move(field)}); };
    const std::vector<Phase> both{Phase{1}, Phase{2}};
    const auto trees = [&](float length) {
        const glm::vec3 d = length * glm::vec3(0.36f, -0.48f, 0.8f);
        return std::vector<Phased>{
            solid(Plane{.normal = d, .offset = 0.2f}),
            solid(Plane{.normal = {0, 0, length}, .offset = 0.2f}),
            solid(Slab{.normal = d, .offset = 0.1f, .thickness = 0.5f}),
            solid(Polyhedron{.normals = {d, -d, {length, 0, 0}, {-length, 0, 0}, {0, length, 0}, {0, -length, 0}},
                             .offsets = {0.7f}}),
            moved(Mirror{.normal = d}),
            moved(Rotate{.axis = d, .angle = 40}),
            Strata{.of_phases = both, .thicknesses = {0.2f}, .direction = d},
            Layers{.of_phases = both, .thicknesses = {0.2f, 0.3f}, .direction = d},
        };
    };
    const std::vector<Phased> expected = trees(1);
    for (const float length : {1e-37f, 1e-25f, 1e-20f, 1e-10f, 0.5f, 1e10f, 1e20f, 1e37f}) {
        CAPTURE(length);
        const std::vector<Phased> scaled = trees(length);
        for (std::size_t i = 0; i < scaled.size(); ++i) {
            CAPTURE(i);
            Random rng(93);
            for (int n = 0; n < 50; ++n) {
                const glm::vec3 p = glm::vec3(rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-2, 2));
                const Phases<float> a = distances(scaled[i], p), b = distances(expected[i], p);
                for_each_phase(b.present, [&](int k) { REQUIRE(std::abs(a[k] - b[k]) < 1e-6f); });
            }
            check_written(scaled[i]);
        }
    }
}

}  // namespace test_directions
