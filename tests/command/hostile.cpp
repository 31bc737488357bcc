// Invalid scene files, by mistake or on purpose. They must cause a single error with the position and the problem and
// exit code 2, at once, leave no files behind, and never cause a crash or a hang. wrong_arguments.cpp tests other
// invalid input.
#include <sys/stat.h>

#include <algorithm>
#include <regex>

#include "command.hpp"
#include "phasetree/io/document.hpp"
#include "phasetree/io/error.hpp"
#include "scene/scene.hpp"

namespace test_hostile {

using namespace phasetree::tests;

namespace {

std::string nested(const std::string& open, const std::string& middle, const std::string& close, int n) {
    std::string text;
    for (int i = 0; i < n; ++i) text += open;
    text += middle;
    for (int i = 0; i < n; ++i) text += close;
    return text;
}

// One error of one message: "<place>: <what>", then perhaps the line and a caret.
void check_error(Outcome o, const std::string& place, const std::string& message) {
    // On a busy machine even an error may take so long that progress is shown.
    o.err = without_lines(o.err, "reading the scene: ");
    CAPTURE(o.err.substr(0, 500));
    CHECK(o.code == 2);
    CHECK(o.signal == 0);
    CHECK(o.out == "");
    CHECK(o.processor_seconds < at_once);
    const std::string first = o.err.substr(0, o.err.find('\n'));
    const bool at_place = std::regex_search(first, std::regex("^" + place));
    CHECK(at_place);
    CHECK(first.find(message) != std::string::npos);
    const auto lines = std::count(o.err.begin(), o.err.end(), '\n');
    CHECK((lines == 1 || lines == 3));
    CHECK(o.err.size() < 2000);
}

const std::string in_text = R"(scene\.json:[0-9]+:[0-9]+: )";
const std::string of_file = R"(scene\.json: )";

struct Case {
    std::string name, text, message;
};

// Scenes with one mistake each, and the error message for it.
class WrongScenes {
  public:
    WrongScenes() {
        add_texts();
        add_keys_and_numbers();
        add_phases();
        add_trees();
        add_trees_without_end();
        add_cameras_and_lights();
        add_meshes_and_settings();
    }
    const std::vector<Case>& cases() const { return cases_; }

  private:
    template <class Change>
    void add(const std::string& name, const std::string& message, Change&& change) {
        SceneText scene;
        change(scene);
        cases_.push_back({name, scene.text(), message});
    }
    void tree(const std::string& name, const std::string& message, const std::string& text) {
        add(name, message, [&](SceneText& s) { s.tree = text; });
    }
    void ball(const std::string& name, const std::string& message, const std::string& shape) {
        add(name, message, [&](SceneText& s) { s.shapes = R"({"ball": )" + shape + "}"; });
    }
    void camera(const std::string& name, const std::string& message, const std::string& text) {
        add(name, message, [&](SceneText& s) { s.camera = text; });
    }
    void light(const std::string& name, const std::string& message, const std::string& text) {
        add(name, message, [&](SceneText& s) { s.lights = "[" + text + "]"; });
    }
    void rest(const std::string& name, const std::string& message, const std::string& text) {
        add(name, message, [&](SceneText& s) { s.rest = text; });
    }
    void phases(const std::string& name, const std::string& message, const std::string& text) {
        add(name, message, [&](SceneText& s) { s.phases = text; });
    }

    // Not JSON, or not this kind.
    void add_texts() {
        cases_.push_back({"empty", "", "empty"});
        cases_.push_back({"blank", " \n\t\n", "empty"});
        cases_.push_back({"an array", "[]", "object"});
        cases_.push_back({"a number", "1", "object"});
        cases_.push_back({"noise", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16), ""});
        cases_.push_back({"arrays 10⁵ deep", nested("[", "", "]", 100000), "nested"});
        cases_.push_back({"arrays 10⁵ deep, never closed", nested("[", "", "", 100000), "nested"});
        tree("nodes 401 deep", "deeper than 400 nodes",
             nested(R"({"translate": {"by": [0, 0, 1], "of": )", R"({"set": {"phase": "glass", "of": "ball"}})", "}}",
                    400));
        tree("nodes 10⁵ deep", "nested",
             nested(R"({"translate": {"by": [0, 0, 1], "of": )", R"({"set": {"phase": "glass", "of": "ball"}})", "}}",
                    100000));
        cases_.push_back({"two scenes", SceneText().text() + SceneText().text(), ""});
        cases_.push_back({"a quote too few", R"({"version: 1})", ""});
        cases_.push_back({"no version", "{}", "version"});
        cases_.push_back({"another version", R"({"version": 2})", "\"version\" must be 1"});
        cases_.push_back({"a version of another kind", R"({"version": "banana"})", "version"});
        cases_.push_back({"a schema without a name", R"({"$schema": 3, "version": 1})", "$schema"});
    }
    // Keys, kinds and numbers.
    void add_keys_and_numbers() {
        rest("unknown key", "did you mean \"background\"", R"("backgruond": [0, 0, 0])");
        rest("setting of the image in the scene", "\"samples\" belongs in \"render\"", R"("samples": 3)");
        rest("setting of the camera in the scene", "\"fov\" belongs in \"camera\"", R"("fov": 3)");
        rest("a key twice", "lights", R"("lights": [])");
        ball("misspelt parameter", "did you mean \"radius\"", R"({"sphere": {"raduis": 1}})");
        ball("misspelt node", "did you mean \"sphere\"", R"({"shpere": {"radius": 1}})");
        ball("missing parameter", "radius", R"({"sphere": {}})");
        ball("not a number", "NaN", R"({"sphere": {"radius": NaN}})");
        ball("infinite", "", R"({"sphere": {"radius": Infinity}})");
        ball("too large for a double", "", R"({"sphere": {"radius": 1e999}})");
        ball("too large for a float", "", R"({"sphere": {"radius": 1e39}})");
        ball("negative", "radius", R"({"sphere": {"radius": -1}})");
        ball("zero", "radius", R"({"sphere": {"radius": 0}})");
        ball("text for a number", "radius", R"({"sphere": {"radius": "1"}})");
        ball("list for a number", "radius", R"({"sphere": {"radius": [1]}})");
        ball("number for a node", "node", "1");
        ball("two nodes in one", "one member", R"({"sphere": {"radius": 1}, "box": {"size": [1, 1, 1]}})");
        ball("two numbers for three", "three", R"({"box": {"size": [1, 1]}})");
        ball("no children", "empty", R"({"union": []})");
        ball("a plane without direction", "normal must not be zero", R"({"plane": {"normal": [0, 0, 0]}})");
    }
    // Phases and their materials.
    void add_phases() {
        phases("no phases", "empty", "{}");
        phases("vacuum as a phase", "vacuum", R"({"vacuum": {"clear": {"ior": 1}}})");
        phases("unknown material", "did you mean \"clear\"", R"({"glass": {"claer": {"ior": 1.5}}})");
        phases("material of two kinds", "one member", R"({"glass": {"clear": {"ior": 1}, "diffuse": {}}})");
        phases("material without index", "ior", R"({"glass": {"clear": {}}})");
        phases("index out of range", "ior", R"({"glass": {"clear": {"ior": 0}}})");
        phases("metal nobody knows", "did you mean \"gold\"", R"({"glass": {"conductor": {"metal": "glod"}}})");
        phases("too many phases", "63", [] {
            std::string all = "{";
            for (int i = 0; i < 80; ++i)
                all += (i ? ", \"p" : "\"p") + std::to_string(i) + R"(": {"clear": {"ior": 1.5}})";
            return all + "}";
        }());
    }
    // Trees that are no object.
    void add_trees() {
        tree("unknown phase", "did you mean \"glass\"", R"({"set": {"phase": "galss", "of": "ball"}})");
        tree("the vacuum", "vacuum", R"({"set": {"phase": "vacuum", "of": "ball"}})");
        tree("unknown shape", "did you mean \"ball\"", R"({"set": {"phase": "glass", "of": "bell"}})");
        tree("a field where phases are needed", "phases", R"("ball")");
        tree("phases where a field is needed", "plain field",
             R"({"set": {"phase": "glass", "of": {"set": {"phase": "glass", "of": "ball"}}}})");
        tree("unbounded", "unbounded", R"({"set": {"phase": "glass", "of": {"plane": {}}}})");
        tree("a twist of an unbounded object", "",
             R"({"set": {"phase": "glass", "of": {"twist": {"rate": 10, "of": {"plane": {}}}}}})");
    }
    // Trees that are infinite, or too large to wait for.
    void add_trees_without_end() {
        ball("a shape of itself", "contains itself", R"({"translate": {"by": [0, 0, 1], "of": "ball"}})");
        add("two shapes of each other", "contains itself",
            [](SceneText& s) { s.shapes = R"({"ball": {"union": ["other"]}, "other": {"union": ["ball"]}})"; });
        add("two names of each other", "itself",
            [](SceneText& s) { s.shapes = R"({"ball": "other", "other": "ball"})"; });
        add("10⁵ chained shapes", "deeper", [](SceneText& s) {
            s.shapes = R"({"ball": {"union": ["s1"]})";
            for (int i = 1; i <= 100000; ++i)
                s.shapes += ", \"s" + std::to_string(i) + R"(": {"union": ["s)" + std::to_string(i + 1) + "\"]}";
            s.shapes += R"(, "s100001": {"sphere": {"radius": 1}}})";
        });
        add("10⁵ names of names", "", [](SceneText& s) {
            s.shapes = R"({"ball": "s1")";
            for (int i = 1; i <= 100000; ++i)
                s.shapes += ", \"s" + std::to_string(i) + R"(": "s)" + std::to_string(i + 1) + "\"";
            s.shapes += R"(, "s100001": {"sphere": {"radius": 1}}})";
        });
        // Every shape is two of the last, moved apart: 2⁴⁰ spheres.
        const auto laughs = [](SceneText& s) {
            s.shapes = R"({"s0": {"sphere": {"radius": 1}})";
            for (int i = 1; i <= 40; ++i) {
                const std::string last = "\"s" + std::to_string(i - 1) + "\"";
                s.shapes += ", \"s" + std::to_string(i) + R"(": {"union": [{"translate": {"by": [0.1, 0, 0], "of": )" +
                            last + R"(}}, {"rotate": {"angle": 7, "of": )" + last + "}}]}";
            }
            s.shapes += R"(, "ball": "s40"})";
        };
        add("a billion laughs", "instructions", laughs);
        add("a billion laughs about the camera", "instructions", [&](SceneText& s) {
            laughs(s);
            s.camera = R"({"position": [0.1, 0, 0.3], "look_at": [0, 0, 0]})";
        });
        add("a billion laughs in phases", "instructions", [](SceneText& s) {
            s.shapes = R"({"ball": {"sphere": {"radius": 1}}, "s0": {"set": {"phase": "glass", "of": "ball"}})";
            for (int i = 1; i <= 40; ++i) {
                const std::string last = "\"s" + std::to_string(i - 1) + "\"";
                s.shapes += ", \"s" + std::to_string(i) + R"(": {"under": [{"translate": {"by": [0.1, 0, 0], "of": )" +
                            last + R"(}}, {"rotate": {"angle": 7, "of": )" + last + "}}]}";
            }
            s.shapes += "}";
            s.tree = "\"s40\"";
        });
    }
    // Cameras and lights.
    void add_cameras_and_lights() {
        camera("camera that looks at itself", "", R"({"position": [0, 0, 3], "look_at": [0, 0, 3]})");
        camera("camera with keys as a whole", "cannot have keys",
               R"({"keys": [[0, {"position": [0, -5, 0], "look_at": [0, 0, 0]}]]})");
        camera("camera without a place", "position", R"({"look_at": [0, 0, 0]})");
        camera("camera that sees all", "fov", R"({"position": [0, -5, 0], "look_at": [0, 0, 0], "fov": 180})");
        camera("camera that sees nothing", "fov", R"({"position": [0, -5, 0], "look_at": [0, 0, 0], "fov": 0})");
        camera("camera as text", "camera", R"("front")");
        camera("camera of no kind that there is", "orthographic", R"({"fisheye": {"position": [0, -5, 0]}})");
        camera("orthographic camera as wide as the world", "height",
               R"({"orthographic": {"position": [0, -5, 0], "look_at": [0, 0, 0], "height": 2e18}})");
        camera("orthographic camera of no height", "height",
               R"({"orthographic": {"position": [0, -5, 0], "look_at": [0, 0, 0], "height": -1}})");
        // Farther than rays can come from.
        camera("camera at the end of the world", "position", R"({"position": [0, -2e18, 0], "look_at": [0, 0, 0]})");
        camera("camera of a boundless lens", "lens_radius",
               R"({"position": [0, -5, 0], "look_at": [0, 0, 0], "lens_radius": 1e19})");
        camera("focus at the end of the world", "focus_at",
               R"({"position": [0, -5, 0], "look_at": [0, 0, 0], "focus_at": [0, 1e19, 0]})");
        light("light at the end of the world", "centre", R"({"sphere": {"centre": [0, 0, 3e18], "radius": 1}})");
        light("a light as large as the world", "width",
              R"({"rectangle": {"centre": [0, 0, 3], "target": [0, 0, 0], "width": 1e20, "height": 1}})");
        add("camera in wood", "inside the phase \"wood\"", [](SceneText& s) {
            s.tree = R"({"set": {"phase": "wood", "of": "ball"}})";
            s.camera = R"({"position": [0, 0, 0.5], "look_at": [0, 0, 0]})";
        });
        light("no lights", "no lights", "");
        light("unknown light", "did you mean \"sphere\"", R"({"shpere": {"centre": [0, 0, 3], "radius": 1}})");
        light("a light without size", "radius", R"({"sphere": {"centre": [0, 0, 3], "radius": 0}})");
        light("negative light", "radiance", R"({"constant": {"radiance": [1, -1, 1]}})");
        light("an image that is not there", "nowhere.exr", R"({"image": {"file": "nowhere.exr"}})");
        light("a directory for an image", "", R"({"image": {"file": "."}})");
        light("the scene for an image", "", R"({"image": {"file": "scene.json"}})");
    }
    // Meshes, settings, and objects too large or too small for rays.
    void add_meshes_and_settings() {
        rest("floor at the end of the world", "height", R"("meshes": [{"floor": {"height": -1e20, "material":
            {"diffuse": {"color": [1, 1, 1]}}}}])");
        tree("too large for rays", "beyond what 32-bit floats can trace",
             R"({"set": {"phase": "glass", "of": {"sphere": {"radius": 3e38}}}})");
        tree("too small for rays", "beyond what 32-bit floats can trace",
             R"({"set": {"phase": "glass", "of": {"sphere": {"radius": 1e-30}}}})");
        rest("a view that is not there", "Nowhere", R"("render": {"width": 4, "height": 4, "view": "Nowhere"})");
        rest("a mesh that is not there", "nowhere.obj",
             R"("meshes": [{"obj": {"file": "nowhere.obj", "material": {"diffuse": {"color": [1, 1, 1]}}}}])");
        rest("a directory for a mesh", "must end in .obj",
             R"("meshes": [{"obj": {"file": ".", "material": {"diffuse": {"color": [1, 1, 1]}}}}])");
        rest("the scene for a mesh", "scene.json",
             R"("meshes": [{"obj": {"file": "scene.json", "material": {"diffuse": {"color": [1, 1, 1]}}}}])");
        rest("a mesh of glass", "", R"("meshes": [{"floor": {"material": {"clear": {"ior": 1.5}}}}])");
        rest("meshes as an object", "list", R"("meshes": {})");
        rest("no width", "width", R"("render": {"width": 0})");
        rest("too wide", "width", R"("render": {"width": 1000000})");
        rest("half a sample", "samples", R"("render": {"samples": 1.5})");
        rest("no samples", "samples", R"("render": {"samples": 0})");
        rest("a negative seed", "seed", R"("render": {"seed": -1})");
    }

    std::vector<Case> cases_;
};

}  // namespace

TEST_CASE("wrong scenes: one error with its place, exit code 2, at once, nothing left behind") {
    int count = 0;
    const WrongScenes wrong;
    for (const Case& c : wrong.cases()) {
        CAPTURE(c.name);
        const Shell shell;
        write_text(shell.directory / "scene.json", c.text);
        const Outcome rendered = shell.run({"render", "scene.json", "-o", "a.exr", "-o", "b.png", "--stats", "c.json"});
        check_error(rendered, in_text, c.message);
        CHECK(shell.directory.size() == 1);
        const bool is_numbers = c.name.find("world") != std::string::npos || c.name.find("rays") != std::string::npos ||
                                c.name.find("view") != std::string::npos;
        if (++count % 10 != 0 && !is_numbers) continue;
        const Outcome checked = shell.run({"check", "scene.json"});
        CHECK(checked.code == 2);
        CHECK(checked.err == rendered.err);
    }
}

namespace {

// Requirements of pictures only: the object can be traced, seen and lit, and the files of lights and meshes exist.
// Other commands that read scenes do not require this.
bool is_for_pictures_alone(const std::string& name) {
    for (const char* part : {"camera in wood", "no lights", "unbounded", "too large for rays", "too small for rays",
                             "a view that is not there", "an image that is not there", "a directory for an image",
                             "the scene for an image", "a mesh that is not there", "the scene for a mesh"})
        if (name.find(part) != std::string::npos) return true;
    return false;
}

}  // namespace

TEST_CASE(
    "eval, trace, info, measure, solve, slice and export refuse the scenes that check refuses, in the same words") {
    const Shell shell;
    const std::vector<std::vector<std::string>> commands{
        {"eval", "scene.json"},
        {"trace", "scene.json"},
        {"info", "scene.json"},
        {"measure", "scene.json"},
        {"solve", "scene.json", "--set", "/x", "--until", "volume(x) = 1"},
        {"slice", "scene.json", "--z", "0"},
        {"export", "scene.json", "-o", "a.glsl"}};
    std::size_t count = 0;
    const auto check_same = [&](const std::string& name, const std::string& text, bool all) {
        CAPTURE(name);
        write_text(shell.directory / "scene.json", text);
        const Outcome checked = shell.run({"check", "scene.json"});
        CHECK(checked.code == 2);
        for (std::size_t i = 0; i < commands.size(); ++i) {
            if (!all && i != count % commands.size()) continue;
            CAPTURE(commands[i][0]);
            const Outcome o = shell.run(commands[i], "0 0 0\n");
            CHECK(o.code == 2);
            CHECK(o.err == checked.err);
            CHECK(o.out == "");
            CHECK(o.processor_seconds < at_once);
        }
        ++count;
    };
    const WrongScenes wrong;
    for (const Case& c : wrong.cases())
        if (!is_for_pictures_alone(c.name)) check_same(c.name, c.text, false);

    // Every part of a file, with a camera and without one.
    const std::string ball = R"("tree": {"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}})";
    const std::string camera = R"(, "camera": {"position": [0, -5, 0], "look_at": [0, 0, 0]})";
    const std::string glass = R"("phases": {"glass": {"clear": {"ior": 1.5}}}, )";
    for (const bool has_camera : {true, false}) {
        CAPTURE(has_camera);
        const std::string end = (has_camera ? camera : "") + R"(, "lights": [{"constant": {}}]})";
        const auto wrong_part = [&](const std::string& name, const std::string& text) {
            check_same(name, "{" + text + end, true);
        };
        wrong_part("version 2", R"("version": 2, )" + glass + ball);
        wrong_part("version banana", R"("version": "banana", )" + glass + ball);
        wrong_part("a misspelt part", R"("version": 1, "lihgts": [], )" + glass + ball);
        wrong_part("a schema that is no name", R"("version": 1, "$schema": 1, )" + glass + ball);
        wrong_part("a misspelt material", R"("version": 1, "phases": {"glass": {"claer": {"ior": 1.5}}}, )" + ball);
        wrong_part("voxels of images without a spacing",
                   R"("version": 1, "phases": {"glass": {"clear": {"ior": 1.5, "scattering": [1, 1, 1],
                      "density_grid": {"file": "no#.png"}}}}, )" +
                       ball);
        wrong_part("a mesh of the wrong format", R"("version": 1, "meshes": [{"obj": {"file": "no.ply", "material":
                      {"diffuse": {"color": "#808080"}}}}], )" +
                                                     glass + ball);
        wrong_part("a misspelt setting", R"("version": 1, "render": {"wdith": 3}, )" + glass + ball);
        wrong_part("places of nothing", R"("version": 1, "instances": [], )" + glass + ball);
        wrong_part("a wrong background", R"("version": 1, "background": "blue", )" + glass + ball);
    }
    const std::string version_and_ball = "{\"version\": 1, " + glass + ball;
    check_same("a wrong light", version_and_ball + R"(, "lights": [{"sphere": {"centre": [0, 0, 3]}}]})", true);
    check_same(
        "a light of a file, aimed at itself",
        version_and_ball + R"(, "lights": [{"ies": {"file": "no.ies", "position": [0, 0, 1], "target": [0, 0, 1]}}]})",
        true);
    check_same("a light of a file, of a group that can be none",
               version_and_ball + R"(, "lights": [{"image": {"file": 1, "group": "a b"}}]})", true);
    check_same("a camera without a version", "{" + glass + ball + camera + "}", true);
    check_same("a camera and no material", R"({"version": 1, "phases": {"glass": null}, )" + ball + camera + "}", true);
    check_same("a wrong camera", version_and_ball + R"(, "camera": {"position": [0, 0, 0]}})", true);
}

TEST_CASE("eval, trace, info, measure and export do not need the files of lights, meshes, textures and voxels") {
    const Shell shell;
    write_text(shell.directory / "scene.json", R"({"version": 1, "phases": {
        "glass": {"clear": {"ior": 1.5, "scattering": [1, 1, 1], "emission": [1, 1, 1],
            "density_grid": {"file": "no.vdb"}, "temperature_grid": {"file": "no#.png", "spacing": [1, 1, 1]}}},
        "wood": {"coated": {"color": {"image": {"file": "no.png"}}, "roughness": 0.1}}},
        "tree": {"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}},
        "meshes": [{"gltf": {"file": "no.glb"}}, {"obj": {"file": "no.obj", "material": {"diffuse": {"color":
            {"mesh_image": {"file": "no.png"}}, "normal_map": {"file": "no.png"}}}}}],
        "lights": [{"image": {"file": "no.exr"}}, {"ies": {"file": "no.ies", "position": [0, 0, 3], "target": [0, 0, 0]}}],
        "camera": {"position": [0, -5, 0], "look_at": [0, 0, 0]}})");
    CHECK(shell.run({"check", "scene.json"}).code == 2);
    const Outcome points = shell.run({"eval", "scene.json"}, "0 0 0\n");
    CHECK(points.err == "");
    CHECK(points.out == "x,y,z,phase,phi.vacuum,phi.glass,phi.wood\n0,0,0,glass,1,-1,\n");
    CHECK(shell.run({"trace", "scene.json"}, "0 0 5 0 0 -1\n").code == 0);
    CHECK(shell.run({"info", "scene.json", "--cells"}).code == 0);
    CHECK(shell.run({"measure", "scene.json", "--tolerance", "0.5"}).code == 0);
    CHECK(shell.run({"export", "scene.json", "-o", "a.glsl"}).code == 0);
}

TEST_CASE("files that are no files") {
    const Shell shell;
    std::filesystem::create_directory(shell.directory / "directory");
    REQUIRE(::mkfifo((shell.directory / "pipe").c_str(), 0600) == 0);
    struct File {
        const char *name, *message;
    };
    for (const File& f : {File{"nowhere.json", ""}, File{"directory", "directory"}, File{"pipe", ""},
                          File{"/dev/zero", ""}, File{"nowhere/scene.json", ""}, File{"", ""}}) {
        CAPTURE(f.name);
        for (const char* command : {"render", "eval"}) {
            CAPTURE(command);
            const Outcome o = shell.run({command, f.name});
            CAPTURE(o.err);
            CHECK(o.code == 2);
            CHECK(o.out == "");
            CHECK(o.processor_seconds < at_once);
            CHECK(o.err.find(f.message) != std::string::npos);
            CHECK(o.err.size() > 10);
        }
    }
    CHECK(shell.directory.size() == 2);
}

TEST_CASE("a scene cut off anywhere is an error, never another scene") {
    SceneText scene;
    scene.rest = R"("background": [0, 0, 0], // black
        "meshes": [{"floor": {"height": -1.2, "material": {"coated": {"color": {"wood": {"ring_spacing": 0.1}}}}}}])";
    const std::string whole = scene.text();
    CHECK_NOTHROW(phasetree::tracer::read_scene(phasetree::Document::from_text(whole)));
    for (std::size_t n = 0; n + 2 < whole.size(); ++n) {
        CAPTURE(n);
        CHECK_THROWS_AS(phasetree::tracer::read_scene(phasetree::Document::from_text(whole.substr(0, n))),
                        phasetree::SceneError);
    }
    const Shell shell;
    for (const std::size_t part : {5u, 3u, 2u}) {
        write_text(shell.directory / "scene.json", whole.substr(0, whole.size() - whole.size() / part));
        check_error(shell.run({"render", "scene.json", "-o", "a.exr"}), in_text, "");
    }
    CHECK(shell.directory.size() == 1);
}

TEST_CASE("numbers at the ends of their ranges neither crash nor hang") {
    const std::vector<std::pair<std::string, std::string>> trees{
        {"tiny", R"({"set": {"phase": "glass", "of": {"sphere": {"radius": 1e-30}}}})"},
        {"huge", R"({"set": {"phase": "glass", "of": {"sphere": {"radius": 1e30}}}})"},
        {"hugest", R"({"set": {"phase": "glass", "of": {"sphere": {"radius": 3.4e38}}}})"},
        {"far away", R"({"set": {"phase": "glass", "of": {"translate": {"by": [1e30, 0, 0], "of": "ball"}}}})"},
        {"flat", R"({"set": {"phase": "glass", "of": {"box": {"size": [1e15, 1e-15, 1]}}}})"},
        {"scaled to nothing", R"({"scale": {"factor": 1e-38, "of": {"set": {"phase": "glass", "of": "ball"}}}})"},
        {"scaled twice",
         R"({"scale": {"factor": 1e30, "of": {"scale": {"factor": 1e30, "of": {"set": {"phase": "glass", "of": "ball"}}}}}})"},
        {"wound up",
         R"({"set": {"phase": "glass", "of": {"twist": {"rate": 1e30, "of": {"box": {"size": [1, 1, 1]}}}}}})"}};
    const Shell shell;
    for (const auto& [name, tree] : trees) {
        const std::string what = name;  // Clang 14 cannot capture a binding
        CAPTURE(what);
        SceneText scene;
        scene.tree = tree;
        scene.rest = R"("render": {"width": 4, "height": 4, "samples": 1})";
        write_text(shell.directory / "scene.json", scene.text());
        const Outcome o = shell.run({"render", "scene.json", "-o", "a.exr", "--quiet"});
        CAPTURE(o.err);
        CHECK((o.code == 0 || o.code == 2));
        CHECK((o.code == 0) == o.err.empty());
        CHECK(o.processor_seconds < 2 * at_once);
    }
}

}  // namespace test_hostile
