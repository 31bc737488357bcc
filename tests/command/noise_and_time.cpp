// Renders that end at a noise limit or a time limit.
#include <nlohmann/json.hpp>
#include <optional>

#include "cut_scene.hpp"

namespace test_noise_and_time {

using namespace phasetree::tests;

namespace {

const std::vector<std::string> render{"render", "scene.json", "--quiet"};

bool is_same(const Shell& shell, const std::string& a, const std::string& b) {
    const std::string bytes = bytes_of(shell.directory / a);
    return !bytes.empty() && bytes == bytes_of(shell.directory / b);
}

}  // namespace

TEST_CASE("--noise gives the same bytes with any threads, after kills, and through a part") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(220));
    const std::vector<std::string> noise{"--noise", "0.06", "--planes", "depth"};
    const Outcome o = shell.run(joined(
        joined(render, noise), {"-o", "whole.exr", "-o", "whole.part", "--threads", "1", "--stats", "stats.json"}));
    REQUIRE_MESSAGE(o.code == 0, o.err);
    // Some stopped, and not all.
    const int samples = nlohmann::json::parse(bytes_of(shell.directory / "stats.json"))["samples"];
    CHECK(samples > 32);
    CHECK(samples < 200);
    REQUIRE(shell.run({"merge", "whole.part", "-o", "merged.exr", "--quiet"}).code == 0);
    CHECK(is_same(shell, "whole.exr", "merged.exr"));

    Uniform random(11);
    int kills = 0, most = 4;
    for (Outcome killed; killed.code != 0;) {
        const auto after = std::chrono::milliseconds(50 + below(random, 200));
        std::optional<std::chrono::steady_clock::time_point> start;
        const auto kill = [&](pid_t child) {
            const auto now = std::chrono::steady_clock::now();
            if (!start && catches(child, SIGUSR1)) start = now;
            if (start && now - *start >= after && kills < most) ::kill(child, SIGKILL);
        };
        killed = shell.run(joined(joined(render, noise), {"-o", "a.exr", "--checkpoint", "a.part", "--resume", "a.part",
                                                          "--or-start", "--checkpoint-interval", "0.05"}),
                           "", kill);
        REQUIRE_MESSAGE((killed.code == 0 || killed.signal == SIGKILL), killed.err);
        kills += killed.signal == SIGKILL;
    }
    CHECK(kills > 0);
    CHECK(is_same(shell, "whole.exr", "a.exr"));
    // There is nothing left to do.
    REQUIRE(shell.run(joined(joined(render, noise), {"-o", "a.exr", "--resume", "a.part"})).code == 0);
    CHECK(is_same(shell, "whole.exr", "a.exr"));
    // With more samples allowed, the noisy blocks continue, as if that had been requested from the start.
    REQUIRE(shell.run(joined(joined(render, noise), {"-o", "a.exr", "--resume", "a.part", "--spp", "300"})).code == 0);
    REQUIRE(shell.run(joined(joined(render, noise), {"-o", "b.exr", "--spp", "300"})).code == 0);
    CHECK(is_same(shell, "a.exr", "b.exr"));
    CHECK_FALSE(is_same(shell, "whole.exr", "b.exr"));
    // Another limit is another picture.
    const Outcome other = shell.run(joined(render, {"--resume", "a.part", "--noise", "0.05", "--planes", "depth"}));
    CHECK(other.code == 2);
    CHECK(other.err.find("noise") != std::string::npos);
}

TEST_CASE("a crop is the same through a part, which holds whole blocks") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(100));
    const std::vector<std::string> crop{"--noise", "0.1", "--crop", "5,3,21,18"};
    REQUIRE(shell.run(joined(joined(render, crop), {"-o", "a.exr", "-o", "a.part"})).code == 0);
    const Outcome o = shell.run({"merge", "a.part", "-o", "b.exr"});
    CHECK(is_same(shell, "a.exr", "b.exr"));
    CHECK(o.err.find("b.exr (16x15, ") != std::string::npos);
    // It continues as if more samples had been requested from the start.
    REQUIRE(shell.run(joined(joined(render, crop), {"-o", "a.exr", "--spp", "150", "--resume", "a.part"})).code == 0);
    REQUIRE(shell.run(joined(joined(render, crop), {"-o", "b.exr", "--spp", "150"})).code == 0);
    CHECK(is_same(shell, "a.exr", "b.exr"));
}

TEST_CASE("the scene may say its limit of noise, and --noise 0 turns it off") {
    const Shell shell;
    std::string text = cut_scene(50);
    write_text(shell.directory / "plain.json", text);
    text.insert(text.find("\"samples\""), "\"noise\": 0.5, ");
    write_text(shell.directory / "scene.json", text);
    const Outcome o = shell.run(joined(render, {"-o", "a.exr", "--stats", "stats.json"}));
    REQUIRE_MESSAGE(o.code == 0, o.err);
    CHECK(nlohmann::json::parse(bytes_of(shell.directory / "stats.json"))["samples"] < 50);
    REQUIRE(shell.run(joined(render, {"-o", "a.exr", "--noise", "0", "--stats", "stats.json"})).code == 0);
    CHECK(nlohmann::json::parse(bytes_of(shell.directory / "stats.json"))["samples"] == 50);
    // Shares have some of a pixel's samples, so they cannot know where it stops.
    const Outcome share = shell.run(joined(render, {"-o", "a.part", "--sample-range", "0:25"}));
    CHECK(share.code == 2);
    CHECK(share.err.find("--sample-range cannot be combined with a noise limit") != std::string::npos);
    CHECK(shell.run(joined(render, {"-o", "a.part", "--sample-range", "0:25", "--noise", "0"})).code == 0);
    const Outcome farm = shell.run({"farm", "list", "scene.json", "--shares", "4"});
    CHECK(farm.code == 2);
    CHECK(farm.err.find("a farm cannot be combined with a noise limit") != std::string::npos);
    CHECK(shell.run({"farm", "list", "scene.json", "--shares", "4", "--", "--noise", "0"}).code == 0);
    CHECK(shell.run({"farm", "list", "plain.json", "--shares", "4", "--", "--time", "9s"}).code == 2);
    for (const char* wrong : {"2", "-1", "nan", "x"}) {
        CAPTURE(wrong);
        CHECK(shell.run(joined(render, {"--noise", wrong})).code == 2);
    }
}

TEST_CASE("--time ends with whole samples, in time, and the bytes are those of as many by --spp") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(2));
    const Outcome o =
        shell.run(joined(render, {"--time", "1.5", "-o", "a.exr", "--checkpoint", "a.part", "--stats", "stats.json"}));
    REQUIRE_MESSAGE(o.code == 0, o.err);
    const int samples = nlohmann::json::parse(bytes_of(shell.directory / "stats.json"))["samples"];
    // Without --spp the scene's number is no limit.
    CHECK(samples > 2);
    REQUIRE(shell.run(joined(render, {"--spp", std::to_string(samples), "-o", "b.exr"})).code == 0);
    CHECK(is_same(shell, "a.exr", "b.exr"));
    REQUIRE(shell.run({"merge", "a.part", "-o", "c.exr", "--quiet"}).code == 0);
    CHECK(is_same(shell, "a.exr", "c.exr"));
    // It goes on, for another time or to a number.
    REQUIRE(shell.run(joined(render, {"--resume", "a.part", "--time", "0.8", "-o", "a.exr", "--stats", "stats.json"}))
                .code == 0);
    const int more = nlohmann::json::parse(bytes_of(shell.directory / "stats.json"))["samples"];
    CHECK(more > samples);
    const std::vector<std::string> spp{"--spp", std::to_string(samples + 3)};
    REQUIRE(shell.run(joined(joined(render, spp), {"--resume", "a.part", "-o", "a.exr"})).code == 0);
    REQUIRE(shell.run(joined(joined(render, spp), {"-o", "b.exr"})).code == 0);
    CHECK(is_same(shell, "a.exr", "b.exr"));
    // The number of samples ends it if that is there first.
    REQUIRE(shell.run(joined(render, {"--time", "1h", "--spp", "3", "-o", "a.exr"})).code == 0);
    REQUIRE(shell.run(joined(render, {"--spp", "3", "-o", "b.exr"})).code == 0);
    CHECK(is_same(shell, "a.exr", "b.exr"));
    const Outcome share = shell.run(joined(render, {"--time", "9s", "--sample-range", "0:1", "-o", "x.part"}));
    CHECK(share.code == 2);
    CHECK(share.err.find("--sample-range cannot be combined with --time") != std::string::npos);
    for (const char* wrong : {"0", "-1s", "nan", "soon", "3 parsecs"}) {
        CAPTURE(wrong);
        CHECK(shell.run(joined(render, {"--time", wrong})).code == 2);
    }
}

}  // namespace test_noise_and_time
