// No output of a command overwrites one of its inputs or another output, however the two names are spelled.
#include <algorithm>
#include <filesystem>

#include "command.hpp"

namespace test_overwritten_files {

using namespace phasetree::tests;

namespace {

struct Case {
    std::vector<std::string> words;
    std::string message;  // the whole error
};

// Runs the command lines, which must be rejected before any work, and leave every file unchanged.
void check_refused(const Shell& shell, const std::vector<Case>& cases) {
    const auto content = [&] {
        std::vector<std::pair<std::string, std::string>> files;
        for (const auto& file : std::filesystem::directory_iterator(shell.directory.path()))
            if (file.is_regular_file()) files.emplace_back(file.path().filename(), bytes_of(file.path()));
        std::ranges::sort(files);
        return files;
    };
    const auto before = content();
    for (const Case& c : cases) {
        CAPTURE(c.words);
        const Outcome o = shell.run(c.words);
        CHECK(o.code == 2);
        CHECK(o.err.find(c.message) != std::string::npos);
        CHECK_MESSAGE(o.err.find('\n') == o.err.size() - 1, o.err);
        const bool is_unchanged = content() == before;
        CHECK(is_unchanged);
    }
}

}  // namespace

TEST_CASE("an output that is an input or another output is refused before any work") {
    const Shell shell;
    const std::filesystem::path folder = shell.directory.path();
    write_text(shell.directory / "a.json", SceneText().text());
    std::filesystem::create_symlink("a.json", folder / "link.json");
    std::filesystem::create_hard_link(folder / "a.json", folder / "hard.json");
    std::filesystem::create_symlink("missing.exr", folder / "link.exr");
    std::filesystem::create_directory(folder / "sub");
    REQUIRE(shell.run({"render", "a.json", "--quiet", "--size", "24x12", "-o", "there.part", "-o", "there.exr"}).code ==
            0);
    SceneText with_image;
    with_image.lights = R"([{"image": {"file": "sky.exr"}}])";
    write_text(shell.directory / "sky.json", with_image.text());
    std::filesystem::copy_file(folder / "there.exr", folder / "sky.exr");

    const auto render = [](std::vector<std::string> words) {
        words.insert(words.begin(), {"render", "a.json", "--quiet"});
        return words;
    };
    const std::string same = " are the same file; choose another name for one of them\n";
    check_refused(
        shell,
        {{render({"--checkpoint", "a.json"}),
          "--checkpoint a.json would overwrite the scene a.json; choose another file name\n"},
         {render({"--stats", "sub/../a.json"}), "--stats sub/../a.json would overwrite the scene a.json"},
         {render({"--stats", "link.json"}), "--stats link.json would overwrite the scene a.json"},
         {render({"--stats", "hard.json"}), "--stats hard.json would overwrite the scene a.json"},
         {render({"--stats", folder / "a.json"}), "a.json would overwrite the scene a.json"},
         {render({"-o", "b.exr", "--stats", "b.exr"}), "--output b.exr and --stats b.exr" + same},
         {render({"-o", "missing.exr", "--stats", "link.exr"}), "--output missing.exr and --stats link.exr" + same},
         {render({"-o", "./b.exr", "-o", "b.exr"}), "--output ./b.exr and --output b.exr" + same},
         {render({"-o", "b.{plane}.exr", "--stats", "b.beauty.exr"}),
          "--output b.{plane}.exr and --stats b.beauty.exr" + same},
         {render({"-o", "b.part", "--stats", "b.part"}), "--stats b.part and --output b.part" + same},
         {render({"--checkpoint", "b", "--stats", "b"}), "--stats b and --checkpoint b" + same},
         {render({"--cells", "b", "--stats", "b"}), "--stats b and --cells b" + same},
         {render({"--resume", "there.part", "--stats", "there.part"}),
          "--stats there.part would overwrite --resume there.part"},
         {render({"--frames", "3:4", "-o", "b.#.exr", "--stats", "b.3.exr"}), "--output b.3.exr and --stats b.3.exr"},
         // The name of the picture that is not given follows from the scene's.
         {{"render", "sky.json", "--quiet"}, "--output sky.exr would overwrite \"sky.exr\", which the scene uses"},
         {{"farm", "list", "a.json", "--shares", "2", "-o", "hard.exr", "-o", "./hard.exr"}, same},
         {{"farm", "list", "sky.json", "--shares", "2"}, "--output sky.exr would overwrite \"sky.exr\""},
         {{"merge", "there.part", "other.part", "-o", "sub/../there.part"},
          "--output sub/../there.part would overwrite the part there.part"},
         {{"merge", "there.part", "-o", "b.png", "-o", "b.png"}, "--output b.png and --output b.png" + same}});
}

TEST_CASE("an export overwrites neither its scene nor the files that the scene uses") {
    const Shell shell;
    const std::filesystem::path folder = shell.directory.path();
    std::vector<Case> cases;
    for (const char* extension : {"html", "glsl", "ply", "obj", "stl", "3mf", "glb"}) {
        const std::string link = std::string("link.") + extension;
        std::filesystem::create_symlink("a.json", folder / link);
        cases.push_back({{"export", "a.json", "-o", link}, "--output " + link + " would overwrite the scene a.json"});
    }
    write_text(shell.directory / "a.json", SceneText().text());
    std::filesystem::create_symlink("a.json", folder / "b.mtl");
    std::filesystem::create_symlink("a.json", folder / "c-glass.stl");
    std::filesystem::create_symlink("a.json", folder / "d.f32");
    cases.push_back({{"export", "a.json", "-o", "b.obj"}, "--output b.mtl would overwrite the scene a.json"});
    cases.push_back({{"export", "a.json", "-o", "c-{phase}.stl"}, "--output c-glass.stl would overwrite the scene"});
    cases.push_back({{"export", "a.json", "-o", "d.glsl"}, "--output d.f32 would overwrite the scene a.json"});
    check_refused(shell, cases);
}

TEST_CASE("one film file may be the checkpoint, an output and the file to resume") {
    const Shell shell;
    write_text(shell.directory / "a.json", SceneText().text());
    for (int run = 0; run < 2; ++run) {
        const Outcome o = shell.run({"render", "a.json", "--quiet", "-o", "b.part", "--checkpoint", "./b.part",
                                     "--resume", "b.part", "--or-start"});
        CHECK_MESSAGE(o.code == 0, o.err);
    }
    CHECK(shell.run({"merge", "b.part", "-o", "b.exr", "--quiet"}).code == 0);
}

}  // namespace test_overwritten_files
