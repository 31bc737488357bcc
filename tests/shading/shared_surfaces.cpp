// Surfaces that are made once and kept from scene to scene.
#include "shading/shared_surfaces.hpp"

#include <doctest/doctest.h>

namespace test_shared_surfaces {

using namespace phasetree::tracer;

TEST_CASE("between scenes coatings that are in use stay, and all else is made anew") {
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
    // What is made of the other side of another surface might differ from it in its last bits.
    CHECK(dielectric() != surface);
}

}  // namespace test_shared_surfaces
