// One file per plane, written by a render, a merge or a farm.
#include <map>

#include "cut_scene.hpp"

namespace test_plane_files {

using namespace phasetree::tests;
namespace fs = std::filesystem;

namespace {

// Files that begin with `name` and a point, by what follows.
std::map<std::string, std::string> files_of(const Shell& shell, const std::string& name) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(shell.directory.path()))
        if (const std::string file = entry.path().filename().string(); file.starts_with(name + "."))
            files[file.substr(name.size() + 1)] = bytes_of(entry.path());
    return files;
}

}  // namespace

TEST_CASE("a render and a merge of its shares write the same file for each plane") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(4));
    const std::vector<std::string> render{"render", "scene.json", "--planes", "all", "--quiet"};
    const Outcome whole = shell.run(joined(render, {"-o", "whole.{plane}.exr"}));
    REQUIRE_MESSAGE(whole.code == 0, whole.err);
    REQUIRE(shell.run(joined(render, {"-o", "a.part", "--sample-range", "0:3"})).code == 0);
    REQUIRE(shell.run(joined(render, {"-o", "b.part", "--sample-range", "3:4"})).code == 0);
    const Outcome merged = shell.run({"merge", "a.part", "b.part", "-o", "merged.{plane}.exr"});
    REQUIRE_MESSAGE(merged.code == 0, merged.err);
    CHECK(merged.err.find("merged.{plane}.exr (28x21, 4 samples per pixel, 2 parts)") != std::string::npos);
    const auto files = files_of(shell, "whole");
    const bool same = files == files_of(shell, "merged");
    CHECK(same);
    for (const char* plane : {"beauty", "depth", "normal_behind", "length_water", "light_lamp", "light_sky", "direct",
                              "variance", "noise", "samples", "CryptoPhase", "CryptoObject", "CryptoMaterial"})
        CHECK_MESSAGE(files.contains(std::string(plane) + ".exr"), plane);
}

TEST_CASE("without further planes there is one file") {
    const Shell shell;
    write_text(shell.directory / "scene.json", SceneText().text());
    REQUIRE(shell.run({"render", "scene.json", "--quiet", "-o", "{plane}.exr", "-o", "a.exr"}).code == 0);
    CHECK(shell.directory.size() == 3);
    const bool same = bytes_of(shell.directory / "beauty.exr") == bytes_of(shell.directory / "a.exr");
    CHECK(same);
}

TEST_CASE("a farm passes the name on as it is") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(4));
    const Outcome o = shell.run({"farm", "list", "scene.json", "--shares", "2", "-o", "f.{plane}.exr", "--program",
                                 PHASETREE_COMMAND, "--", "--planes", "depth,crypto_phase", "--quiet"});
    REQUIRE_MESSAGE(o.code == 0, o.err);
    write_text(shell.directory / "farm.sh", "set -e\n" + o.out);
    REQUIRE(std::system(("cd '" + shell.directory.path().string() + "' && bash farm.sh 2>/dev/null").c_str()) == 0);
    CHECK(files_of(shell, "f").size() == 3);
}

TEST_CASE("the file of every plane is checked before any work") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(9));
    const std::vector<std::string> planes{"--planes", "depth,crypto_phase", "--quiet"};
    REQUIRE(shell.run(joined({"render", "scene.json", "-o", "whole.part"}, planes)).code == 0);
    const auto check_rejected = [&](const std::vector<std::string>& words, const std::string& file) {
        CAPTURE(file);
        fs::create_directory(shell.directory / file);
        const auto files = shell.directory.size();
        const Outcome o = shell.run(words);
        CHECK(o.code == 1);
        CHECK(o.out == "");
        CHECK(o.err == "phasetree: cannot write \"" + file + "\": it is a directory\n");
        CHECK(shell.directory.size() == files);
        fs::remove(shell.directory / file);
    };
    const std::vector<std::string> render = joined({"render", "scene.json", "-o", "a.{plane}.exr"}, planes);
    check_rejected(render, "a.beauty.exr");
    check_rejected(render, "a.depth.exr");
    check_rejected(render, "a.CryptoPhase.exr");
    check_rejected(joined(render, {"--denoise=regression"}), "a.noisy.exr");
    check_rejected({"merge", "whole.part", "-o", "a.{plane}.exr"}, "a.depth.exr");
    check_rejected(joined({"farm", "list", "scene.json", "--shares", "2", "-o", "a.{plane}.exr", "--"}, planes),
                   "a.CryptoPhase.exr");
}

TEST_CASE("a name that asks for what cannot be is rejected before any work") {
    const Shell shell;
    write_text(shell.directory / "scene.json", SceneText().text());
    for (const char* name : {"a.{plane}.png", "a.{plane}.part", "{plane}/a.exr"}) {
        const Outcome o = shell.run({"render", "scene.json", "-o", name});
        CAPTURE(o.err);
        CHECK(o.code == 2);
        CHECK(o.err.find("{plane}") != std::string::npos);
        CHECK(o.err.find('\n') == o.err.size() - 1);
    }
    CHECK(shell.directory.size() == 1);
}

}  // namespace test_plane_files
