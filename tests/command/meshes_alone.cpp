// Scenes of meshes without an object, in each subcommand.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

#include "command/command.hpp"

namespace test_meshes_alone {

using namespace phasetree::tests;

namespace {

const std::string camera = R"("camera": {"position": [0, -5, 0.5], "look_at": [0, 0, 0.5]})";
const std::string meshes = R"("meshes": [
    {"floor": {"material": {"diffuse": {"color": [0.5, 0.5, 0.5]}}}},
    {"obj": {"file": "square.obj", "material": {"diffuse": {"color": [0.8, 0.2, 0.2]}}}}])";

std::string scene_with(const std::string& more) {
    return R"({"version": 1, "lights": [{"constant": {}}], "render": {"width": 8, "height": 8, "samples": 1},
)" + meshes +
           more + "}";
}

// What is wrong, without the place's line of the file.
std::string first_line_of(const std::string& text) {
    return text.substr(0, text.find('\n') + 1);
}

// A folder with a scene of two meshes, and others like it.
class Scenes {
  public:
    Scenes() {
        write("square.obj", "v -1 0 0\nv 1 0 0\nv 1 0 1\nv -1 0 1\nf 1 2 3 4\n");
        write("scene.json", scene_with(", " + camera));
        write("without camera.json", scene_with(""));
    }
    void write(const std::string& name, const std::string& text) const { write_text(shell.directory / name, text); }

    Shell shell;
};

}  // namespace

TEST_CASE("a scene of meshes alone is checked and rendered, and info lists them") {
    const Scenes scenes;
    const Shell& shell = scenes.shell;
    const Outcome check = shell.run({"check", "scene.json"});
    CHECK(check.code == 0);
    CHECK(check.err == "");
    CHECK(check.out == "");
    const Outcome render = shell.run({"render", "scene.json", "-o", "a.png", "--threads", "1"});
    CHECK(render.code == 0);
    CHECK(render.err.find("empty") == std::string::npos);
    CHECK(bytes_of(shell.directory / "a.png").starts_with("\x89PNG"));
    const Outcome planes = shell.run({"render", "scene.json", "-o", "a.exr", "--planes", "all"});
    CHECK(planes.code == 0);
    CHECK(planes.err.find("error") == std::string::npos);

    const Outcome info = shell.run({"info", "scene.json"});
    CHECK(info.code == 0);
    CHECK(info.out.find("mesh          obj: 2 triangles, 4 vertices, [-1, 0, 0] to [1, 0, 1]\n") != std::string::npos);
    const Outcome json = shell.run({"info", "--json", "scene.json"});
    REQUIRE(json.code == 0);
    const auto listed = nlohmann::json::parse(json.out).at("meshes");
    REQUIRE(listed.size() == 2);
    CHECK(listed[0].at("name") == "floor");
    CHECK(listed[1].at("triangles") == 2);
    CHECK(listed[1].at("bounds")[1][2] == 1);
    CHECK(shell.run({"info", "--cells", "scene.json"}).err ==
          "phasetree: --cells needs an object, but the scene has only meshes\n");

    const Outcome without = shell.run({"check", "without camera.json"});
    CHECK(without.code == 3);
    CHECK(without.out ==
          "without camera.json: the meshes are valid and can be used by info; without a \"camera\" the scene cannot be "
          "rendered\n");
    CHECK(shell.run({"info", "without camera.json"}).code == 0);
}

TEST_CASE("commands that need an object say so for a scene of meshes alone") {
    const Scenes scenes;
    const std::string needs =
        "scene.json:2:1: the scene has only meshes, but this command needs an object: \"phases\" and \"tree\", or "
        "\"objects\"\n";
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"eval", "scene.json"},
                                                      {"trace", "scene.json"},
                                                      {"export", "scene.json", "-o", "a.glsl"},
                                                      {"export", "scene.json", "-o", "a.obj"},
                                                      {"export", "scene.json", "-o", "a.html"}}) {
        CAPTURE(arguments[0]);
        const Outcome outcome = scenes.shell.run(arguments);
        CHECK(outcome.code == 2);
        CHECK(outcome.err.starts_with(needs));
    }
}

TEST_CASE("a scene has both phases and a tree, or neither") {
    const Scenes scenes;
    const auto said = [&](const std::string& more) {
        scenes.write("half.json", scene_with(more + ", " + camera));
        const Outcome outcome = scenes.shell.run({"check", "half.json"});
        CHECK(outcome.code == 2);
        return first_line_of(outcome.err);
    };
    CHECK(said(R"(,
"phases": {"a": {"clear": {"ior": 1.5}}})") ==
          "half.json:5:1: the scene has \"phases\", but no \"tree\"; add it, or remove \"phases\" to show the meshes "
          "alone\n");
    CHECK(said(R"(,
"tree": {"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}})") ==
          "half.json:5:1: the scene has \"tree\", but no \"phases\"; add it, or remove \"tree\" to show the meshes "
          "alone\n");
    CHECK(said(R"(,
"phases": {}, "tree": {"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}})") ==
          "half.json:5:11: \"phases\" must not be empty; remove it if the scene has no \"tree\"\n");
    CHECK(said(R"(,
"instances": [{"of": "a"}])") == "half.json:5:1: \"instances\" requires \"objects\"\n");
    // Without meshes there would be nothing to see.
    scenes.write("nothing.json", R"({"version": 1, "lights": [{"constant": {}}], "meshes": [], )" + camera + "}");
    CHECK(first_line_of(scenes.shell.run({"check", "nothing.json"}).err) ==
          "nothing.json:1:1: the scene needs \"phases\"\n");
}

}  // namespace test_meshes_alone
