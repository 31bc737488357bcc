// Trees: files, texts, images, edits by path.
#include <filesystem>
#include <fstream>

#include "embree/api/api.hpp"
#include "phasetree/io/write.hpp"
#include "support/gallery.hpp"

namespace test_trees {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

const char* const annotated = R"({
  // a comment with "quotes" and } braces
  "phases": {"glass": 0, "water": 0},
  "shapes": {"bulb": {"sphere": {"radius": 1.0 /* metres */}}},
  "tree": {"under": [
    {"set": {"phase": "glass", "of": "bulb"}},
    {"set": {"phase": "water", "of": {"scale": {"factor": 0.5, "of": "bulb"}}}}
  ]}
})";

float radius_x(const embree::Tree& tree) {
    return tree.bounds().upper_x;
}

std::string message_of(const std::function<void()>& f) {
    try {
        f();
    } catch (const embree::Error& e) {
        return e.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("every scene of the gallery without images and fonts loads from its file") {
    int loaded = 0;
    for (const std::filesystem::path& path : gallery_of_the_library()) {
        CAPTURE(path.string());
        const embree::Tree tree = embree::Tree::from_file(path.string());
        CHECK(tree.phase_count() > 1);
        CHECK(tree.phase_name(0) == "vacuum");
        CHECK(tree.phase(tree.phase_name(1)) == 1);
        const RTCBounds b = tree.bounds();
        CHECK(b.lower_x < b.upper_x);
        ++loaded;
    }
    CHECK(loaded > 15);
}

TEST_CASE("edits by path leave the rest, comments included, and the first tree as it was") {
    const embree::Tree tree = embree::Tree::from_text(annotated, "bulb.json");
    CHECK(radius_x(tree) == doctest::Approx(1));
    // A named shape changes wherever it is used.
    const embree::Tree larger = tree.edited("/shapes/bulb/sphere/radius", "2");
    CHECK(radius_x(larger) == doctest::Approx(2));
    CHECK(radius_x(tree) == doctest::Approx(1));
    Device device;
    CHECK(embree::Geometry(device, tree).phase({0.7f, 0, 0}) == 1);
    CHECK(embree::Geometry(device, larger).phase({0.7f, 0, 0}) == 2);
    CHECK(embree::Geometry(device, larger.edited("/tree/under/1/set/of/scale/factor", "0.25")).phase({0.7f, 0, 0}) ==
          1);
    // Strings, objects, whole subtrees.
    CHECK(embree::Geometry(device, tree.edited("/tree/under/1/set/phase", "\"glass\"")).phase({0, 0, 0}) == 1);
    const embree::Tree box = tree.edited("/tree", R"({"set": {"phase": "water", "of": {"box": {"size": [6, 1, 1]}}}})");
    CHECK(radius_x(box) == doctest::Approx(3));
    // A value with comments of its own.
    CHECK(radius_x(tree.edited("/shapes/bulb/sphere/radius", "3 // three")) == doctest::Approx(3));
    CHECK(radius_x(
              tree.edited("/tree/under/0", R"({"set": {"phase": "glass", "of": {"sphere": {"radius": 9}}}} /**/)")) ==
          doctest::Approx(9));
}

TEST_CASE("edits that are wrong say where") {
    const embree::Tree tree = embree::Tree::from_text(annotated, "bulb.json");
    const auto edit = [&](const char* path, const char* value) {
        return message_of([&] { tree.edited(path, value); });
    };
    CHECK(edit("/shapes/bulb/sphere/radius", "-1").find("bulb.json:4:44:") != std::string::npos);
    CHECK(edit("/shapes/bulb/sphere/raduis", "1").find("\"raduis\" does not exist") != std::string::npos);
    CHECK(edit("/tree/under/2", "1").find("has no item \"2\"") != std::string::npos);
    CHECK(edit("/tree/under/-", "1").find("has no item") != std::string::npos);
    CHECK(edit("tree", "1").find("must start with") != std::string::npos);
    CHECK(edit("/tree/~2", "1").find("~0") != std::string::npos);
    CHECK(edit("/phases/glass/x", "1").find("has no parts") != std::string::npos);
    CHECK(edit("/tree", "{").find("the value for /tree") != std::string::npos);
    CHECK(edit("/tree", "1, \"x\": 2").find("the value for /tree") != std::string::npos);
    CHECK(edit("/tree", "").find("the value for /tree") != std::string::npos);
    // Keys with slashes and tildes, and the whole.
    const embree::Tree odd = embree::Tree::from_text(
        R"({"phases": {"a": 0}, "shapes": {"x/y~": {"sphere": {"radius": 1}}}, "tree": {"set": {"phase": "a", "of": "x/y~"}}})");
    CHECK(radius_x(odd.edited("/shapes/x~1y~0/sphere/radius", "4")) == doctest::Approx(4));
    CHECK(radius_x(odd.edited("", annotated)) == doctest::Approx(1));
}

TEST_CASE("a tree built with the C++ library comes over to the last bit") {
    const SceneTree built{{{"vacuum", "glass", "water", "metal", "sand"}}, object()};
    Device device;
    const embree::Geometry mine(device, embree::Tree::of(built)), read(device, object_tree());
    std::mt19937 random(71);
    std::uniform_real_distribution<float> coordinate(-1.4f, 1.4f);
    for (int i = 0; i < 500; ++i) {
        const std::array<float, 3> p = {coordinate(random), coordinate(random), coordinate(random)};
        REQUIRE(mine.distances(p) == read.distances(p));
    }
}

namespace {

struct Reader {
    int calls = 0;
    std::string path;
};
const char* ramp(void* user, const char* path, PhasetreeImage image) {
    auto& reader = *static_cast<Reader*>(user);
    ++reader.calls;
    reader.path = path;
    if (phasetreeNewImageValues(image, 0, 5) || phasetreeNewImageValues(image, 1u << 20, 1u << 20)) return "too kind";
    float* const values = phasetreeNewImageValues(image, 16, 16);
    if (!values) return "no memory";
    for (int i = 0; i < 256; ++i) values[i] = static_cast<float>(i % 16) / 15;
    return nullptr;
}
const char* refuse(void*, const char*, PhasetreeImage) {
    return "the application knows no such image";
}
const char* forget(void*, const char*, PhasetreeImage) {
    return nullptr;
}

const char* const terrain = R"({"phases": {"rock": 0}, "tree": {"set": {"phase": "rock", "of":
    {"height_map": {"file": "ramp.png", "size_x": 4, "size_y": 4, "height": 1}}}}})";

}  // namespace

TEST_CASE("images are read by the application") {
    Reader state;
    const PhasetreeFileReader reader{ramp, &state};
    std::string text = terrain;
    const std::string problem = message_of([&] { embree::Tree::from_text(text, "/some/where/land.json", &reader); });
    CAPTURE(problem);
    CHECK(problem == "no error");
    CHECK(state.calls == 1);
    CHECK(state.path == "/some/where/ramp.png");
    const PhasetreeFileReader refusing{refuse, nullptr}, forgetting{forget, nullptr}, empty{nullptr, nullptr};
    CHECK(message_of([&] { embree::Tree::from_text(text, "a", &refusing); }).find("knows no such image") !=
          std::string::npos);
    CHECK(message_of([&] { embree::Tree::from_text(text, "a", &forgetting); }).find("returned no image") !=
          std::string::npos);
    CHECK(message_of([&] { embree::Tree::from_text(text, "a", &empty); }).find("readImage is NULL") !=
          std::string::npos);
    CHECK(message_of([&] { embree::Tree::from_text(text, "a"); }).find("cannot read images") != std::string::npos);
}

TEST_CASE("wrong texts say where") {
    CHECK(message_of([] { embree::Tree::from_text("{", "x.json"); }).find("x.json:1:2") != std::string::npos);
    CHECK(message_of([] { embree::Tree::from_file("/nowhere/at/all.json"); }).find("/nowhere/at/all.json") !=
          std::string::npos);
    const std::string_view with_zero("{\"phases\": \0}", 13);
    CHECK(message_of([&] { embree::Tree::from_text(with_zero); }) != "no error");
    CHECK(message_of([] { embree::Tree::from_text(""); }) != "no error");
}

}  // namespace test_trees
