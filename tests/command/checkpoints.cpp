// A render that is killed in any way at any time resumes from its checkpoint and ends with the same bytes.
#include <optional>
#include <thread>

#include "cut_scene.hpp"

namespace test_checkpoints {

using namespace phasetree::tests;

namespace {

const std::vector<std::string> resumed{"--checkpoint", "a.part", "--resume", "a.part", "--or-start"};

// Whether a run writes its current state when a signal arrives. The handler of SIGTERM alone may still be that of the
// process that it is a fork of.
bool is_ready(pid_t child) {
    return catches(child, SIGUSR1) && catches(child, SIGTERM);
}

}  // namespace

TEST_CASE("kill -9 at any time, again and again: nothing is lost, the bytes are equal, and nothing is left") {
    constexpr int samples = 600;
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(samples));
    const std::vector<std::string> render{"render", "scene.json", "--planes", "all", "--quiet"};
    REQUIRE(shell.run(joined(render, {"-o", "whole.exr"})).code == 0);
    const std::string whole = bytes_of(shell.directory / "whole.exr");
    Uniform random(9);
    const int wanted = long_tests() ? 200 : 8;
    int kills = 0, renders = 0, with_more = 0;
    while (kills < wanted) {
        std::filesystem::remove(shell.directory / "a.part");
        std::filesystem::remove(shell.directory / "a.exr");
        for (Outcome o; o.code != 0;) {
            // Some before or while the scene is read, most during the work.
            const bool is_early = below(random, 5) == 0;
            const auto after = std::chrono::milliseconds(below(random, is_early ? 250 : 600));
            std::optional<std::chrono::steady_clock::time_point> start;
            const auto kill = [&](pid_t child) {
                const auto now = std::chrono::steady_clock::now();
                if (!start && (is_early || is_ready(child))) start = now;
                if (start && now - *start >= after && kills < wanted) ::kill(child, SIGKILL);
            };
            const std::string before = bytes_of(shell.directory / "a.part");
            const std::string threads = std::to_string(1 + below(random, 3));
            const std::vector<std::string> more{"--checkpoint-interval", "0.06", "-o", "a.exr", "--threads", threads};
            o = shell.run(joined(joined(render, resumed), more), "", kill);
            CAPTURE(o.err);
            REQUIRE((o.code == 0 || o.signal == SIGKILL));
            kills += o.signal == SIGKILL;
            with_more += o.signal == SIGKILL && bytes_of(shell.directory / "a.part") != before;
        }
        ++renders;
        const bool same = bytes_of(shell.directory / "a.exr") == whole;
        CHECK(same);
    }
    MESSAGE(kills, " kills in ", renders, " renders, ", with_more, " of them after a checkpoint");
    CHECK(with_more > 0);
    // The scene, the whole, the checkpoint and the image.
    CHECK(shell.directory.size() == 4);
}

TEST_CASE("SIGTERM and SIGHUP say \"resume me\", and Ctrl-C does not; each leaves a checkpoint to go on from") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(500));
    const std::vector<std::string> render{"render", "scene.json", "--quiet", "-o", "a.exr"};
    REQUIRE(shell.run(render).code == 0);
    const std::string whole = bytes_of(shell.directory / "a.exr");
    for (const auto& [signal, code] : {std::pair(SIGTERM, 75), std::pair(SIGHUP, 75), std::pair(SIGINT, 130)}) {
        const int number = signal;  // Clang 14 cannot capture a binding
        CAPTURE(number);
        std::filesystem::remove(shell.directory / "a.part");
        bool is_sent = false;
        std::optional<double> ready;
        const auto send = [&, s = signal](pid_t child) {
            if (is_sent || !is_ready(child)) return;
            // The scene is read and prepared by then; before that there is nothing to go on from.
            if (!ready) ready = processor_seconds(child);
            if (processor_seconds(child) - *ready < 0.3) return;
            is_sent = ::kill(child, s) == 0;
        };
        // On a busy machine the signal may find the render at its end. Then there is another.
        Outcome o;
        for (int attempts = 0; attempts < 5 && o.code != code; ++attempts) {
            is_sent = false;
            ready.reset();
            o = shell.run(joined(render, {"--checkpoint", "a.part"}), "", send);
            if (o.code != 0) break;
        }
        CAPTURE(o.err);
        CHECK(is_sent);
        CHECK(o.code == code);
        CHECK(o.err.find("interrupted") != std::string::npos);
        REQUIRE(std::filesystem::exists(shell.directory / "a.part"));
        // It is unfinished, which merge knows.
        CHECK(shell.run({"merge", "a.part", "-o", "b.exr"}).err.find("it is unfinished") != std::string::npos);
        REQUIRE(shell.run(joined(render, {"--resume", "a.part"})).code == 0);
        const bool same = bytes_of(shell.directory / "a.exr") == whole;
        CHECK(same);
    }
    // Without a checkpoint, nothing can be resumed.
    bool is_sent = false;
    const auto send = [&](pid_t child) {
        if (!is_sent && is_ready(child)) is_sent = ::kill(child, SIGTERM) == 0;
    };
    CHECK(shell.run(render, "", send).code == 1);
}

TEST_CASE(
    "an interrupted frame of a film leaves a checkpoint and no picture, so --skip-existing does not take it for "
    "whole") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(500));
    const std::vector<std::string> render{"render",          "scene.json", "--quiet",   "--frames",     "0:1",
                                          "--skip-existing", "-o",         "a.#.exr",   "--checkpoint", "c.#.part",
                                          "--resume",        "c.#.part",   "--or-start"};
    bool is_sent = false;
    std::optional<double> ready;
    const auto send = [&](pid_t child) {
        if (is_sent || !is_ready(child)) return;
        if (!ready) ready = processor_seconds(child);
        if (processor_seconds(child) - *ready < 0.3) return;
        is_sent = ::kill(child, SIGTERM) == 0;
    };
    Outcome o;
    for (int attempts = 0; attempts < 5 && o.code != 75; ++attempts) {
        for (const char* const name : {"a.0.exr", "c.0.part"}) std::filesystem::remove(shell.directory / name);
        is_sent = false;
        ready.reset();
        o = shell.run(render, "", send);
    }
    CAPTURE(o.err);
    REQUIRE(o.code == 75);
    CHECK(o.err.find("the frame was not written") != std::string::npos);
    CHECK(std::filesystem::exists(shell.directory / "c.0.part"));
    CHECK_FALSE(std::filesystem::exists(shell.directory / "a.0.exr"));
    REQUIRE(shell.run(render).code == 0);
    REQUIRE(shell.run({"render", "scene.json", "--quiet", "--frames", "0:1", "-o", "b.#.exr"}).code == 0);
    const bool same = bytes_of(shell.directory / "a.0.exr") == bytes_of(shell.directory / "b.0.exr");
    CHECK(same);
}

TEST_CASE("SIGUSR1 asks for a checkpoint at any time and ends nothing") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(700));
    const std::vector<std::string> render{"render", "scene.json", "--quiet", "-o", "a.exr"};
    bool is_written_meanwhile = false;
    int asked = 0;
    const auto ask = [&](pid_t child) {
        if (!catches(child, SIGUSR1)) return;  // before that the program is not there yet
        if (asked < 20) asked += ::kill(child, SIGUSR1) == 0;
        is_written_meanwhile = is_written_meanwhile || std::filesystem::exists(shell.directory / "a.part");
    };
    const Outcome o = shell.run(joined(render, {"--checkpoint", "a.part", "--checkpoint-interval", "1h"}), "", ask);
    CHECK_MESSAGE(o.code == 0, o.err);
    CHECK(asked == 20);
    CHECK(is_written_meanwhile);
    // A finished render can be resumed, too: there is nothing to do.
    const std::string image = bytes_of(shell.directory / "a.exr");
    const Outcome finished = shell.run(joined(render, resumed));
    CHECK(finished.code == 0);
    const bool same = bytes_of(shell.directory / "a.exr") == image;
    CHECK(same);
}

TEST_CASE("more samples than a checkpoint was to have are added to it") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(3));
    const std::vector<std::string> render{"render", "scene.json", "--quiet", "--planes", "all", "-o", "a.exr"};
    REQUIRE(shell.run(joined(render, {"--checkpoint", "a.part"})).code == 0);
    REQUIRE(shell.run(joined(render, {"--resume", "a.part", "--spp", "8"})).code == 0);
    const std::string more = bytes_of(shell.directory / "a.exr");
    REQUIRE(shell.run(joined(render, {"--spp", "8"})).code == 0);
    const bool same = more == bytes_of(shell.directory / "a.exr");
    CHECK(same);
    // Fewer cannot be taken out of a sum.
    const Outcome o = shell.run(joined(render, {"--resume", "a.part", "--spp", "2"}));
    CHECK(o.code == 2);
    CHECK(o.err.find("a.part") != std::string::npos);
    CHECK(o.err.find("it has the samples 0:3, but this render has 0:2") != std::string::npos);
}

TEST_CASE("a checkpoint that is of something else is rejected before any work, and stays as it is") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(3));
    const std::vector<std::string> render{"render", "scene.json", "--quiet", "-o", "a.exr"};
    REQUIRE(shell.run(joined(render, {"--checkpoint", "a.part"})).code == 0);
    std::filesystem::remove(shell.directory / "a.exr");
    const std::string kept = bytes_of(shell.directory / "a.part");
    const auto refused = [&](const std::vector<std::string>& more, const std::string& why) {
        const Outcome o = shell.run(joined(joined(render, resumed), more));
        CAPTURE(o.err);
        CHECK(o.code == 2);
        CHECK(o.err.find("a.part") != std::string::npos);
        CHECK(o.err.find(why) != std::string::npos);
        CHECK(shell.directory.size() == 2);
    };
    refused({"--seed", "4"}, "it has seed 0, not 4");
    refused({"--planes", "all"}, "planes");
    refused({"--sample-range", "1:3"}, "it has the samples 0:3, but this render has 1:3");
    std::string scene = cut_scene(3);
    scene.replace(scene.find("-1.2"), 4, "-1.3");
    write_text(shell.directory / "scene.json", scene);
    refused({}, "it belongs to another scene");
    const bool same = bytes_of(shell.directory / "a.part") == kept;
    CHECK(same);
    // Whatever is missing of it.
    write_text(shell.directory / "scene.json", cut_scene(3));
    for (const std::size_t bytes : {std::size_t{1}, std::size_t{40}, kept.size() / 2, kept.size() - 1}) {
        write_text(shell.directory / "a.part", kept.substr(0, bytes));
        refused({}, "it is truncated");
    }
    // Without --or-start there must be one.
    std::filesystem::remove(shell.directory / "a.part");
    CHECK(shell.run(joined(render, {"--resume", "a.part"})).code == 2);
}

}  // namespace test_checkpoints
