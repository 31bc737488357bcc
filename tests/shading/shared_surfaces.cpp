// Surfaces that are created once and kept from scene to scene.
#include "shading/shared_surfaces.hpp"

#include <doctest/doctest.h>

#include <utility>

namespace test_shared_surfaces {

using namespace phasetree::tracer;

TEST_CASE("between scenes coatings that are in use stay, and all else is recreated") {
    SharedSurfaces surfaces;
    const auto coating = [&](float ior) { return surfaces.coating(1, ior, ValueRange{0.2f, 0.2f}, std::nullopt); };
    const auto dielectric = [&] { return surfaces.dielectric(1, 1.5f, std::nullopt, std::nullopt); };
    const auto used = coating(1.5f);
    const std::weak_ptr<const CoatingAlbedo> unused = coating(1.4f);
    const auto surface = dielectric();
    CHECK(coating(1.5f) == used);
    CHECK(dielectric() == surface);
    REQUIRE_FALSE(unused.expired());
    surfaces.begin_scene();
    CHECK(coating(1.5f) == used);
    CHECK(unused.expired());
    // A surface derived from the other side of another one might differ in its last bits.
    CHECK(dielectric() != surface);
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
