// `phasetree import`: the scenes that it makes of small glTF files, and what it reports as lost.
#include "imports.hpp"

namespace test_import {

using namespace phasetree::tests;
using namespace phasetree::tests::imports;

TEST_CASE("a drink becomes phases: glass keeps its wall, ice its part of the water; the table stays a mesh") {
    const Import shell;
    const Outcome o = shell.import_well(drink());
    CHECK(o.err == "");
    // 0.3 mm at the walls, and up to √3 times that at corners.
    CHECK(has(o.out, "\"Drink\" and \"Cup\" overlap by up to 0.000"));
    CHECK(has(o.out, " m; \"Cup\" wins (solid over liquid)\n"));
    CHECK(has(o.out, "\"Drink\" and \"Cube\" overlap by up to 0.002 m; \"Cube\" wins (solid over liquid)\n"));
    CHECK(shell.phases_at({{0.009f, 0.015f, 0},
                           {0.0081f, 0.005f, 0},
                           {0.0079f, 0.005f, 0},
                           {0, 0.0018f, 0.001f},
                           {0, 0.005f, 0},
                           {0, 0.011f, 0},
                           {0, 0.013f, 0},
                           {0.004f, 0.013f, 0.001f},
                           {0, -0.005f, 0},
                           {0.001f, 0.011f, -0.0081f}}) == "Glass Glass Water Glass Water Ice Ice vacuum vacuum Glass");
    const Json scene = shell.scene();
    CHECK(scene["meshes"] == Json::parse(R"([{"gltf": {"file": "in.glb", "imported": true}}])"));
    CHECK(scene["camera"] == Json::parse(R"({"position": [0, -0.1, 0.01], "look_at": [0, 0, 0.01], "fov": 28.6479})"));
    CHECK(scene["render"]["width"] == 1152);
    CHECK(scene["tree"]["over"].size() == 3);
    const Outcome render = shell.run({"render", "out.json", "--size", "12x8", "--spp", "2", "-o", "a.png", "--quiet"});
    CHECK(render.code == 0);
    CHECK(render.err == "");
    // Readable layout: no line is longer than people write it, and no line consists of a bracket that could end the
    // previous one.
    const std::string text = bytes_of(shell.directory / "out.json");
    CHECK(has(text,
              "\n  \"tree\": {\"over\": [\n    {\"set\": {\"phase\": \"Glass\", \"of\": {\"mesh\": {\"file\": "
              "\"out.meshes/Cup.ply\"}}}},\n"));
    // The mesh alone, without the word of the import, names the command.
    std::string alone = text;
    alone.replace(alone.find(", \"imported\": true"), 18, "");
    write_text(shell.directory / "alone.json", alone);
    CHECK(has(shell.run({"check", "alone.json"}).err, "use \"phasetree import\" to make it a phase"));
}

TEST_CASE("what clear materials have is in the scene, and what is lost is reported") {
    const Import shell;
    Gltf g;
    const auto add = [&](std::size_t material) {
        const float x = 3 * static_cast<float>(material);
        g.node(fmt::format("box {}", material), g.mesh(box({x, 0, 0}, {x + 1, 1, 1}), material));
    };
    add(g.clear("tinted", 1.6f,
                {{"volume", {{"attenuationColor", {0.5, 0.25, 1}}, {"attenuationDistance", 0.02}}},
                 {"dispersion", {{"dispersion", 0.5}}}}));
    add(g.clear("rough", 1.5f, {{"dispersion", {{"dispersion", 0.5}}}},
                {{"pbrMetallicRoughness", {{"roughnessFactor", 0.5}}}}));
    add(g.clear("film", 1.5f,
                {{"iridescence", {{"iridescenceFactor", 1}, {"iridescenceThicknessMaximum", 300}}},
                 {"specular", {{"specularFactor", 1}}}}));
    add(g.clear("colored", 1.5f, {{"specular", {{"specularFactor", 0.5}}}, {"clearcoat", {{"clearcoatFactor", 1}}}},
                {{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 1, 1, 1}}}}, {"emissiveFactor", {1, 0, 0}}}));
    add(g.clear("vacuum", 0.5f));
    const Outcome o = shell.import_well(g);
    const Json phases = shell.scene()["phases"];
    CHECK(phases["tinted"] == Json::parse(R"({"clear": {"ior": 1.6, "abbe_number": 40, "color": [0.5, 0.25, 1],
        "color_distance": 0.02}})"));
    CHECK(phases["rough"] == Json::parse(R"({"clear": {"ior": 1.5, "roughness": 0.25}})"));
    CHECK(phases["film"] == Json::parse(R"({"clear": {"ior": 1.5, "film_thickness": 300, "film_ior": 1.3}})"));
    // The mean chord of a unit cube is 2/3: light that crosses it is as red as by two surfaces that halve red.
    CHECK(phases["colored"] == Json::parse(R"({"clear": {"ior": 1.5, "absorption": [2.07944, 0, 0]}})"));
    CHECK(phases["vacuum 2"] == Json::parse(R"({"clear": {"ior": 1}})"));
    CHECK(shell.scene()["render"]["spectral"] == true);
    CHECK(has(o.err, "\"rough\" loses its dispersion, which only smooth materials"));
    CHECK(has(o.err, "\"colored\" loses the strength and colour of specular reflection (KHR_materials_specular)"));
    CHECK(has(o.err, "\"colored\" loses clear coats (KHR_materials_clearcoat)"));
    CHECK(has(o.err, "\"colored\" emits light at its surface, which is ignored"));
    CHECK(has(o.err, "\"colored\" has a base colour that tints its surface"));
    CHECK(has(o.err, "\"vacuum\" has the index 0.5, which no clear substance has; 1 is used"));
    CHECK_FALSE(has(o.err, "\"tinted\""));
    CHECK_FALSE(has(o.err, "\"film\""));
}

TEST_CASE("instances, mirrored nodes, skins and morph targets are where they are in the file") {
    const Import shell;
    Gltf g;
    const std::size_t glass = g.clear("Glass", 1.5f);
    const std::size_t wedge = g.mesh(box({0, 0, 0}, {1, 1, 2}), glass);
    g.node("same", wedge, {{"translation", {10, 0, 0}}});
    g.node("same", wedge, {{"translation", {20, 0, 0}}});
    g.node("mirrored", wedge, {{"translation", {30, 0, 0}}, {"scale", {-1, 1, 1}}});
    g.node("turned", wedge, {{"translation", {40, 0, 0}}, {"rotation", {0, 0.70710678, 0, 0.70710678}}});
    // All of it moves 5 up.
    Json morphed = g.primitive(box({50, 0, 0}, {51, 1, 1}), glass);
    std::vector<float> up(3 * 24, 0.0f);
    for (std::size_t i = 1; i < up.size(); i += 3) up[i] = 10;
    morphed["targets"] = {{{"POSITION", g.accessor(up, "VEC3", 3, 5126)}}};
    g.node("morphed", g.add("meshes", {{"primitives", {morphed}}, {"weights", {0.5}}}));
    // All of it goes with a joint 7 up.
    Json skinned = g.primitive(box({60, 0, 0}, {61, 1, 1}), glass);
    skinned["attributes"]["JOINTS_0"] = g.accessor(std::vector<std::uint8_t>(4 * 24, 0), "VEC4", 4, 5121);
    std::vector<float> weights(4 * 24, 0.0f);
    for (std::size_t i = 0; i < weights.size(); i += 4) weights[i] = 1;
    skinned["attributes"]["WEIGHTS_0"] = g.accessor(weights, "VEC4", 4, 5126);
    const std::size_t joint = g.add("nodes", {{"translation", {0, 7, 0}}});
    g.json["scenes"][0]["nodes"].push_back(joint);
    g.add("skins", {{"joints", {joint}}});
    g.node("skinned", g.add("meshes", {{"primitives", {skinned}}}), {{"skin", 0}, {"translation", {0, 100, 0}}});
    const Outcome o = shell.import_well(g);
    CHECK(o.err == "");
    CHECK(shell.phases_at({{10.5f, 0.5f, 1.5f},
                           {20.5f, 0.5f, 1.5f},
                           {29.5f, 0.5f, 1.5f},
                           {30.5f, 0.5f, 1.5f},
                           {41.5f, 0.5f, -0.5f},
                           {40.5f, 0.5f, 1.5f},
                           {50.5f, 5.5f, 0.5f},
                           {50.5f, 0.5f, 0.5f},
                           {60.5f, 7.5f, 0.5f},
                           {60.5f, 0.5f, 0.5f}}) == "Glass Glass Glass vacuum Glass vacuum Glass vacuum Glass vacuum");
    CHECK(fs::exists(shell.directory / "out.meshes/same.ply"));
    CHECK(fs::exists(shell.directory / "out.meshes/same_2.ply"));
    // One phase, and one "set" of all of them.
    CHECK(shell.scene()["phases"].size() == 1);
    CHECK(shell.scene()["tree"]["set"]["of"]["union"].size() == 6);
}

TEST_CASE("what is no solid is left out, by its name") {
    const Import shell;
    Gltf g;
    Surface sheet;
    sheet.add({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    Surface open;
    open.add_tray({5, 0, 0}, {6, 1, 1}, true);
    const std::size_t glass = g.clear("glass", 1.5f);
    const std::size_t pane = g.material("pane", {{"transmission", {{"transmissionFactor", 1}}}});
    g.node("Sheet", g.mesh(sheet, glass));
    g.node("Tray", g.mesh(open, glass));
    g.node("Window", g.mesh(box({10, 0, 0}, {11, 1, 1}), pane));
    const Outcome o = shell.import_well(g);
    CHECK(has(o.err, "warning: in.glb: mesh: \"Sheet\" is a sheet that encloses nothing"));
    CHECK(
        has(o.err, "\"Tray\" is not closed: 4 edges belong to an odd number of triangles; its holes have been filled"));
    CHECK(has(o.err,
              "clear materials without volume (KHR_materials_volume) become panes of \"thin_glass\"; use --solid if "
              "their objects are closed and solid"));
    CHECK(shell.scene()["meshes"][0]["gltf"]["panes"] == true);
    CHECK(shell.phases_at({{5.5f, 0.5f, 0.5f}, {10.5f, 0.5f, 0.5f}}) == "glass vacuum");
    (void)shell.import_well(g, {"--solid"});
    CHECK(shell.phases_at({{5.5f, 0.5f, 0.5f}, {10.5f, 0.5f, 0.5f}}) == "glass pane");
    // Nothing else is in the file.
    Gltf only;
    only.node("Sheet", only.mesh(sheet, only.clear("glass", 1.5f)));
    const Outcome none = shell.import(only, {"--force"});
    CHECK(none.code == 2);
    CHECK(has(none.err, "phasetree: in.glb: nothing can be imported"));
    CHECK(has(none.err, "\"Sheet\" is a sheet that encloses nothing"));
    // Without clear objects a scene has meshes alone.
    Gltf plain;
    plain.node("Table", plain.mesh(box({0, 0, 0}, {1, 1, 1}), plain.material("wood")));
    CHECK(has(shell.import_well(plain).out, "no clear objects"));
    CHECK_FALSE(shell.scene().contains("tree"));
    CHECK(shell.run({"render", "out.json", "--size", "4x3", "--spp", "1", "-o", "a.png", "--quiet"}).code == 0);
}

TEST_CASE("materials of one node are solids of their own, unless only together they are closed") {
    const Import shell;
    Gltf g;
    const std::size_t red = g.clear("red", 1.5f), blue = g.clear("blue", 1.5f), wood = g.material("wood");
    g.node("two",
           g.add("meshes",
                 {{"primitives",
                   {g.primitive(box({0, 0, 0}, {1, 1, 1}), red), g.primitive(box({2, 0, 0}, {3, 1, 1}), blue)}}}));
    Surface tray, lid;
    tray.add_tray({10, 0, 0}, {11, 1, 1}, true);
    lid.add({10, 1, 1}, {11, 1, 1}, {11, 1, 0}, {10, 1, 0});
    g.node("one",
           g.add("meshes",
                 {{"primitives",
                   {g.primitive(lid, red), g.primitive(tray, blue), g.primitive(box({20, 0, 0}, {21, 1, 1}), wood)}}}));
    const Outcome o = shell.import_well(g);
    CHECK(o.err == "warning: in.glb: \"one\" has 2 clear materials on one surface; all of it becomes \"blue\"\n");
    CHECK(shell.phases_at({{0.5f, 0.5f, 0.5f}, {2.5f, 0.5f, 0.5f}, {10.5f, 0.9f, 0.5f}, {20.5f, 0.5f, 0.5f}}) ==
          "red blue blue vacuum");
}

TEST_CASE("lights become lights, and exposure is theirs") {
    const Import shell;
    Gltf g = drink();
    g.json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_volume"};
    g.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 1000}},
        {{"type", "directional"}, {"intensity", 5}, {"color", {1, 0.5, 0.5}}},
        {{"type", "spot"}, {"intensity", 10}, {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.5}}}}};
    for (int i = 0; i < 3; ++i)
        g.json["scenes"][0]["nodes"].push_back(
            g.add("nodes", {{"translation", {0, 1, 1}}, {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}}));
    CHECK(shell.import_well(g).err == "");
    const Json lights = shell.scene()["lights"];
    REQUIRE(lights.size() == 4);
    const Json sphere = lights[0]["sphere"];
    CHECK(sphere["centre"] == Json::parse("[0, -1, 1]"));
    const double radius = sphere["radius"], radiance = sphere["intensity"];
    CHECK(3.14159265 * radius * radius * radiance == doctest::Approx(1000).epsilon(1e-4));
    CHECK(lights[1] == Json::parse(R"({"sun": {"direction": [0, -1, 0], "irradiance": [5, 2.5, 2.5]}})"));
    CHECK(lights[2]["spot"]["cone"] == doctest::Approx(57.2958));
    CHECK(lights[3].contains("gradient"));
    CHECK(shell.scene()["render"]["exposure"] < -6);
    CHECK(shell.run({"render", "out.json", "--size", "4x3", "--spp", "1", "-o", "a.png", "--quiet"}).err == "");
}

TEST_CASE("cameras and lights that are left out are reported") {
    const Import shell;
    Gltf g = drink();
    g.json["cameras"] = {{{"type", "orthographic"}, {"name", "Front"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}}}}};
    g.json["extensionsUsed"] = {"KHR_lights_punctual"};
    g.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"name", "Off"}, {"intensity", 0}},
        {{"type", "point"}, {"intensity", -5}},
        {{"type", "directional"}, {"name", "Dark"}, {"color", {0, 0, 0}}},
        {{"type", "point"}, {"name", "Odd"}, {"color", {1, -1, 0}}, {"intensity", 2}},
        {{"type", "point"}, {"name", "Key"}, {"intensity", 2}}};
    for (int i = 0; i < 5; ++i)
        g.json["scenes"][0]["nodes"].push_back(
            g.add("nodes", {{"translation", {0, 1, 1}}, {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}}));
    const Outcome o = shell.import_well(g);
    CHECK(o.err ==
          "warning: in.glb: the camera \"Front\" is orthographic and left out; write it into the scene by hand, as an "
          "\"orthographic\" camera\n"
          "warning: in.glb: the light \"Off\" has the intensity 0 and is left out\n"
          "warning: in.glb: the light 1 has a negative intensity and is left out\n"
          "warning: in.glb: the light \"Dark\" has a black or negative colour and is left out\n"
          "warning: in.glb: the light \"Odd\" has a colour with negative components, which become 0\n");
    CHECK(shell.scene()["lights"].size() == 3);  // two of the file, and the sky
    CHECK(shell.scene()["camera"]["fov"] == 30);
}

}  // namespace test_import
