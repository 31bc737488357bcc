// Tests maps of space that are declared affine, and their composition. Results must agree to the last bit, because a
// cell's program applies in one instruction what the whole object's program applies in several.

#include "phasetree/math/affine_map.hpp"

#include <doctest/doctest.h>

#include <bit>
#include <cstdint>
#include <type_traits>

#include "phasetree/nodes/list.hpp"
#include "support/random_tree.hpp"

namespace test_affine_maps {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

template <class Map>
glm::vec3 image(const Map& map, const glm::vec3& p) {
    const Vec3<float> q = map(Vec3<float>{p.x, p.y, p.z});
    return {q.x, q.y, q.z};
}

/// Zeros of either sign are the same.
bool is_same(const glm::vec3& a, const glm::vec3& b) {
    for (int i = 0; i < 3; ++i)
        if (std::bit_cast<std::uint32_t>(a[i] + 0.f) != std::bit_cast<std::uint32_t>(b[i] + 0.f)) return false;
    return true;
}

glm::vec3 somewhere(Random& rng) {
    return {rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-3, 3)};
}

/// Every affine map of the list, with random numbers in it.
template <class F>
void for_each_affine_map(Random& rng, F&& f) {
    const glm::vec3 v = somewhere(rng);
    const float angle = rng.uniform(-180, 180);
    const auto made = [](auto node) {
        prepare(node);
        return node.map();
    };
    f(made(Translate{v}));
    f(made(Rotate{.axis = rng.direction(), .angle = angle}));
    f(made(Scale{rng.uniform(0.1f, 3)}));
    f(made(Stretch{{rng.uniform(0.1f, 3), rng.uniform(0.1f, 3), rng.uniform(0.1f, 3)}}));
    f(made(Affine{.x = {1, 0.3f, 0}, .y = {-0.2f, 1.5f, 0.1f}, .z = {0.4f, 0, 0.7f}, .by = v}));
    f(Placement::at(v, static_cast<double>(angle), rng.uniform(0.1f, 3)).map);
    f(Placement::standing(v, glm::dvec3(rng.direction()), static_cast<double>(angle), 0.7f).standing_map());
}

}  // namespace

TEST_CASE("an affine map is equal to what it says it is") {
    Random rng(5);
    for (int k = 0; k < 200; ++k) {
        for_each_affine_map(rng, [&](const auto& map) {
            for (int i = 0; i < 20; ++i) {
                const glm::vec3 p = somewhere(rng);
                CHECK(is_same(image(map, p), image(map.affine(), p)));
            }
        });
    }
    // No affine map of the list is missing.
    for_each_type(PointMaps(), [&]<class M>() {
        bool is_tried = !AffinePointMap<M>;
        for_each_affine_map(rng, [&](const auto& map) { is_tried |= std::is_same_v<std::decay_t<decltype(map)>, M>; });
        CHECK(is_tried);
    });
}

TEST_CASE("maps that are composed do what they did one after the other") {
    Random rng(6);
    std::size_t composed = 0, thrice = 0, tried = 0;
    for (int k = 0; k < 100; ++k)
        for_each_affine_map(rng, [&](const auto& first) {
            for_each_affine_map(rng, [&](const auto& second) {
                ++tried;
                const auto both = first.affine().then(second.affine());
                if (!both) return;
                ++composed;
                const Translate::Map third{somewhere(rng)};
                const auto all = both->then(third.affine());
                thrice += all.has_value();
                for (int i = 0; i < 5; ++i) {
                    const glm::vec3 p = somewhere(rng), q = image(second, image(first, p));
                    CHECK(is_same(q, image(*both, p)));
                    if (all) CHECK(is_same(image(third, q), image(*all, p)));
                }
            });
        });
    // There is room for one translation before a rotation and one after it.
    CHECK(composed > tried / 10);
    CHECK(composed < tried);
    CHECK(thrice > 0);
}

}  // namespace test_affine_maps
