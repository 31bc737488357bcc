// Surfaces that are created once and kept from scene to scene.
#include "shading/shared_surfaces.hpp"

#include <doctest/doctest.h>

#include <optional>
#include <utility>

namespace test_shared_surfaces {

using namespace phasetree::tracer;

TEST_CASE("between scenes, surfaces in use are kept, and all others are recreated") {
    SharedSurfaces surfaces;
    const auto coating = [&](float ior) { return surfaces.coating(1, ior, ValueRange{0.2f, 0.2f}, std::nullopt); };
    const auto dielectric = [&](float ior) { return surfaces.dielectric(1, ior, std::nullopt, std::nullopt); };
    const auto used = coating(1.5f);
    const std::weak_ptr<const CoatingAlbedo> unused = coating(1.4f);
    const auto surface = dielectric(1.5f);
    const std::weak_ptr<const DielectricSurface> unused_surface = dielectric(1.4f);
    CHECK(coating(1.5f) == used);
    CHECK(dielectric(1.5f) == surface);
    REQUIRE_FALSE(unused.expired());
    REQUIRE_FALSE(unused_surface.expired());
    surfaces.begin_scene();
    CHECK(coating(1.5f) == used);
    CHECK(dielectric(1.5f) == surface);
    CHECK(unused.expired());
    CHECK(unused_surface.expired());
}

TEST_CASE("an interface of two dielectrics has the same bits in each scene, whichever side earlier scenes began with") {
    const std::optional<ValueRange> roughness = ValueRange{0.3f, 0.3f};
    constexpr float air = 1.0003f, glass = 1.523f, cosine = 0.37f;
    struct Bits {
        float eta, lost, lost_behind, transmitted;
        bool operator==(const Bits&) const = default;
    };
    const auto bits_of = [&](const DielectricSurface& surface) {
        const auto multiple = surface.multiple(0.3f);
        return Bits{surface.eta(), multiple.from.at(cosine).x, multiple.to.at(cosine).x, multiple.transmitted.x};
    };
    // Both sides of the interface, in the order in which they are requested.
    const auto scene = [&](SharedSurfaces& surfaces, bool begins_inside) {
        surfaces.begin_scene();
        const auto first = surfaces.dielectric(begins_inside ? glass : air, begins_inside ? air : glass, roughness, {});
        const auto second =
            surfaces.dielectric(begins_inside ? air : glass, begins_inside ? glass : air, roughness, {});
        return std::pair(first, second);
    };
    for (const bool begins_inside : {false, true}) {
        SharedSurfaces fresh, used;
        const auto expected = scene(fresh, begins_inside);
        const float ratio = begins_inside ? air / glass : glass / air;
        CHECK(expected.first->eta() == doctest::Approx(ratio));
        CHECK(expected.second->eta() == doctest::Approx(1 / ratio));
        const auto other_way = scene(used, !begins_inside);
        const auto same_way = scene(used, begins_inside);
        CHECK(bits_of(*same_way.first) == bits_of(*expected.first));
        CHECK(bits_of(*same_way.second) == bits_of(*expected.second));
        // Computed surfaces are reused.
        CHECK(scene(used, !begins_inside).first == other_way.first);
        CHECK(scene(used, begins_inside).first == same_way.first);
    }
    // A reversed surface differs from a computed one; otherwise the test would prove nothing.
    SharedSurfaces a, b;
    CHECK_FALSE(bits_of(*scene(a, false).second) == bits_of(*scene(b, true).first));
}

TEST_CASE("metals of one roughness share what they lose, and each grain has its own") {
    SharedSurfaces surfaces;
    const auto lost = [&](float eta, float roughness, float aspect) {
        const auto surface = surfaces.conductor(1, glm::vec3(eta), glm::vec3(3), ValueRange{roughness, roughness},
                                                std::nullopt, {}, aspect);
        return std::pair(surface, surface->multiple(roughness, {}).losses.at(glm::vec3(0.6f, 0.0f, 0.8f)).x);
    };
    const auto [gold, by_gold] = lost(0.2f, 0.5f, 1);
    const auto [iron, by_iron] = lost(2.9f, 0.5f, 1);
    const auto [brushed, by_brushed] = lost(2.9f, 0.5f, 0.2f);
    const auto [smoother, by_smoother] = lost(2.9f, 0.3f, 1);
    CHECK(gold != iron);
    CHECK(iron != brushed);
    CHECK(by_gold == by_iron);
    CHECK(by_brushed < 0.8f * by_iron);
    CHECK(by_smoother < 0.8f * by_iron);
}

}  // namespace test_shared_surfaces
