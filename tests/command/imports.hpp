// Small glTF files, and `phasetree import` of them.
#pragma once

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "tracer/support/written_glb.hpp"

namespace phasetree::tests::imports {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

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

inline Surface box(const Vector& a, const Vector& b) {
    Surface s;
    s.add_tray(a, b, true);
    s.add({a[0], b[1], b[2]}, {b[0], b[1], b[2]}, {b[0], b[1], a[2]}, {a[0], b[1], a[2]});
    return s;
}

// A box with a square cavity that is open above.
inline Surface cup(const Vector& a, const Vector& b, float wall) {
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

inline bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

// A cup of 2 mm walls around a cavity of 16 mm, with water that reaches 0.3 mm into it, ice half in the water, and a
// table.
inline Gltf drink() {
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

}  // namespace phasetree::tests::imports
