// Scenes of several objects on the command line, and a million copies.
#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>

#include "command.hpp"
#include "support/long_tests.hpp"

namespace test_objects {

using namespace phasetree::tests;

namespace {

constexpr const char* head =
    R"({"version": 1, "phases": {"glass": {"clear": {"ior": 1.5}}, "water": {"clear": {"ior": 1.3}}},
    "lights": [{"constant": {}}], "camera": {"position": [0, -9, 0], "look_at": [0, 0, 0]},
    "render": {"width": 16, "height": 12, "samples": 2},)";

// A cube of glass, and cubes of water that begin where it ends.
std::string scene_of(const std::string& places = "[[2, 0, 0], [-2, 0, 0]]") {
    return std::string(head) + R"("objects": [
        {"name": "cube", "tree": {"set": {"phase": "glass", "of": {"box": {"size": [2, 2, 2]}}}}},
        {"name": "wet", "tree": {"set": {"phase": "water", "of": {"box": {"size": [2, 2, 2]}}}}}],
        "instances": [{"of": "wet", "transforms": )" +
           places + "}]}";
}

}  // namespace

TEST_CASE("eval, trace and info tell of objects and copies") {
    const Shell shell;
    write_text(shell.directory / "scene.json", scene_of());
    const Outcome points = shell.run({"eval", "scene.json"}, "0.5 0 0\n-2.5 0 0\n0 0 5\n");
    CHECK(points.code == 0);
    CHECK(points.out ==
          "x,y,z,phase,object,copy,phi.vacuum,phi.glass,phi.water\n"
          "0.5,0,0,glass,cube,0,0.5,-0.5,0.5\n"
          "-2.5,0,0,water,wet,2,0.5,1.5,-0.5\n"
          "0,0,5,vacuum,,,-4,4,4.1231055\n");
    const Outcome one = shell.run({"eval", "scene.json", "--object", "wet"}, "0.5 0 0\n");
    CHECK(one.out == "x,y,z,phase,phi.vacuum,phi.glass,phi.water\n0.5,0,0,water,0.5,,-0.5\n");
    const Outcome none = shell.run({"eval", "scene.json", "--object", "wett"}, "");
    CHECK(none.code == 2);
    CHECK(none.err.find("unknown object \"wett\" (choose from cube, wet)") != std::string::npos);

    const Outcome rays = shell.run({"trace", "scene.json"}, "-5 0 0 1 0 0\n");
    std::string seen;
    std::istringstream lines(rays.out);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t from = line.find(',', line.find(',') + 1);
        seen += line.substr(from) + "\n";
    }
    CHECK(seen ==
          ",from,to,nx,ny,nz,to_object,to_copy\n"
          ",,vacuum,,,,,\n"
          ",vacuum,water,1,0,0,wet,2\n"
          ",water,glass,1,0,0,cube,0\n"
          ",glass,water,1,0,0,wet,1\n"
          ",water,vacuum,1,0,0,,\n");

    const auto json = nlohmann::json::parse(shell.run({"info", "--json", "scene.json"}).out);
    CHECK(json["copies"] == 3);
    CHECK(json["objects"][1]["name"] == "wet");
    CHECK(json["objects"][1]["copies"] == 2);
    CHECK(shell.run({"info", "--cells", "scene.json"}).code == 2);
}

TEST_CASE("check and render name objects that overlap, and a point of both") {
    const Shell shell;
    write_text(shell.directory / "good.json", scene_of());
    const Outcome good = shell.run({"check", "good.json"});
    CHECK(good.code == 0);
    CHECK(good.err == "");
    write_text(shell.directory / "bad.json", scene_of("[[1.5, 0, 0], [-2, 0, 0]]"));
    for (const char* const command : {"check", "render"}) {
        const Outcome bad = shell.run({command, "bad.json"});
        CHECK(bad.code == 0);
        CHECK(bad.err.find("\"cube\" (copy 0) and \"wet\" (copy 1) overlap, for example at [0.6249") !=
              std::string::npos);
        CHECK(bad.err.find("; \"cube\" (copy 0) takes precedence") != std::string::npos);
        CHECK(bad.err.find("bad.json:3:") != std::string::npos);
    }
}

TEST_CASE(
    "check and render name groups that no instance names, where they stand in the file, and what is lost by that") {
    const Shell shell;
    const auto scene = [](const std::string& instances) {
        return std::string(head) + R"("objects": [
            {"name": "cup", "tree": {"set": {"phase": "glass", "of": {"sphere": {"radius": 0.3}}}}},
            {"name": "drop", "tree": {"set": {"phase": "water", "of": {"sphere": {"radius": 0.2}}}}},
            {"name": "table", "tree": {"set": {"phase": "water", "of": {"box": {"size": [9, 9, 0.1]}}}},
             "transform": {"translate": {"by": [0, 0, -3]}}}],
        "groups": {"pair": [{"of": "cup", "transforms": [[-1, 0, 0], [1, 0, 0]]}],
            "set": [{"of": "pair"}, {"of": "drop"}]})" +
               instances + "}";
    };
    write_text(shell.directory / "lost.json", scene(""));
    write_text(shell.directory / "part.json", scene(R"(, "instances": [{"of": "cup"}])"));
    write_text(shell.directory / "there.json", scene(R"(, "instances": [{"of": "set"}])"));
    for (const char* const command : {"check", "render"}) {
        const Outcome lost = shell.run({command, "lost.json"});
        CHECK(lost.code == 0);
        CHECK(lost.err.find(
                  "lost.json:9:13: warning: the group \"set\" is not in the scene, because no instance refers to it; "
                  "so \"cup\", \"drop\" are missing from the scene\n") != std::string::npos);
        // "pair" stands as soon as "set" does.
        CHECK(lost.err.find("\"pair\" stands") == std::string::npos);
        CHECK(shell.run({command, "part.json"}).err.find("; so \"drop\" is missing from the scene\n") !=
              std::string::npos);
        CHECK(shell.run({command, "there.json"}).err.find("is not in the scene") == std::string::npos);
    }
    CHECK(shell.run({"render", "--quiet", "lost.json"}).err == "");
    std::string groups = R"(, "instances": [{"of": "set"}], "groups": {"set": [{"of": "cup"}])";
    for (int i = 0; i < 100; ++i) groups += fmt::format(R"(, "g{}": [{{"of": "drop"}}])", i);
    std::string many = scene("");
    many = many.substr(0, many.find(",\n        \"groups\"")) + groups + "}}";
    write_text(shell.directory / "many.json", many);
    const std::string said = shell.run({"check", "many.json"}).err;
    CHECK(said.find("the group \"g0\" is not in the scene") != std::string::npos);
    CHECK(said.find("many.json: warning: 92 more groups are not in the scene\n") != std::string::npos);
}

TEST_CASE("what is for one tree says so, and the picture is the same for any number of threads") {
    const Shell shell;
    write_text(shell.directory / "scene.json", scene_of());
    CHECK(shell.run({"render", "scene.json", "--cells", "x"}).err.find("--cells needs a scene with a single") !=
          std::string::npos);
    CHECK(shell.run({"export", "scene.json", "-o", "a.glsl"}).code == 0);
    CHECK(shell.run({"render", "scene.json", "--threads", "1", "--planes", "all", "-o", "a.exr"}).code == 0);
    CHECK(shell.run({"render", "scene.json", "--threads", "3", "--planes", "all", "-o", "b.exr"}).code == 0);
    CHECK(bytes_of(shell.directory / "a.exr") == bytes_of(shell.directory / "b.exr"));
}

TEST_CASE("a million copies take less than 1 GB and are ready in seconds") {
    const int side = phasetree::tests::long_tests() ? 100 : 20;
    Shell shell;
    shell.executes_program = true;
    std::string places = "PTPLACES";
    const auto put = [&](const auto& number) { places.append(reinterpret_cast<const char*>(&number), sizeof number); };
    put(static_cast<std::uint64_t>(side * side * side));
    for (int i = 0; i < side * side * side; ++i)
        for (const float f : {1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 3.f * static_cast<float>(i % side),
                              3.f * static_cast<float>(i / side % side), 3.f * static_cast<float>(i / side / side)})
            put(f);
    write_text(shell.directory / "many.places", places);
    write_text(shell.directory / "scene.json", std::string(head) + R"("objects": [{"name": "bead",
        "tree": {"under": [{"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}},
                           {"set": {"phase": "water", "of": {"sphere": {"radius": 0.5}}}}]}}],
        "instances": [{"of": "bead", "file": "many.places"}]})");
    const Outcome o = shell.run({"render", "scene.json", "-o", "a.exr"});
    CHECK(o.code == 0);
    CHECK(o.peak_megabytes < 1000);
    CHECK(o.processor_seconds < 30);
    CHECK(shell.run({"eval", "scene.json"}, "").err.find("choose one object with --object") != std::string::npos);
}

}  // namespace test_objects
