// Films: frames by their numbers, and scenes that are read at a time.
#include <doctest/doctest.h>

#include <filesystem>

#include "command.hpp"

namespace test_frames {

using namespace phasetree::tests;

namespace {

// A ball that grows from 0.5 to 1 within a second.
const std::string growing = R"({"version": 1, "phases": {"ball": {"diffuse": {"color": [0.6, 0.5, 0.4]}}},
 "tree": {"set": {"phase": "ball", "of": {"sphere": {"radius": {"keys": [[0, 0.5], [1, 1]]}}}}},
 "camera": {"position": [0, -4, 0], "look_at": [0, 0, 0]},
 "lights": [{"constant": {"radiance": {"keys": [[0, [1, 1, 1]], [1, [0.2, 0.2, 0.2]]]}}}],
 "render": {"width": 24, "height": 16, "samples": 4, "frames_per_second": 8}})";

struct InShell : Shell {
    InShell() { write_text(directory / "scene.json", growing); }
    std::string bytes(const std::string& name) const { return bytes_of(directory / name); }
    bool has(const std::string& name) const { return std::filesystem::exists(directory / name); }
};

}  // namespace

TEST_CASE("frames are the same rendered together, one by one, and by their time") {
    const InShell shell;
    const Outcome all = shell.run({"render", "scene.json", "--frames", "2:5", "-o", "a.####.exr", "--threads", "1"});
    REQUIRE_MESSAGE(all.code == 0, all.err);
    CHECK(all.err.find("frame 3 (2 of 3)") != std::string::npos);
    CHECK_FALSE(shell.has("a.0005.exr"));
    for (const int frame : {2, 3, 4}) {
        const std::string n = std::to_string(frame);
        REQUIRE(shell.run({"render", "scene.json", "--frames", n + ":" + std::to_string(frame + 1), "-o", "b.##.exr"})
                    .code == 0);
        REQUIRE(shell.run({"render", "scene.json", "--at", std::to_string(frame / 8.0), "-o", "c.exr"}).code == 0);
        const std::string a = shell.bytes("a.000" + n + ".exr");
        REQUIRE_FALSE(a.empty());
        CHECK(a == shell.bytes("b.0" + n + ".exr"));
        CHECK(a == shell.bytes("c.exr"));
    }
    CHECK(shell.bytes("a.0002.exr") != shell.bytes("a.0003.exr"));
    // Shares of a frame are joined to the frame, and not with those of another.
    for (const char* const share : {"0:2", "2:4"})
        REQUIRE(shell
                    .run({"render", "scene.json", "--frames", "3:5", "--sample-range", share, "-o",
                          "s" + std::string(share).substr(0, 1) + ".#.part"})
                    .code == 0);
    REQUIRE(shell.run({"merge", "s0.3.part", "s2.3.part", "-o", "m.exr"}).code == 0);
    CHECK(shell.bytes("m.exr") == shell.bytes("a.0003.exr"));
    CHECK(shell.run({"merge", "s0.3.part", "s2.4.part", "-o", "m.exr"}).code == 2);
}

TEST_CASE("--skip-existing leaves out frames of which the file of each plane is there") {
    const InShell shell;
    const auto run = [&] {
        return shell.run({"render", "scene.json", "--frames", "0:2", "-o", "a.#.{plane}.exr", "--planes", "depth",
                          "--skip-existing", "--spp", "1"});
    };
    CHECK(run().code == 0);
    // A run that was ended before the picture of frame 1 was written.
    std::filesystem::remove(shell.directory / "a.1.beauty.exr");
    const Outcome again = run();
    CHECK(again.code == 0);
    CHECK(again.err.find("skipped 1 of 2 frames, whose files exist") != std::string::npos);
    CHECK(shell.has("a.1.beauty.exr"));
}

TEST_CASE("--skip-existing leaves out frames that are there") {
    const InShell shell;
    write_text(shell.directory / "a.1.png", "kept");
    const Outcome o =
        shell.run({"render", "scene.json", "--frames", "0:3", "-o", "a.#.png", "--skip-existing", "--spp", "1"});
    REQUIRE_MESSAGE(o.code == 0, o.err);
    CHECK(shell.bytes("a.1.png") == "kept");
    CHECK(shell.has("a.0.png"));
    CHECK(shell.has("a.2.png"));
    CHECK(o.err.find("skipped 1 of 3 frames, whose files exist") != std::string::npos);
    REQUIRE(shell.run({"render", "scene.json", "--frames", "1:2", "-o", "a.#.png", "--spp", "1"}).code == 0);
    CHECK(shell.bytes("a.1.png") != "kept");
}

TEST_CASE("what is wrong with frames is said, and in which frame") {
    const InShell shell;
    const auto wrong = [&](const std::vector<std::string>& options, const std::string& message) {
        std::vector<std::string> words{"render", "scene.json"};
        words.insert(words.end(), options.begin(), options.end());
        const Outcome o = shell.run(words);
        CAPTURE(message);
        CAPTURE(o.err);
        CHECK(o.code == 2);
        CHECK(o.err.find(message) != std::string::npos);
    };
    wrong({"--frames", "3", "-o", "a.#.png"}, "--frames must be FIRST:LAST, where LAST is excluded, but is \"3\"");
    wrong({"--frames", "3:3", "-o", "a.#.png"}, "--frames 3:3:");
    wrong({"--frames", "-2:3", "-o", "a.#.png"}, "--frames -2:3:");
    wrong({"--frames", "0:2"}, "--frames needs -o with ####");
    wrong({"--frames", "0:2", "-o", "a.png"}, "--output a.png: each frame needs its own file");
    wrong({"--frames", "0:2", "-o", "a.#.png", "--checkpoint", "c.part"}, "--checkpoint c.part: each frame needs");
    wrong({"--frames", "0:2", "-o", "a.#.png", "--at", "1"}, "--frames and --at cannot be combined");
    wrong({"--skip-existing"}, "--frames");
    CHECK_FALSE(shell.has("a.0.png"));
    // The ball grows around the camera.
    std::string text = growing;
    text.replace(text.find("[1, 1]"), 6, "[1, 9]");
    write_text(shell.directory / "scene.json", text);
    wrong({"--frames", "2:6", "-o", "b.#.png", "--spp", "1"}, "frame 4: scene.json:3:");
    CHECK(shell.has("b.3.png"));
    CHECK_FALSE(shell.has("b.4.png"));
    text.replace(text.find("\"frames_per_second\": 8"), 22, "\"frames_per_second\": 0");
    write_text(shell.directory / "scene.json", text);
    wrong({"--frames", "2:6", "-o", "b.#.png"}, "\"frames_per_second\" must be at least 0.001");
}

TEST_CASE("every subcommand reads the scene at a time") {
    const InShell shell;
    const auto out = [&](std::vector<std::string> words, const std::string& at, const std::string& input = "") {
        words.insert(words.begin() + 1, {"scene.json", "--at", at});
        const Outcome o = shell.run(words, input);
        CHECK_MESSAGE(o.code == 0, o.err);
        return o.out;
    };
    CHECK(out({"eval"}, "0.5", "0.7 0 0\n").find(",ball,") != std::string::npos);
    CHECK(out({"eval"}, "0.3", "0.7 0 0\n").find(",vacuum,") != std::string::npos);
    CHECK(out({"trace"}, "0.5", "-2 0 0 1 0 0\n").find("0,1.2") != std::string::npos);
    CHECK(out({"info"}, "1") != out({"info"}, "0"));
    CHECK(out({"check"}, "1").empty());
    CHECK(out({"export", "-o", "a.glsl"}, "1").empty());
    CHECK(out({"export", "-o", "b.glsl"}, "0").empty());
    CHECK(shell.bytes("a.glsl") != shell.bytes("b.glsl"));
    CHECK(shell.run({"eval", "scene.json", "--at", "nan"}, "0 0 0\n").code == 2);
}

}  // namespace test_frames
