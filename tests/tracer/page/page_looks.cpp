// How an exported page shows each kind of material of a scene.
#include <doctest/doctest.h>

#include <cmath>

#include "page/page.hpp"
#include "tracer/support/paths.hpp"

namespace test_page_looks {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

Look look_of_material(const std::string& material) {
    const Scene scene = scene_of("\"m\": " + material, R"({"set": {"phase": "m", "of": {"sphere": {"radius": 1}}}})");
    return look_of("m", scene.materials[1], phasetree::bounds(scene.object));
}

}  // namespace

TEST_CASE("a page shows each kind of material as what it is") {
    const Look glass = look_of_material(R"({"clear": {"ior": 1.5, "absorption": [1, 2, 3]}})");
    CHECK(glass.kind == Look::clear);
    CHECK(glass.ior == 1.5f);
    CHECK(glass.absorption == glm::vec3(1, 2, 3));
    const Look milk =
        look_of_material(R"({"clear": {"ior": 1.3, "albedo": [0.9, 0.9, 0.9], "mean_free_path": [1, 1, 1]}})");
    CHECK(milk.kind == Look::diffuse);
    CHECK(milk.color.x > 0.2f);
    // A little haze hides nothing.
    const Look ice =
        look_of_material(R"({"clear": {"ior": 1.3, "absorption": [1, 0, 0], "scattering": [0.1, 0.1, 0.1]}})");
    CHECK(ice.kind == Look::clear);
    CHECK(ice.absorption.x == doctest::Approx(1.1));
    // A varying density is shown by its mean. For 1 − |p| in the ball of radius 1, the mean in the cube around it is
    // π/24.
    const Look ink = look_of_material(R"({"clear": {"ior": 1.3, "absorption": [2, 1, 0], "scattering": [1, 1, 1],
                                          "density": {"sphere": {"radius": 1}}, "density_depth": 1}})");
    CHECK(ink.kind == Look::clear);
    CHECK(ink.absorption.x == doctest::Approx(3 * 3.14159265 / 24).epsilon(0.02));
    const Look flame = look_of_material(R"({"clear": {"ior": 1, "absorption": [2, 2, 2], "emission": [40, 20, 4]}})");
    CHECK(flame.kind == Look::glowing);
    CHECK(flame.color.x == doctest::Approx(3));
    CHECK(flame.color.z == doctest::Approx(0.3));
    const Look paper = look_of_material(R"({"diffuse": {"color": [0.1, 0.2, 0.3]}})");
    CHECK(paper.kind == Look::diffuse);
    CHECK(paper.color.z == doctest::Approx(0.3));
    const Look varnish = look_of_material(R"({"coated": {"color": [0.1, 0.2, 0.3]}})");
    CHECK(varnish.kind == Look::coated);
    CHECK(varnish.color.z == doctest::Approx(0.3));
    const Look layers = look_of_material(R"({"principled": {"base_color": [0.1, 0.2, 0.6], "base_weight": 0.5}})");
    CHECK(layers.kind == Look::coated);
    CHECK(layers.color.z == doctest::Approx(0.3));
    CHECK(look_of_material(R"({"principled": {"base_metalness": 1}})").kind == Look::metal);
    CHECK(look_of_material(R"({"principled": {"emission_radiance": 5}})").kind == Look::glowing);
    const Look gold = look_of_material(R"({"conductor": {"metal": "gold"}})");
    CHECK(gold.kind == Look::metal);
    CHECK(gold.color.x > gold.color.z);
    // A page shows the colour of a light, but not its intensity.
    const Look ember = look_of_material(R"({"glowing": {"light": [1, 0.5, 0.1], "radiance": 1000}})");
    CHECK(ember.kind == Look::glowing);
    CHECK(ember.color.x == doctest::Approx(3));
    CHECK(ember.color.z == doctest::Approx(0.3));
}

TEST_CASE("swatches are sRGB codes, each the nearest") {
    const auto exact = [](double v) {
        return std::lround(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055));
    };
    for (int i = 0; i <= 1000; ++i) {
        const float v = static_cast<float>(i) / 1000;
        Look look;
        look.kind = Look::diffuse;
        look.color = {v, v * v, v / 100};
        const std::array<int, 3> codes = shown_color(look);
        for (int c = 0; c < 3; ++c) CHECK(codes[static_cast<std::size_t>(c)] == exact(look.color[c]));
    }
    Look glowing;
    glowing.kind = Look::glowing;
    glowing.color = {3, 1, -1};
    CHECK(shown_color(glowing) == std::array<int, 3>{255, 255, 0});
}

}  // namespace test_page_looks
