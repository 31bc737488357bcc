// `phasetree import`: the scenes that it makes of small glTF files, and what it reports where it cannot.
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "tracer/support/written_glb.hpp"

namespace test_import {

using namespace phasetree::tests;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {

using Vector = std::array<float, 3>;

struct Surface {
    std::vector<float> places;
    std::vector<std::uint32_t> triangles;

    // Four corners, counterclockwise as seen from outside.
    void add(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
        const auto first = static_cast<std::uint32_t>(places.size() / 3);
        for (const Vector& p : {a, b, c, d}) places.insert(places.end(), p.begin(), p.end());
        for (const std::uint32_t i : {0, 1, 2, 0, 2, 3}) triangles.push_back(first + i);
    }
    // The sides of a box without top, facing outwards or inwards.
    void add_tray(const Vector& a, const Vector& b, bool outwards) {
        const auto face = [&](const Vector& p, const Vector& q, const Vector& r, const Vector& s) {
            if (outwards)
                add(p, q, r, s);
            else
                add(s, r, q, p);
        };
        face({a[0], a[1], a[2]}, {b[0], a[1], a[2]}, {b[0], a[1], b[2]}, {a[0], a[1], b[2]});
        face({a[0], a[1], b[2]}, {b[0], a[1], b[2]}, {b[0], b[1], b[2]}, {a[0], b[1], b[2]});
        face({b[0], a[1], a[2]}, {a[0], a[1], a[2]}, {a[0], b[1], a[2]}, {b[0], b[1], a[2]});
        face({a[0], a[1], a[2]}, {a[0], a[1], b[2]}, {a[0], b[1], b[2]}, {a[0], b[1], a[2]});
        face({b[0], a[1], b[2]}, {b[0], a[1], a[2]}, {b[0], b[1], a[2]}, {b[0], b[1], b[2]});
    }
};

Surface box(const Vector& a, const Vector& b) {
    Surface s;
    s.add_tray(a, b, true);
    s.add({a[0], b[1], b[2]}, {b[0], b[1], b[2]}, {b[0], b[1], a[2]}, {a[0], b[1], a[2]});
    return s;
}

// A box with a square cavity that is open above.
Surface cup(const Vector& a, const Vector& b, float wall) {
    const Vector c{a[0] + wall, a[1] + wall, a[2] + wall}, d{b[0] - wall, b[1], b[2] - wall};
    Surface s;
    s.add_tray(a, b, true);
    s.add_tray(c, d, false);
    const float y = b[1];
    s.add({a[0], y, b[2]}, {b[0], y, b[2]}, {d[0], y, d[2]}, {c[0], y, d[2]});
    s.add({b[0], y, b[2]}, {b[0], y, a[2]}, {d[0], y, c[2]}, {d[0], y, d[2]});
    s.add({b[0], y, a[2]}, {a[0], y, a[2]}, {c[0], y, c[2]}, {d[0], y, c[2]});
    s.add({a[0], y, a[2]}, {a[0], y, b[2]}, {c[0], y, d[2]}, {c[0], y, c[2]});
    return s;
}

// A glTF file that grows.
struct Gltf {
    Json json{{"scenes", {{{"nodes", Json::array()}}}}, {"nodes", Json::array()}};
    GlbBytes bytes;

    std::size_t add(const char* list, Json element) {
        json[list].push_back(std::move(element));
        return json[list].size() - 1;
    }
    template <class Number>
    std::size_t accessor(const std::vector<Number>& numbers, const char* type, std::size_t columns, int component) {
        const std::size_t view = add("bufferViews", Json::parse(bytes.add(numbers)));
        return add(
            "accessors",
            {{"bufferView", view}, {"componentType", component}, {"count", numbers.size() / columns}, {"type", type}});
    }
    std::size_t position(const Surface& s) { return accessor(s.places, "VEC3", 3, 5126); }
    Json primitive(const Surface& s, std::size_t material) {
        return {{"attributes", {{"POSITION", position(s)}}},
                {"indices", accessor(s.triangles, "SCALAR", 1, 5125)},
                {"material", material}};
    }
    std::size_t mesh(const Surface& s, std::size_t material) {
        return add("meshes", {{"primitives", {primitive(s, material)}}});
    }
    std::size_t material(const std::string& name, Json extensions = Json::object(), Json more = Json::object()) {
        Json made{{"name", name}, {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0}}}};
        for (const auto& [key, value] : extensions.items()) made["extensions"]["KHR_materials_" + key] = value;
        made.update(more, true);
        return add("materials", std::move(made));
    }
    std::size_t clear(const std::string& name, float ior, Json extensions = Json::object(),
                      Json more = Json::object()) {
        Json all{{"transmission", {{"transmissionFactor", 1}}},
                 {"volume", {{"thicknessFactor", 1}}},
                 {"ior", {{"ior", ior}}}};
        all.update(extensions);
        return material(name, all, std::move(more));
    }
    void node(const std::string& name, std::size_t mesh, Json more = Json::object()) {
        Json made{{"name", name}, {"mesh", mesh}};
        made.update(more);
        json["scenes"][0]["nodes"].push_back(add("nodes", std::move(made)));
    }
    std::string file() const {
        std::string text = json.dump();
        return glb(text.substr(1, text.size() - 2), bytes.bytes());
    }
};

struct Import : Shell {
    Outcome import(const Gltf& gltf, std::vector<std::string> more = {}) const {
        write_text(directory / "in.glb", gltf.file());
        std::vector<std::string> words{"import", "in.glb", "-o", "out.json"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
    Outcome import_well(const Gltf& gltf, std::vector<std::string> more = {}) const {
        more.emplace_back("--force");
        const Outcome o = import(gltf, more);
        CHECK_MESSAGE(o.code == 0, o.err);
        const Outcome check = run({"check", "out.json"});
        CHECK_MESSAGE(check.code == 0, check.err);
        CHECK(check.err == "");
        return o;
    }
    Json scene() const { return Json::parse(bytes_of(directory / "out.json")); }
    // The names of the phases at points of glTF's space.
    std::string phases_at(const std::vector<Vector>& points) const {
        std::string input, names;
        for (const Vector& p : points) input += fmt::format("{} {} {}\n", p[0], -p[2], p[1]);
        const std::string csv = run({"eval", "out.json"}, input).out;
        // x, y, z, phase, …
        for (std::size_t line = csv.find('\n') + 1; line < csv.size(); line = csv.find('\n', line) + 1) {
            std::size_t from = line;
            for (int i = 0; i < 3; ++i) from = csv.find(',', from) + 1;
            names += (names.empty() ? "" : " ") + csv.substr(from, csv.find(',', from) - from);
        }
        return names;
    }
    std::size_t entries() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(directory.path()), fs::directory_iterator()));
    }
};

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

// A cup of 2 mm walls around a cavity of 16 mm, with water that reaches 0.3 mm into it, ice half in the water, and a
// table.
Gltf drink() {
    Gltf g;
    const std::size_t wood = g.material("Wood"), glass = g.clear("Glass", 1.5f), water = g.clear("Water", 1.33f),
                      ice = g.clear("Ice", 1.31f);
    g.node("Table", g.mesh(box({-0.1f, -0.01f, -0.1f}, {0.1f, 0, 0.1f}), wood));
    g.node("Drink", g.mesh(box({-0.0083f, 0.0017f, -0.0083f}, {0.0083f, 0.012f, 0.0083f}), water));
    g.node("Cup", g.mesh(cup({-0.01f, 0, -0.01f}, {0.01f, 0.02f, 0.01f}, 0.002f), glass));
    g.node("Cube", g.mesh(box({-0.002f, 0.010f, -0.002f}, {0.002f, 0.014f, 0.002f}), ice));
    g.add("cameras",
          {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"aspectRatio", 1.5}, {"znear", 0.01}}}});
    g.json["scenes"][0]["nodes"].push_back(g.add("nodes", {{"camera", 0}, {"translation", {0, 0.01, 0.1}}}));
    return g;
}

}  // namespace

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
    // For people: no line is longer than they write it, and none has only a bracket that could end the one before.
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
    CHECK(has(o.err, "\"colored\" tints its surface by its base colour"));
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

TEST_CASE("overlaps: priorities come first, then containment, then matter, then the file") {
    const Import shell;
    const auto phases = [&](const std::vector<std::pair<std::string, Vector>>& boxes, const std::vector<Vector>& points,
                            const std::vector<int>& priorities = {}) {
        Gltf g;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const auto& [name, range] = boxes[i];
            const Json extras = i < priorities.size() && priorities[i] != 0
                                    ? Json{{"extras", {{"phasetree_priority", priorities[i]}}}}
                                    : Json::object();
            g.node("node", g.mesh(box({range[0], 0, 0}, {range[1], range[2], range[2]}), g.clear(name, 1.5f)), extras);
        }
        (void)shell.import_well(g);
        return shell.phases_at(points);
    };
    const std::vector<Vector> both{{1.5f, 0.5f, 0.5f}};
    CHECK(phases({{"water", {0, 2, 1}}, {"glass", {1, 3, 1}}}, both) == "glass");
    CHECK(phases({{"glass", {0, 2, 1}}, {"water", {1, 3, 1}}}, both) == "glass");
    CHECK(phases({{"water", {0, 2, 1}}, {"air", {1, 3, 1}}}, both) == "air");
    CHECK(phases({{"air", {0, 2, 1}}, {"glass", {1, 3, 1}}}, both) == "glass");
    CHECK(phases({{"glass", {0, 2, 1}}, {"ice", {1, 3, 1}}}, both) == "glass");
    CHECK(phases({{"ice", {0, 2, 1}}, {"glass", {1, 3, 1}}}, both) == "ice");
    CHECK(phases({{"ice", {0, 2, 1}}, {"glass", {1, 3, 1}}}, both, {0, 1}) == "glass");
    CHECK(phases({{"water", {0, 2, 1}}, {"glass", {1, 3, 1}}}, both, {1, 0}) == "water");
    // What lies within the other is kept, even a liquid within a solid.
    CHECK(phases({{"glass", {0, 3, 3}}, {"water", {1, 2, 1}}}, both) == "water");
    CHECK(phases({{"glass", {0, 3, 3}}, {"water", {1, 2, 1}}}, both, {1, 0}) == "glass");
    CHECK(phases({{"Glass of water", {0, 2, 1}}, {"Orange_juices", {1, 3, 1}}}, both) == "Glass of water");
    CHECK(phases({{"OrangeJuice", {0, 2, 1}}, {"Water glass", {1, 3, 1}}}, both) == "Water glass");
    // An index is a hint only for names that say nothing.
    Gltf g;
    g.node("a", g.mesh(box({0, 0, 0}, {2, 1, 1}), g.clear("x", 1.34f)));
    g.node("b", g.mesh(box({1, 0, 0}, {3, 1, 1}), g.clear("y", 1.5f)));
    g.node("c", g.mesh(box({2.5f, 0, 0}, {4, 1, 1}), g.clear("z", 1.0f)));
    const Outcome o = shell.import_well(g);
    CHECK(has(o.out, "\"a\" and \"b\" overlap by up to 0.4"));
    CHECK(has(o.out, "\"b\" wins (solid over gas)\n"));
    CHECK(shell.phases_at({{1.5f, 0.5f, 0.5f}, {2.7f, 0.5f, 0.5f}, {3.5f, 0.5f, 0.5f}}) == "y y z");
    // Rules that contradict each other: liquid within a solid, and a gas through both.
    Gltf circle;
    circle.node("block", circle.mesh(box({0, 0, 0}, {9, 9, 9}), circle.clear("glass", 1.5f)));
    circle.node("core", circle.mesh(box({3, 3, 3}, {6, 6, 6}), circle.clear("water", 1.33f)));
    circle.node("hose", circle.mesh(box({4, 4, 4}, {5, 5, 12}), circle.clear("air", 1.0f)));
    CHECK(has(shell.import_well(circle).err, "against the rule (gas over liquid)"));
}

TEST_CASE("a thin gap is reported with its width, unless something fills it") {
    const Import shell;
    Gltf g;
    g.node("Cup", g.mesh(cup({-10, 0, -10}, {10, 20, 10}, 2), g.clear("glass", 1.5f)));
    g.node("Drink", g.mesh(box({-7.9f, 2.1f, -7.9f}, {7.9f, 12, 7.9f}), g.clear("water", 1.33f)));
    g.node("Cube", g.mesh(box({7.5f, 5, -1}, {7.8f, 7, 1}), g.clear("ice", 1.31f)));
    const Outcome o = shell.import_well(g);
    CHECK(has(o.out, "\"Cup\" and \"Drink\" have a gap of 0.1 to 0.1 m along"));
    CHECK(has(o.out, "\"Cube\" wins (within the other)\n"));
    CHECK_FALSE(has(o.out, "\"Cup\" and \"Cube\""));
    // The liquid flows to the glass.
    CHECK(has(o.out, "gaps narrower than 0.2 m between the phases water, glass are closed; --keep-gaps keeps them\n"));
    const std::vector<Vector> across_wall{{7.85f, 6, 3}, {7.95f, 6, 3}, {8.05f, 6, 3}, {7.95f, 15, 3}};
    CHECK(shell.phases_at(across_wall) == "water water glass vacuum");
    const Json closed = shell.scene()["tree"]["close_gaps"];
    CHECK(closed["phases"] == Json::parse(R"(["water", "glass"])"));
    CHECK(closed["gap"] == 0.2);
    const Outcome kept = shell.import_well(g, {"--keep-gaps"});
    CHECK(has(kept.out, "have a gap of 0.1 to 0.1 m along"));
    CHECK_FALSE(has(kept.out, "closed"));
    CHECK(shell.phases_at(across_wall) == "water vacuum glass vacuum");
    CHECK(shell.scene()["tree"].contains("over"));
}

TEST_CASE("a gap wider than the wall of the glass is measured from within") {
    const Import shell;
    Gltf g;
    g.node("Cup", g.mesh(cup({-40, 0, -40}, {40, 80, 40}, 0.6f), g.clear("glass", 1.5f)));
    g.node("Wine", g.mesh(box({-38.7f, 1.3f, -38.7f}, {38.7f, 50, 38.7f}), g.clear("wine", 1.34f)));
    const Outcome o = shell.import_well(g);
    CHECK(has(o.out, "\"Cup\" and \"Wine\" have a gap of 0.7 to 0.7 m along"));
    const double closed = shell.scene()["tree"]["close_gaps"]["gap"].get<double>();
    CHECK(closed >= 1.4);
    CHECK(closed <= 1.6);  // near edges, gaps are up to a tenth wider
}

TEST_CASE("gaps are left alone between solids, at a small part of surfaces, and within a phase") {
    const Import shell;
    Gltf panes;
    panes.node("a", panes.mesh(box({0, 0, 0}, {1, 1, 0.01f}), panes.clear("glass", 1.5f)));
    panes.node("b", panes.mesh(box({0, 0, 0.02f}, {1, 1, 0.03f}), panes.clear("acrylic", 1.49f)));
    CHECK_FALSE(has(shell.import_well(panes).out, "closed"));
    Gltf g;
    // Two cubes side by side, shifted so that they face each other at a fiftieth of their surfaces.
    g.node("a", g.mesh(box({0, 0, 0}, {1, 1, 1}), g.clear("glass", 1.5f)));
    g.node("b", g.mesh(box({1.01f, 0.88f, 0}, {2.01f, 1.88f, 1}), g.clear("water", 1.33f)));
    CHECK_FALSE(has(shell.import_well(g).out, "closed"));
    Gltf same;
    const std::size_t glass = same.clear("glass", 1.5f);
    same.node("a", same.mesh(box({0, 0, 0}, {1, 1, 1}), glass));
    same.node("b", same.mesh(box({1.01f, 0, 0}, {2.01f, 1, 1}), glass));
    const Outcome o = shell.import_well(same);
    CHECK(has(o.out, "have a gap of 0.01 to 0.01 m"));
    CHECK_FALSE(has(o.out, "closed"));
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
    CHECK(has(o.err, "\"Tray\" is not closed: 4 edges have triangles on one side only; its holes are closed"));
    CHECK(has(o.err,
              "the material \"pane\" is a thin pane without volume (KHR_materials_volume), which phasetree "
              "cannot render; left out: \"Window\""));
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

TEST_CASE("nothing is replaced without --force, and errors leave no file") {
    Import shell;
    const Gltf g = drink();
    const auto refused = [&](const std::vector<std::string>& words, const std::string& said, int code = 2) {
        const Outcome o = shell.run(words);
        CAPTURE(o.err);
        CHECK(o.code == code);
        CHECK(has(o.err, said));
        CHECK(o.err.size() < 400);
    };
    write_text(shell.directory / "in.glb", g.file());
    refused({"import", "in.glb"}, "--output is required");
    refused({"import", "in.glb", "-o", "in.glb"}, "must end in .json");
    refused({"import", "in.obj", "-o", "out.json"}, "must end in .glb or .gltf");
    refused({"import", "none.glb", "-o", "out.json"}, "no such file none.glb");
    refused({"import", "in.glb", "-o", "nowhere/out.json"}, "nowhere", 1);
    write_text(shell.directory / "short.glb", g.file().substr(0, 900));
    refused({"import", "short.glb", "-o", "out.json"}, "short.glb: the file ends too early");
    CHECK(shell.entries() == 2);
    // As a full disk: there is room for small meshes, and for no larger one.
    shell.in_child = [] {
        const rlimit limit{900, 900};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    };
    refused({"import", "in.glb", "-o", "out.json"}, "File too large", 1);
    shell.in_child = {};
    CHECK(shell.entries() == 2);
    CHECK(shell.import(g).code == 0);
    const std::string before = bytes_of(shell.directory / "out.json");
    refused({"import", "in.glb", "-o", "out.json"},
            "out.json exists; choose another name with --output, or replace it "
            "with --force");
    fs::remove(shell.directory / "out.json");
    refused({"import", "in.glb", "-o", "out.json"}, "out.meshes/Drink.ply exists");
    CHECK(shell.import(g, {"--force"}).code == 0);
    CHECK(bytes_of(shell.directory / "out.json") == before);
    // A scene in another folder finds everything.
    fs::create_directory(shell.directory / "there");
    CHECK(shell.run({"import", "in.glb", "-o", "there/out.json"}).code == 0);
    CHECK(shell.run({"check", "there/out.json"}).err == "");
}

TEST_CASE("Ctrl-C ends an import, and no file is left") {
    const Import shell;
    Gltf g;
    Surface many;
    for (int i = 0; i < 20'000; ++i) {
        const auto x = static_cast<float>(2 * i);
        const Surface one = box({x, 0, 0}, {x + 1, 1, 1});
        const auto first = static_cast<std::uint32_t>(many.places.size() / 3);
        many.places.insert(many.places.end(), one.places.begin(), one.places.end());
        for (const std::uint32_t t : one.triangles) many.triangles.push_back(first + t);
    }
    g.node("many", g.mesh(many, g.clear("glass", 1.5f)));
    write_text(shell.directory / "in.glb", g.file());
    bool is_sent = false;
    const Outcome o = shell.run({"import", "in.glb", "-o", "out.json"}, "", [&](pid_t process) {
        if (!is_sent && catches(process, SIGUSR1) && catches(process, SIGINT)) is_sent = ::kill(process, SIGINT) == 0;
    });
    CHECK(o.code == 130);
    CHECK(o.err == "phasetree: interrupted while importing; no file was written\n");
    CHECK(shell.entries() == 1);
}

}  // namespace test_import
