// Applies changes requested in the live view to a scene. server.py tests through the server that the picture equals
// that of a file with the same content.
#include "view/edits.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "scene/scene.hpp"

namespace test_edits {

using namespace phasetree;
using namespace phasetree::tracer;

namespace {

Scene ball(const std::string& material) {
    return read_scene(Document::from_text(R"({"version": 1, "phases": {"glass": )" + material + R"(},
        "tree": {"set": {"phase": "glass", "of": {"sphere": {"radius": 2}}}}, "lights": [{"constant": {}}],
        "camera": {"position": [0, -9, 0], "look_at": [0, 0, 0]}})",
                                          "ball.json"));
}

Clear edited_to(const view::Look& look, const std::string& material = R"({"clear": {"glass": "sf11"}})") {
    view::Edits edits;
    edits.looks["glass"] = look;
    return std::get<Clear>(view::edited(ball(material), edits).materials[1]);
}

}  // namespace

TEST_CASE("an index or a roughness of one's own ends a glass's dispersion, and a colour does not") {
    const Clear coloured = edited_to({.color = glm::vec3(0.5f, 0.8f, 0.9f)});
    REQUIRE(coloured.dispersion);
    CHECK(coloured.ior == doctest::Approx(1.7847).epsilon(1e-4));
    const Clear bent = edited_to({.ior = 1.5f});
    CHECK_FALSE(bent.dispersion);
    CHECK(bent.ior == 1.5f);
    CHECK_FALSE(edited_to({.roughness = 0.2f}).dispersion);
}

TEST_CASE("a clear phase's colour is what is left of light after half the diagonal of the object's box") {
    const Clear coloured = edited_to({.color = glm::vec3(0.5f, 0.8f, 0.9f)});
    const auto* medium = std::get_if<AbsorbingMedium>(&coloured.interior);
    REQUIRE(medium);
    // The box is a cube of side 4.
    const float half = 2 * std::sqrt(3.0f);
    CHECK(std::exp(-medium->absorption.rgb().x * half) == doctest::Approx(0.5).epsilon(1e-4));
    CHECK(std::exp(-medium->absorption.rgb().z * half) == doctest::Approx(0.9).epsilon(1e-4));
}

TEST_CASE("an opaque phase made clear keeps its index, and the width of its gloss") {
    const view::Look clear{.is_clear = true};
    const Clear varnish = edited_to(clear, R"({"coated": {"color": [0.5, 0.5, 0.5], "ior": 1.7, "roughness": 0.25}})");
    CHECK(varnish.ior == 1.7f);
    CHECK(std::get<float>(varnish.roughness) == 0.25f);
    // Roughness 0.5 of `principled` is α = 0.25 as well.
    const std::string glossy = R"({"principled": {"specular_ior": 1.7, "specular_roughness": 0.5}})";
    const Clear layers = edited_to(clear, glossy);
    CHECK(layers.ior == 1.7f);
    CHECK(std::get<float>(layers.roughness) == 0.25f);
    // The page shows the same numbers.
    const view::Optics shown = view::looking(view::optics_of(ball(glossy).materials[1], 1), clear);
    CHECK(shown.ior == 1.7f);
    CHECK(shown.roughness == 0.25f);
}

TEST_CASE("every kind of material tells its name and what of it can be changed") {
    struct Case {
        const char *material, *kind;
        bool has_color, has_ior, has_roughness;
    };
    const view::Look look{.color = glm::vec3(0.25f), .ior = 1.25f, .roughness = 0.75f};
    for (const Case& c : {Case{R"({"clear": {"ior": 1.5}})", "clear", true, true, true},
                          Case{R"({"diffuse": {"color": [0.5, 0.5, 0.5]}})", "diffuse", true, false, true},
                          Case{R"({"conductor": {"metal": "gold"}})", "conductor", false, false, true},
                          Case{R"({"coated": {"color": [0.5, 0.5, 0.5]}})", "coated", true, true, true},
                          Case{R"({"principled": {"coat_weight": 1}})", "principled", true, true, true}}) {
        CAPTURE(c.material);
        const view::Optics optics = view::optics_of(ball(c.material).materials[1], 1);
        CHECK(optics.kind == c.kind);
        CHECK(optics.has_color == c.has_color);
        CHECK(optics.ior.has_value() == c.has_ior);
        CHECK(optics.has_roughness == c.has_roughness);
        // What a material does not have is not given to it.
        const view::Optics changed = view::looking(optics, look);
        CHECK((changed.color == look.color) == c.has_color);
        CHECK((changed.ior == look.ior) == c.has_ior);
        CHECK((changed.roughness == look.roughness) == c.has_roughness);
    }
}

}  // namespace test_edits
