// `phasetree export`: the files that it writes, and its errors. tests/glsl tests what the shaders compute.
#include "command.hpp"

namespace test_export {

using namespace phasetree::tests;

namespace {

// Checks that `export` with these arguments is rejected with a short message that contains this text.
auto refused_by(const Shell& shell) {
    return [&shell](const std::vector<std::string>& arguments, const std::string& said, int code = 2) {
        std::vector<std::string> words{"export"};
        words.insert(words.end(), arguments.begin(), arguments.end());
        const Outcome o = shell.run(words);
        CAPTURE(o.err);
        CHECK(o.code == code);
        CHECK(o.err.find(said) != std::string::npos);
        // On a slow machine, progress precedes the message.
        const std::string progress = "elapsed\n";
        const std::size_t at = o.err.rfind(progress);
        CHECK(o.err.size() - (at == std::string::npos ? 0 : at + progress.size()) < 400);
    };
}

}  // namespace

TEST_CASE("a shader is text with all functions that its comments name, and nothing else is written") {
    const Shell shell;
    write_text(shell.directory / "scene.json", SceneText().text());
    const Outcome o = shell.run({"export", "scene.json", "-o", "shader.glsl"});
    CHECK(o.code == 0);
    CHECK(o.out == "");
    CHECK(o.err == "");
    const std::string text = bytes_of(shell.directory / "shader.glsl");
    for (const char* function :
         {"void phasetree_distances(vec3 p,", "void phasetree_gradients(vec3 p,", "int phasetree_label(vec3 p)",
          "int phasetree_sample(vec3 p,", "vec3 phasetree_normal(vec3 p,", "PhasetreeCrossing phasetree_trace("}) {
        CAPTURE(function);
        const std::size_t named = text.find(function);
        CHECK(named != std::string::npos);
        CHECK(text.find(function, named + 1) != std::string::npos);
    }
    CHECK(text.find("// phase 1: glass") != std::string::npos);
    CHECK(text.find("\n#version") == std::string::npos);
    CHECK(shell.run({"export", "scene.json", "-o", "again.glsl"}).code == 0);
    CHECK(bytes_of(shell.directory / "again.glsl") == text);
}

TEST_CASE("numbers that no text can hold are in a file beside, in whole rows of a texture") {
    const Shell shell;
    write_text(shell.directory / "scene.json", SceneText().text());
    const Outcome o = shell.run({"export", "scene.json", "-o", "shader.glsl", "--grid", "16"});
    CHECK(o.code == 0);
    const std::string numbers = bytes_of(shell.directory / "shader.f32");
    CHECK(!numbers.empty());
    CHECK(numbers.size() % (4 * 4 * 1024) == 0);
    CHECK(bytes_of(shell.directory / "shader.glsl").find("uniform highp sampler2D phasetree_numbers;") !=
          std::string::npos);
}

TEST_CASE("a page is one small file that asks for no other, whatever phases are called") {
    const Shell shell;
    SceneText scene;
    scene.phases = R"({"</script><b>&\"": {"clear": {"ior": 1.5}}, "wood": {"diffuse": {"color": [0.5, 0.4, 0.3]}}})";
    scene.tree = R"({"set": {"phase": "</script><b>&\"", "of": "ball"}})";
    write_text(shell.directory / "scene.json", scene.text());
    const Outcome o = shell.run({"export", "scene.json", "-o", "page.html"});
    CHECK(o.err == "");
    CHECK(o.code == 0);
    const std::string page = bytes_of(shell.directory / "page.html");
    CHECK(page.starts_with("<!DOCTYPE html>"));
    CHECK(page.size() < 500'000);
    CHECK(page.find("<b>&") == std::string::npos);
    CHECK(page.find("</script>") == page.rfind("</script>"));
    for (const char* word : {"http:", "https:", "src=", "href=", "@import", "fetch("})
        CHECK(page.find(word) == std::string::npos);
}

TEST_CASE("a page of a tree alone has colours of its own") {
    const Shell shell;
    write_text(
        shell.directory / "tree.json",
        R"({"version": 1, "phases": {"a": null}, "tree": {"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}}})");
    const Outcome o = shell.run({"export", "tree.json", "-o", "page.html"});
    CHECK(o.err == "");
    CHECK(o.code == 0);
    CHECK(bytes_of(shell.directory / "page.html").find("<canvas") != std::string::npos);
}

TEST_CASE("triangles: what is wrong is said in a line, and no file is written") {
    const Shell shell;
    write_text(shell.directory / "scene.json", SceneText().text());
    SceneText shell_scene;
    shell_scene.tree =
        R"({"set": {"phase": "glass", "of": {"shell": {"of": {"sphere": {"radius": 1}}, "half_thickness": 0.001}}}})";
    write_text(shell.directory / "thin.json", shell_scene.text());
    const auto refused = refused_by(shell);
    refused({"scene.json", "-o", "a.stl", "--phase", "glas"}, R"(unknown phase "glas" (did you mean "glass"?))");
    refused({"scene.json", "-o", "a.stl", "--phase", "beer"}, R"(unknown phase "beer"; the only phase is "glass")");
    refused({"scene.json", "-o", "a.stl", "--phase", "vacuum"}, "surrounds the object");
    refused({"scene.json", "-o", "a.stl", "--spacing", "1e-9"}, "needs more than 1024 cubes");
    refused({"scene.json", "-o", "a.stl", "--spacing", "0"}, "--spacing");
    refused({"scene.json", "-o", "a.stl", "--spacing", "nan"}, "--spacing");
    refused({"scene.json", "-o", "a.stl", "--scale", "3e38"}, "would be too large");
    refused({"scene.json", "-o", "a.stl", "--scale", "1e-40"}, "would be too small");
    refused({"scene.json", "-o", "a.stl", "--grid", "8"}, "--grid is for .glsl");
    refused({"scene.json", "-o", "a.html", "--scale", "2"},
            "--scale is for triangles and voxels, and .html files have neither");
    refused({"scene.json", "-o", "a.glsl", "--phase", "glass"}, "--phase is for triangles, and .glsl files have none");
    refused({"scene.json", "-o", "{phase}.obj"}, "{phase} requires an .stl file");
    refused({"thin.json", "-o", "a.stl", "--spacing", "0.5"}, "there are no triangles");
    for (const auto& entry : std::filesystem::directory_iterator(shell.directory / "."))
        CHECK(entry.path().extension() == ".json");
    refused({"scene.json", "-o", "nowhere/a.stl"}, "nowhere", 1);
}

TEST_CASE("triangles: what is too thin is told, and what is asked of others is ignored by none") {
    const Shell shell;
    SceneText scene;
    scene.tree =
        R"({"thin_shell": {"of": {"sphere": {"radius": 1}}, "shell": "glass", "inside": "wood", "half_thickness": 0.01}})";
    write_text(shell.directory / "scene.json", scene.text());
    const Outcome o = shell.run({"export", "scene.json", "-o", "a.ply", "--spacing", "0.2"});
    CHECK(o.code == 0);
    CHECK(o.err.find("crossings along the grid were missed") != std::string::npos);
    const Outcome fine = shell.run({"export", "scene.json", "-o", "a.ply", "--spacing", "0.02"});
    CHECK(fine.code == 0);
    CHECK(fine.err == "");
}

TEST_CASE("triangles: names of phases lead to no other folder, and into no broken file") {
    const Shell shell;
    SceneText scene;
    scene.phases = R"({"..": {"clear": {"ior": 1.5}}, "a/b\ufffe": {"diffuse": {"color": [0.5, 0.4, 0.3]}}})";
    scene.tree = R"({"under": [{"set": {"phase": "..", "of": {"sphere": {"radius": 1}}}},
                               {"set": {"phase": "a/b\ufffe", "of": {"translate": {"by": [3, 0, 0], "of": {"sphere": {"radius": 1}}}}}}]})";
    write_text(shell.directory / "scene.json", scene.text());
    std::filesystem::create_directories(shell.directory / "in");
    const Outcome o = shell.run({"export", "scene.json", "-o", "in/{phase}.stl", "--spacing", "0.2"});
    CHECK(o.err == "");
    CHECK(o.code == 0);
    CHECK(!bytes_of(shell.directory / "in/__.stl").empty());
    CHECK(!bytes_of(shell.directory / "in/a_b\xef\xbf\xbe.stl").empty());
    CHECK(shell.run({"export", "scene.json", "-o", "in/{phase}/x.stl", "--phase", ".."}).code == 1);
    CHECK(shell.run({"export", "scene.json", "-o", "a.3mf", "--spacing", "0.2"}).code == 0);
}

TEST_CASE("a mesh of several objects is that of all of them, or of one") {
    const Shell shell;
    write_text(shell.directory / "two.json", R"({"version": 1, "phases": {"a": null, "b": null}, "objects": [
        {"name": "one", "tree": {"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}}},
        {"name": "two", "tree": {"set": {"phase": "b", "of": {"sphere": {"radius": 0.5}}}}, "transform": {"translate": {"by": [0, 0, 2]}}}]})");
    CHECK(shell.run({"export", "two.json", "-o", "all.stl", "--spacing", "0.1"}).code == 0);
    CHECK(shell.run({"export", "two.json", "-o", "one.stl", "--spacing", "0.1", "--object", "one"}).code == 0);
    CHECK(bytes_of(shell.directory / "all.stl").size() > bytes_of(shell.directory / "one.stl").size());
    CHECK(shell.run({"export", "two.json", "-o", "{phase}.stl", "--spacing", "0.1"}).code == 0);
    CHECK(bytes_of(shell.directory / "a.stl").size() + bytes_of(shell.directory / "b.stl").size() ==
          bytes_of(shell.directory / "all.stl").size() + 84);
}

TEST_CASE("what was exported can stand beside another object, as a mesh of each format") {
    const Shell shell;
    SceneText text;
    text.phases = R"({"glass": {"clear": {"ior": 1.5}}, "wood": {"diffuse": {"color": [0.5, 0.4, 0.3]}}})";
    text.tree = R"({"over": [{"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}},
        {"set": {"phase": "wood", "of": {"translate": {"by": [3, 0, 0], "of": {"box": {"size": [1, 1, 1]}}}}}}]})";
    write_text(shell.directory / "scene.json", text.text());
    for (const std::string format : {"obj", "ply", "stl", "glb"}) {
        CAPTURE(format);
        CHECK(shell.run({"export", "scene.json", "-o", "a." + format, "--spacing", "0.2"}).code == 0);
        SceneText with_mesh;
        with_mesh.rest += R"(, "meshes": [{")" + (format == "glb" ? "gltf" : format) + R"(": {"file": "a.)" + format +
                          "\"" + (format == "glb" ? "}}]" : R"(, "material": {"diffuse": {"color": [1, 1, 1]}}}}])");
        write_text(shell.directory / "with_mesh.json", with_mesh.text());
        const Outcome o = shell.run({"check", "with_mesh.json"});
        CHECK(o.code == 0);
        // Only .glb says that the glass is clear.
        CHECK(o.err ==
              (format == "glb"
                   ? "warning: a.glb: \"glass\" is clear and therefore ignored, because meshes have "
                     "no interior; use \"phasetree import\" to make it a phase\nwarning: a.glb: uses unsupported "
                     "extensions: KHR_materials_volume (missing: absorption inside clear materials)\n"
                   : ""));
    }
}

TEST_CASE("what cannot be exported is said in a line, and no file is written") {
    const Shell shell;
    write_text(shell.directory / "scene.json", SceneText().text());
    SceneText unbounded;
    unbounded.tree = R"({"set": {"phase": "glass", "of": {"plane": {}}}})";
    write_text(shell.directory / "unbounded.json", unbounded.text());
    write_text(shell.directory / "no_tree.json", R"({"version": 1, "phases": {"glass": {"clear": {}}}})");
    const auto refused = refused_by(shell);
    refused({"scene.json", "-o", "shader.gls"}, "cannot write \"shader.gls\": unknown format \".gls\"");
    refused({"scene.json", "-o", "shader"}, "its name has no extension");
    refused({"scene.json"}, "--output is required");
    refused({"scene.json", "-o", "nowhere/shader.glsl"}, "nowhere", 1);
    refused({"scene.json", "-o", "shader.glsl", "--grid", "1000"}, "--grid");
    refused({"missing.json", "-o", "shader.glsl"}, "missing.json");
    refused({"unbounded.json", "-o", "shader.glsl"}, "this \"plane\" makes the object unbounded");
    refused({"no_tree.json", "-o", "shader.glsl"}, "\"tree\"");
    CHECK(bytes_of(shell.directory / "shader.glsl").empty());
}

TEST_CASE("what is exported depends on the object and its materials alone, and nothing else has to be there") {
    const Shell shell;
    const auto write = [&](const std::string& rest) {
        write_text(shell.directory / "scene.json", R"({"version": 1, "phases": {
            "glass": {"clear": {"ior": 1.5, "absorption": [1, 2, 4]}},
            "wood": {"diffuse": {"color": [0.8, 0.4, 0.1]}}},
            "tree": {"over": [{"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}},
                {"set": {"phase": "wood", "of": {"translate": {"by": [3, 0, 0],
                    "of": {"box": {"size": [1, 1, 1]}}}}}}]})" +
                                                       rest + "}");
    };
    const auto exported = [&](const std::string& extension) {
        std::vector<std::string> words{"export", "scene.json", "-o", "a." + extension};
        if (extension != "html") words.insert(words.end(), {"--spacing", "0.2"});
        const Outcome o = shell.run(words);
        CAPTURE(extension);
        CHECK(o.err == "");
        CHECK(o.code == 0);
        return bytes_of(shell.directory / ("a." + extension)) +
               (extension == "obj" ? bytes_of(shell.directory / "a.mtl") : "");
    };
    const char* const surroundings[]{
        R"(, "camera": {"position": [0, -9, 0], "look_at": [0, 0, 0]}, "lights": [{"constant": {}}])",
        R"(, "camera": {"position": [0, -9, 0], "look_at": [0, 0, 0]})",  // no light
        R"(, "camera": {"position": [3, 0, 0], "look_at": [0, 0, 0]})",   // within the wood
        R"(, "lights": [{"image": {"file": "nowhere.exr"}}], "render": {"view": "Nowhere"},
             "meshes": [{"obj": {"file": "nowhere.obj", "material": {"diffuse": {"color": [1, 1, 1]}}}}])"};
    for (const std::string extension : {"3mf", "obj", "glb", "ply", "stl"}) {
        write("");
        const std::string alone = exported(extension);
        if (extension == "obj") CHECK(alone.find("Kd 0.8 0.4 0.1\n") != std::string::npos);
        if (extension == "glb") CHECK(alone.find("\"baseColorFactor\":[0.80000") != std::string::npos);
        for (const char* const rest : surroundings) {
            write(rest);
            CHECK(exported(extension) == alone);
        }
    }
    // A page shows the object as the camera does, and needs nothing else of the scene either.
    for (const char* const rest : surroundings) {
        write(rest);
        const Outcome o = shell.run({"export", "scene.json", "-o", "a.html"});
        CHECK(o.err == "");
        CHECK(o.code == 0);
        CHECK(bytes_of(shell.directory / "a.html").find("rgb(231,170,89)") != std::string::npos);
    }
    // Without a camera, a phase need not have a material.
    write_text(shell.directory / "scene.json", R"({"version": 1, "phases": {"bare": null},
        "tree": {"set": {"phase": "bare", "of": {"sphere": {"radius": 1}}}}})");
    for (const char* const extension : {"3mf", "obj", "glb", "ply", "stl", "html"}) exported(extension);
    // Without colours, the images of materials are not opened.
    write_text(shell.directory / "scene.json", R"({"version": 1, "phases": {"wood": {"diffuse": {"color": {"image":
        {"file": "nowhere.png"}}}}}, "tree": {"set": {"phase": "wood", "of": {"sphere": {"radius": 1}}}}})");
    exported("stl");
    const Outcome o = shell.run({"export", "scene.json", "-o", "a.3mf"});
    CHECK(o.code == 2);
    CHECK(o.err.find("nowhere.png") != std::string::npos);
}

}  // namespace test_export
