// Several objects in scene files: names, phases, placement, errors and overlaps.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "phasetree/io/node_places.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/tree/value_source.hpp"
#include "phasetree_support/temporary_directory.hpp"
#include "scene/one_tree.hpp"
#include "scene/overlaps.hpp"
#include "scene/scene.hpp"

namespace test_objects {

using namespace phasetree;
using namespace phasetree::tracer;
using support::TemporaryDirectory;
using support::write_text;

namespace {

constexpr const char* ball = R"({"name": "ball", "tree": {"set": {"phase": "glass", "of": "round"}}})";
constexpr const char* other_scene =
    R"({"phases": {"glass": {"clear": {"ior": 1.7}}, "gold": {"conductor": {"metal": "gold"}}},
    "tree": {"under": [{"set": {"phase": "glass", "of": {"sphere": {"radius": 2}}}},
                       {"set": {"phase": "gold", "of": {"sphere": {"radius": 1}}}}]}})";

const TemporaryDirectory& folder() {
    static const TemporaryDirectory made;
    static const bool is_filled = [] {
        write_text(made / "other.json", other_scene);
        write_text(made / "nothing.json", R"({"phases": {"a": {"diffuse": {}}}})");
        return true;
    }();
    REQUIRE(is_filled);
    return made;
}

Document document_of(const std::string& rest) {
    return Document::from_text(
        R"({"version": 1, "phases": {"glass": {"clear": {"ior": 1.5}}, "red": {"diffuse": {"color": [1, 0, 0]}}},
        "shapes": {"round": {"sphere": {"radius": 1}}}, "lights": [{"constant": {}}],
        "camera": {"position": [0, -50, 0], "look_at": [0, 0, 0]}, )" +
            rest + "}",
        (folder() / "scene.json").string());
}
Scene scene_of(const std::string& rest) {
    return read_scene(document_of(rest));
}

std::string error_of(const std::string& rest) {
    try {
        (void)scene_of(rest);
    } catch (const SceneError& e) {
        return e.message();
    }
    return "";
}

/// A binary file of instances that declares this number of them, followed by these bytes.
void write_places(const std::string& name, std::uint64_t says, const std::vector<float>& floats,
                  const char* magic = "PTPLACES") {
    std::string bytes(magic);
    for (int i = 0; i < 8; ++i) bytes += static_cast<char>(says >> (8 * i) & 255);
    for (const float f : floats) {
        std::uint32_t bits;
        std::memcpy(&bits, &f, 4);
        for (int i = 0; i < 4; ++i) bytes += static_cast<char>(bits >> (8 * i) & 255);
    }
    write_text(folder() / name, bytes);
}

const std::vector<float> two_places{1, 0, 0, 0, 1, 0, 0, 0, 1, 5, 6, 7, 2, 0, 0, 0, 2, 0, 0, 0, -2, 1, 1, 1};

std::vector<std::pair<std::string, Transform>> copies_of(const PlacedObjects& placed) {
    std::vector<std::pair<std::string, Transform>> all;
    placed.each_copy([&](std::uint32_t number, const PlacedObject& object, const Transform& to_scene) {
        CHECK(number == all.size());
        all.emplace_back(object.name, to_scene);
        return true;
    });
    return all;
}

}  // namespace

TEST_CASE("a tree beside objects is one more, and comes first") {
    const Scene scene =
        scene_of(std::string(R"("tree": {"set": {"phase": "red", "of": "round"}}, "objects": [)") + ball + "]");
    CHECK(object_names(scene) == std::vector<std::string>{"tree", "ball"});
    CHECK(scene.placed.copies() == 2);
}

TEST_CASE("an object of another file brings its phases, each file once, and may be given other materials") {
    const Scene scene = scene_of(R"("objects": [
        {"name": "a", "file": "other.json"},
        {"name": "b", "file": "other.json", "transform": {"translate": {"by": [9, 0, 0]}}},
        {"name": "c", "file": "other.json", "phases": {"gold": {"conductor": {"metal": "iron"}}}},
        {"name": "d", "tree": {"set": {"phase": "glass", "of": "round"}}}])");
    CHECK(scene.phases.names == std::vector<std::string>{"vacuum", "glass", "red", "a.glass", "a.gold", "c.gold"});
    REQUIRE(scene.materials.size() == 6);
    CHECK(std::get<Clear>(scene.materials[1]).ior == 1.5f);
    CHECK(std::get<Clear>(scene.materials[3]).ior == 1.7f);
    CHECK(std::get<Conductor>(scene.materials[5]).eta != std::get<Conductor>(scene.materials[4]).eta);
    const auto phase_at = [&](std::size_t object, float x) {
        return scene.phases[label(distances(scene.placed.objects[object].tree, {x, 0, 0}))];
    };
    CHECK(phase_at(0, 1.5f) == "a.glass");
    CHECK(phase_at(1, 0) == "a.gold");
    CHECK(phase_at(2, 0) == "c.gold");
    CHECK(phase_at(2, 1.5f) == "a.glass");
    CHECK(phase_at(3, 0) == "glass");
}

TEST_CASE("nodes stand where their files have them, also those whose phases get other numbers") {
    const Document document = document_of(R"("objects": [
        {"name": "a", "file": "other.json"},
        {"name": "b", "file": "other.json", "transform": {"translate": {"by": [9, 0, 0]}},
         "phases": {"gold": {"conductor": {"metal": "iron"}}}},
        {"name": "c", "phases": {"glass": {"clear": {"ior": 1.4}}},
         "tree": {"set": {"phase": "glass", "of": {"translate": {"by": [-9, 0, 0], "of": "round"}}}}}])");
    NodePlaces places;
    const Scene scene = read_scene(document, &places);
    // The file has no text for the node that chooses between the objects, nor for those that place them.
    const Phased whole = as_one_tree(scene.placed);
    const auto path = [&](float x, const char* phase) {
        const auto number = std::ranges::find(scene.phases.names, phase) - scene.phases.names.begin();
        std::string result;
        for (const NodeOnPath& step : value_source(whole, {x, 0, 0}, Phase{static_cast<std::uint8_t>(number)})) {
            const auto place = places.find(step.node);
            result += fmt::format(" {}", step.name);
            if (!place) continue;
            const bool is_of_scene = place->file == document.name();
            result += fmt::format(":{}{}:{}", is_of_scene ? "" : "other:", place->line, place->column);
            const std::string text = is_of_scene ? document.text() : other_scene;
            CHECK(text.substr(place->offset + 1, step.name.size()) == step.name);
        }
        return result;
    };
    CHECK(path(0, "a.gold") == " over under:other:2:14 set:other:3:25 sphere:other:3:57");
    CHECK(path(1.75f, "a.glass") == " over under:other:2:14 set:other:2:25 sphere:other:2:58");
    CHECK(path(9, "b.gold") == " over translate under:other:2:14 set:other:3:25 sphere:other:3:57");
    CHECK(path(-9, "c.glass") == " over set:8:19 translate:8:52 sphere:2:30");
}

TEST_CASE("instances and groups: each copy stands where its chain of transforms puts it") {
    write_places("two.places", 2, two_places);
    const Scene scene = scene_of(std::string(R"("objects": [{"name": "ball", "transform": {"scale": {"factor": 3}},
            "tree": {"set": {"phase": "glass", "of": "round"}}},
            {"name": "alone", "tree": {"set": {"phase": "red", "of": "round"}}}],
        "groups": {"pair": [{"of": "ball", "transforms": [[1, 0, 0], [0, 1, 0, -1, 0, 0, 0, 0, 1, 2, 0, 0]]}],
                   "four": [{"of": "pair"}, {"of": "pair", "transform": {"translate": {"by": [0, 0, 4]}}}]},
        "instances": [{"of": "four", "transform": [{"rotate": {"angle": 90}}, {"translate": {"by": [100, 0, 0]}}]},
                      {"of": "ball", "file": "two.places", "transform": {"translate": {"by": [0, 50, 0]}}}])"));
    CHECK(scene.placed.copies() == 7);
    const auto copies = copies_of(scene.placed);
    REQUIRE(copies.size() == 7);
    CHECK(copies[0].first == "alone");
    const auto is_at = [&](std::size_t copy, const glm::dvec3& p, const glm::dvec3& wanted) {
        return glm::distance(copies[copy].second(p), wanted) < 1e-5;
    };
    CHECK(is_at(1, {0, 0, 0}, {100, 1, 0}));
    CHECK(is_at(2, {1, 0, 0}, {97, 2, 0}));  // three along x, rotated to y, moved to x = 2; then rotated and moved
    CHECK(is_at(4, {0, 0, 0}, {100, 2, 4}));
    CHECK(is_at(5, {0, 0, 0}, {5, 56, 7}));
    CHECK(is_at(6, {0, 0, 1}, {1, 51, -5}));
}

TEST_CASE("what is wrong with objects is said") {
    const std::string one = std::string(R"("objects": [)") + ball + "]";
    const auto with = [&](const std::string& more) { return error_of(one + ", " + more); };
    CHECK(error_of(one).empty());
    CHECK(error_of(R"("objects": [])") == "\"objects\" must be a list of at least one object");
    CHECK(error_of(R"("objects": [{"name": "a"}])") == "an object must have either \"tree\" or \"file\"");
    CHECK(error_of(std::string(R"("objects": [)") + ball + ", " + ball + "]") ==
          "another object is already named \"ball\"");
    CHECK(error_of(R"("objects": [{"name": "a", "file": "nothing.json"}])") == "\"nothing.json\" has no \"tree\"");
    CHECK(error_of(R"("objects": [{"name": "a", "file": "absent.json"}])").find("absent.json: no such file") == 0);
    CHECK(!error_of(R"("objects": [{"name": "a", "file": "no.json"}])").empty());
    CHECK(
        error_of(
            R"("objects": [{"name": "a", "file": "other.json", "phases": {"golf": {"diffuse": {"color": [1, 0, 0]}}}}])") ==
        "the object has no phase \"golf\"");
    CHECK(error_of(R"("tree": {"set": {"phase": "red", "of": "round"}}, "instances": [{"of": "a"}])") ==
          "\"instances\" requires \"objects\"");
    CHECK(with(R"("instances": [{"of": "bell"}])") == "unknown object or group \"bell\"");
    CHECK(with(R"("groups": {"a": [{"of": "b"}], "b": [{"of": "a"}]})") == "the group \"a\" contains itself");
    // It does not matter whether a group stands before or after the groups that it contains.
    for (const bool is_outermost_first : {false, true})
        for (const int depth : {32, 33}) {
            std::string groups;
            for (int i = 1; i <= depth; ++i) {
                const int n = is_outermost_first ? depth + 1 - i : i;
                groups += (i > 1 ? ", " : "") +
                          fmt::format(R"("g{}": [{{"of": "{}"}}])", n, n > 1 ? "g" + std::to_string(n - 1) : "ball");
            }
            CHECK(with("\"groups\": {" + groups + "}, \"instances\": [{\"of\": \"g1\"}]") ==
                  (depth > 32 ? "groups are nested more than 32 levels deep" : ""));
        }
    CHECK(with(R"("groups": {"a": [{"of": "ball"}]})") ==
          "the scene is empty: all objects are in groups, and there are no \"instances\"");
    CHECK(with(R"("instances": [{"of": "ball", "transforms": [[1, 2]]}])") ==
          "an instance must be [x, y, z], the image of the origin, or a list of 12 numbers");
    const std::string flat = "the transform is singular, or moves or scales the object beyond what can be traced";
    CHECK(with(R"("instances": [{"of": "ball", "transforms": [[1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 0]]}])") == flat);
    CHECK(with(R"("instances": [{"of": "ball", "transform": {"affine": {"x": [0, 1, 0]}}}])") == flat);
    CHECK(with(R"("instances": [{"of": "ball", "transform": {"translate": {"by": [0, 0, 1e16]}}}])") == flat);
    CHECK(error_of(R"("objects": [{"name": "a", "tree": {"set": {"phase": "red", "of": {"plane": {}}}}}])")
              .starts_with("\"a\": "));

    // More than a thousand million, by groups of groups.
    std::string groups = R"("groups": {"g0": [{"of": "ball", "transforms": [[0, 0, 0], [9, 0, 0]]}])";
    for (int i = 1; i < 31; ++i)
        groups += fmt::format(R"(, "g{}": [{{"of": "g{}", "transforms": [[0, 0, 0], [9, 0, 0]]}}])", i, i - 1);
    CHECK(with(groups + R"(}, "instances": [{"of": "g30"}])").find("the limit is 1000000000") != std::string::npos);
}

TEST_CASE("files of places are checked to the last byte") {
    const auto error = [&](const std::string& file) {
        return error_of(std::string(R"("objects": [)") + ball + R"(], "instances": [{"of": "ball", "file": ")" + file +
                        "\"}]");
    };
    write_places("good", 2, two_places);
    CHECK(error("good").empty());
    CHECK(error("none") == "\"none\" is not a readable file");
    CHECK(error(".") == "\".\" is not a readable file");
    write_places("magic", 2, two_places, "PTPLACED");
    CHECK(error("magic") == "\"magic\" is not a file of instances: it does not begin with PTPLACES and a number");
    write_text(folder() / "short", "PTPLACES123");
    CHECK(error("short") == "\"short\" is not a file of instances: it does not begin with PTPLACES and a number");
    write_places("cut", 3, two_places);
    CHECK(error("cut") == "\"cut\" declares 3 instances, which take 160 bytes, but has 112 bytes");
    write_places("long", 1, two_places);
    CHECK(error("long") == "\"long\" declares 1 instances, which take 64 bytes, but has 112 bytes");
    write_places("huge", ~std::uint64_t{0}, two_places);
    CHECK(error("huge") == "\"huge\" has 18446744073709551615 instances; the limit is 20000000");
    write_places("empty", 0, {});
    CHECK(error("empty") == "\"empty\" has no instances");
    std::vector<float> bad = two_places;
    bad[14] = std::numeric_limits<float>::quiet_NaN();
    write_places("nan", 2, bad);
    CHECK(error("nan").starts_with("\"nan\" has an unusable instance, number 1 counted from 0"));
}

TEST_CASE("overlaps are found, and touching is none") {
    const auto overlaps_at = [&](const std::string& places) {
        return find_overlaps(scene_of(std::string(R"("objects": [{"name": "cube", "tree": {"set": {"phase": "glass",
            "of": {"box": {"size": [2, 2, 2]}}}}}, {"name": "far", "transform": {"translate": {"by": [0, 0, 90]}},
            "tree": {"set": {"phase": "red", "of": "round"}}}], "instances": [{"of": "cube", "transforms": )") +
                                      places + "}]")
                                 .placed);
    };
    CHECK(overlaps_at("[[0, 0, 0], [2, 0, 0], [0, 2, 0], [2, 2, 0], [0, 0, -2]]").found.empty());
    const Overlaps few = overlaps_at("[[0, 0, 0], [2, 0, 0], [3.99, 0, 0], [3.9, 1.9, 1.9]]");
    CHECK(!few.is_cut_short);
    REQUIRE(few.found.size() == 3);
    CHECK(few.found[0].first.number == 2);
    CHECK(few.found[0].second.number == 3);
    for (const Overlap& o : few.found) {
        CHECK(std::abs(o.at.z - 0.5f) <= 1.5f);
        CHECK(o.at.x > 2.8f);
    }
    // A heap of cubes does not hide other overlaps.
    const auto heap = find_overlaps(scene_of(R"("objects": [{"name": "cube", "tree": {"set": {"phase": "glass",
        "of": {"box": {"size": [2, 2, 2]}}}}}, {"name": "lone", "transform": {"translate": {"by": [6, 0, 0]}},
        "tree": {"set": {"phase": "red", "of": "round"}}}], "instances": [{"of": "cube", "transforms":
        [[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0], [4, 0, 0], [5, 0, 0]]}])")
                                        .placed);
    CHECK(heap.has_more);
    CHECK(!few.has_more);
    CHECK(std::ranges::any_of(heap.found, [](const Overlap& o) { return o.first.object != o.second.object; }));
    // Balls that do not overlap although their boxes do.
    const auto balls = [&](float x) {
        return find_overlaps(
                   scene_of(std::string(R"("objects": [)") + ball +
                            fmt::format(
                                R"(], "instances": [{{"of": "ball", "transforms": [[0, 0, 0], [{0}, {0}, 0]]}}])", x))
                       .placed)
            .found.size();
    };
    CHECK(balls(1.42f) == 0);
    CHECK(balls(1.41f) == 1);
}

TEST_CASE("too many objects are no tree") {
    std::string places;
    for (int i = 0; i < 4097; ++i) places += fmt::format("{}[{}, 0, 0]", i > 0 ? ", " : "", 3 * i);
    const Scene scene = scene_of(std::string(R"("objects": [)") + ball +
                                 R"(], "instances": [{"of": "ball", "transforms": [)" + places + "]}]");
    CHECK_THROWS_AS((void)as_one_tree(scene.placed), ModelError);
}

}  // namespace test_objects
