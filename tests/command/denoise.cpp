// --denoise on the command line.
#include "cut_scene.hpp"

namespace test_denoise {

using namespace phasetree::tests;

namespace {

const std::vector<std::string> render{"render", "scene.json", "--quiet"};

}  // namespace

TEST_CASE("--denoise changes the picture alone, and a .exr keeps what it was") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(32));
    REQUIRE(shell.run(joined(render, {"-o", "plain.exr", "-o", "plain.png", "--planes", "depth"})).code == 0);
    REQUIRE(shell
                .run(joined(render, {"--denoise=regression", "-o", "clean.exr", "-o", "clean.png", "-o", "clean.part",
                                     "--planes", "depth", "-o", "{plane}.exr"}))
                .code == 0);
    CHECK(bytes_of(shell.directory / "plain.png") != bytes_of(shell.directory / "clean.png"));
    for (const char* plane : {"beauty.exr", "noisy.exr", "depth.exr"})
        CHECK(std::filesystem::exists(shell.directory / plane));
    for (const char* plane : {"half.exr", "albedo.exr", "samples.exr"})
        CHECK_FALSE(std::filesystem::exists(shell.directory / plane));
    // The .part holds what was sampled: merged without --denoise it gives the picture as it was.
    REQUIRE(shell.run({"merge", "clean.part", "-o", "merged.png", "--quiet"}).code == 0);
    CHECK(bytes_of(shell.directory / "merged.png") == bytes_of(shell.directory / "plain.png"));
    REQUIRE(shell.run({"merge", "clean.part", "--denoise=regression", "-o", "merged.png", "--quiet"}).code == 0);
    CHECK(bytes_of(shell.directory / "merged.png") == bytes_of(shell.directory / "clean.png"));
}

TEST_CASE("--denoise gives the same bytes with any threads, with --noise, and after a kill") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(100));
    const std::vector<std::string> how{"--denoise=regression", "--noise", "0.1"};
    REQUIRE(shell.run(joined(joined(render, how), {"-o", "whole.exr", "--threads", "1"})).code == 0);
    REQUIRE(shell.run(joined(joined(render, how), {"-o", "again.exr", "--threads", "3"})).code == 0);
    CHECK(bytes_of(shell.directory / "whole.exr") == bytes_of(shell.directory / "again.exr"));
    const std::vector<std::string> resumed = joined(
        joined(render, how),
        {"-o", "a.exr", "--checkpoint", "a.part", "--resume", "a.part", "--or-start", "--checkpoint-interval", "0.05"});
    const auto kill = [&](pid_t child) {
        if (std::filesystem::exists(shell.directory / "a.part")) ::kill(child, SIGKILL);
    };
    (void)shell.run(resumed, "", kill);
    REQUIRE(shell.run(resumed).code == 0);
    CHECK(bytes_of(shell.directory / "whole.exr") == bytes_of(shell.directory / "a.exr"));
}

TEST_CASE("--denoise refuses what it cannot do, and says what it has left undone") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(32));
    const auto refused = [&](const std::vector<std::string>& words, const std::string& why) {
        const Outcome o = shell.run(words);
        CAPTURE(o.err);
        CHECK(o.code == 2);
        CHECK(o.err.find(why) != std::string::npos);
    };
    refused(joined(render, {"--denoise=regression", "--spp", "7", "-o", "a.png"}), "8 samples");
    refused(joined(render, {"--denoise=magic", "-o", "a.png"}), "must be \"regression\" or \"oidn\", but is \"magic\"");
    REQUIRE(shell.run(joined(render, {"-o", "plain.part"})).code == 0);
    refused({"merge", "plain.part", "--denoise=regression", "-o", "a.png"}, "rendered with --denoise");
    refused(joined(render, {"--denoise=regression", "--resume", "plain.part", "-o", "a.png"}), "planes");
    REQUIRE(shell.run(joined(render, {"--denoise=regression", "-o", "clean.part"})).code == 0);
    refused({"merge", "clean.part", "--denoise=regression", "-o", "a.part"}, "all outputs are .part files");
    CHECK_FALSE(std::filesystem::exists(shell.directory / "a.png"));
    // A user who stops a render need not wait for denoising.
    const Outcome stopped =
        shell.run(joined(render, {"--denoise=regression", "--spp", "1000000", "-o", "b.png"}), "", [](pid_t child) {
            if (catches(child, SIGUSR1)) ::kill(child, SIGTERM);
        });
    CHECK((stopped.err.find("is not denoised") != std::string::npos ||
           !std::filesystem::exists(shell.directory / "b.png")));
}

}  // namespace test_denoise
