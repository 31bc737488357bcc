// The layered material `principled` in scenes: the meaning of its parameters, a furnace with all techniques of the
// integrator, emission, and scenes that are rejected. tests/shading/principled.cpp has its BSDF.
#include <doctest/doctest.h>

#include <string>

#include "tracer/scene/scene_cases.hpp"
#include "tracer/support/paths.hpp"

namespace test_layers {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

const std::string ball = R"({"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}})";

std::string phase(const std::string& parameters) {
    return R"("a": {"principled": {)" + parameters + "}}";
}

Material material(const std::string& parameters) {
    const auto document = phasetree::Document::from_text(R"({"principled": {)" + parameters + "}}");
    return read_material(document, document.root());
}

std::string said(const std::string& parameters) {
    try {
        (void)scene_of(phase(parameters), ball);
    } catch (const phasetree::SceneError& e) {
        return std::string(e.message());
    }
    return "read";
}

}  // namespace

TEST_CASE("layers in a white environment are white, by all techniques together") {
    for (const char* const parameters :
         {R"("base_color": [1, 1, 1], "specular_roughness": 0.5)",
          R"("base_color": [1, 1, 1], "base_metalness": 0.5, "base_diffuse_roughness": 0.7, "coat_weight": 0.6)",
          R"("base_color": [1, 1, 1], "base_metalness": 1, "grain_along": [1, 0, 0], "fuzz_weight": 0.8)",
          R"("base_color": [1, 1, 1], "coat_weight": 1, "coat_roughness": 0.5, "film_thickness": 300)"}) {
        CAPTURE(parameters);
        const Scene scene = scene_of(phase(parameters), ball);
        const World world(scene);
        for (const glm::vec3& direction : {glm::vec3(0, 1, 0), glm::vec3(0.1f, 1, 0.15f)}) {
            const Moments m = radiance_along(world, scene, {0, -5, 0}, direction, 40000)[0];
            CAPTURE(m.mean());
            CHECK(std::abs(m.mean() - 1.0) < 0.002 + 4 * m.standard_error());
        }
    }
}

TEST_CASE("layers emit as `glowing` does") {
    const std::string tree = R"({"over": [
        {"set": {"phase": "a", "of": {"translate": {"by": [0, 0, 2], "of": {"sphere": {"radius": 0.5}}}}}},
        {"set": {"phase": "floor", "of": {"translate": {"by": [0, 0, -0.5], "of": {"box": {"size": [8, 8, 1]}}}}}}]})";
    const std::string floor = R"(, "floor": {"diffuse": {"color": [0.5, 0.5, 0.5]}})", dark = R"("lights": [])";
    const auto brightness = [&](const std::string& lamp) {
        const Scene scene = scene_of(lamp + floor, tree, dark);
        CHECK(scene.is_emissive());
        const World world(scene);
        return radiance_along(world, scene, {0, 3, 1}, {0, -3, -1}, 20000)[0].mean();
    };
    const double glowing = brightness(R"("a": {"glowing": {"radiance": 8}})");
    const std::string black = R"("base_weight": 0, "specular_weight": 0, "emission_radiance": )";
    CHECK(brightness(phase(black + "8")) == doctest::Approx(glowing).epsilon(1e-5));
    CHECK(brightness(phase(black + "8.1")) > 1.01 * glowing);
}

TEST_CASE("what layers are made of") {
    CHECK(has_metal(material(R"("base_metalness": 1)")));
    CHECK_FALSE(has_metal(material(R"("base_metalness": 0.9)")));
    CHECK_FALSE(has_metal(material(R"("base_metalness": 1, "coat_weight": 0.5)")));
    CHECK_FALSE(has_metal(material(R"("base_metalness": 1, "fuzz_weight": 0.5)")));
    CHECK_FALSE(glows(material("")));
    CHECK(glows(material(R"("emission_radiance": 1)")));
    CHECK_FALSE(glows(material(R"("emission_radiance": 1, "emission_color": [0, 0, 0])")));
    CHECK_FALSE(needs_tangents(material(R"("grain_along": [1, 0, 0])")));
}

TEST_CASE("impossible layers are rejected") {
    // Every number and colour of the layers may be an image on a mesh, but none on a phase.
    for (const char* const key :
         {"base_color", "base_weight", "base_metalness", "base_diffuse_roughness", "specular_color",
          "specular_roughness", "coat_color", "coat_weight", "coat_roughness", "coat_darkening", "fuzz_color",
          "fuzz_weight", "fuzz_roughness", "film_weight", "film_thickness"}) {
        CAPTURE(key);
        const std::string image = fmt::format("\"{}\": {{\"mesh_image\": {{\"file\": \"{}\"}}}}", key,
                                              (phasetree::tests::folder() / "sky.hdr").string());
        const std::string film = key == std::string("film_weight") ? R"(, "film_thickness": 100)" : "";
        CHECK(said(image + film).find("\"mesh_image\" works only on meshes") != std::string::npos);
    }
    CHECK(said(R"("specular_roughness": 0, "grain_along": [1, 0, 0])") ==
          "a grain needs a rough surface; give it a \"specular_roughness\", which applies across the grain");
    CHECK(said(R"("bump_height": 1)").find("requires \"bump\"") != std::string::npos);
    CHECK(said(R"("base_metalness": 1.5)").find("base_metalness") != std::string::npos);
    CHECK(said(R"("coat_wieght": 1)").find("coat_wieght") != std::string::npos);
    CHECK(said(R"("emission_radiance": 1, "group": "")") != "read");
    const std::string mixed =
        R"({"mix": {"first": {"principled": {"emission_radiance": 1}}, "second": {"diffuse": {"color": [1, 1, 1]}}}})";
    const auto document = phasetree::Document::from_text(mixed);
    CHECK_THROWS_AS((void)read_material(document, document.root()), phasetree::SceneError);
}

}  // namespace test_layers
