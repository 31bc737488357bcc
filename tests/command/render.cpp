// `phasetree render` from the outside: files, exit codes, progress, interruption.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>

#include "command.hpp"

namespace test_render {

using namespace phasetree::tests;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t to = std::min(text.find('\n', from), text.size());
        lines.push_back(text.substr(from, to - from));
        from = to + 1;
    }
    return lines;
}

// The message when the object has been prepared, before the first sample.
constexpr const char* samples_begin = "Progress: 0%";

// Sends a signal once a run has worked for a while since it has a handler for it, and since its standard error has the
// text `after`. In its processors' time: how long that takes on a machine that is busy otherwise, nobody knows.
struct Interrupt {
    int signal = SIGINT;
    std::string after = "";
    bool is_sent = false;
    double used = 0;  // when it was sent
    std::optional<double> ready = std::nullopt;

    void operator()(pid_t child) {
        if (is_sent || !catches(child, signal)) return;
        used = processor_seconds(child);
        if (!ready && !has_said_it(child)) return;
        if (!ready) ready = used;
        if (used - *ready < 0.7 * sanitizer_slowdown) return;
        is_sent = true;
        ::kill(child, signal);
    }

  private:
    // Before it is the command, the process has this one's standard error, which may be a pipe: whoever reads that
    // waits.
    bool has_said_it(pid_t child) const {
        const std::string err = "/proc/" + std::to_string(child) + "/fd/2";
        std::error_code ended;
        return std::filesystem::is_regular_file(err, ended) && bytes_of(err).find(after) != std::string::npos;
    }
};

}  // namespace

TEST_CASE("an image and its twin: the same bytes, whatever the threads") {
    const Shell shell;
    write_text(shell.directory / "scene.json", SceneText().text());
    const std::vector<std::string> names{"a.exr", "a.png", "a.jpg", "a.tif"};
    std::vector<std::string> first{"render", "scene.json", "--threads", "1", "--quiet"}, second = first;
    second[3] = "7";
    for (const std::string& name : names) {
        first.insert(first.end(), {"-o", name});
        second.insert(second.end(), {"-o", "twin-" + name});
    }
    for (const auto& words : {first, second}) {
        const Outcome o = shell.run(words);
        CHECK(o.code == 0);
        CHECK(o.err == "");
        CHECK(o.out == "");
    }
    for (const std::string& name : names) {
        CAPTURE(name);
        const std::string bytes = bytes_of(shell.directory / name);
        CHECK(bytes.size() > 100);
        const bool same = bytes == bytes_of(shell.directory / ("twin-" + name));
        CHECK(same);
    }
    CHECK(shell.directory.size() == 9);
    CHECK(shell.run({"render", "scene.json", "--quiet", "--seed", "7", "-o", "other.exr"}).code == 0);
    const bool same = bytes_of(shell.directory / "a.exr") == bytes_of(shell.directory / "other.exr");
    CHECK_FALSE(same);
}

TEST_CASE("--planes: the same bytes whatever the threads, and what is no plane is rejected") {
    const Shell shell;
    write_text(shell.directory / "scene.json", SceneText().text());
    for (const char* threads : {"1", "3"})
        CHECK(shell
                  .run({"render", "scene.json", "--quiet", "--planes", "all", "--threads", threads, "-o",
                        std::string(threads) + ".exr"})
                  .code == 0);
    CHECK(bytes_of(shell.directory / "1.exr") == bytes_of(shell.directory / "3.exr"));
    CHECK(shell.run({"render", "scene.json", "--quiet", "-o", "plain.exr"}).code == 0);
    CHECK(bytes_of(shell.directory / "plain.exr").size() < bytes_of(shell.directory / "1.exr").size());
    for (const char* list : {"depht", "depth,", "", "all,depth"}) {
        CAPTURE(list);
        const Outcome outcome = shell.run({"render", "scene.json", "--planes", list, "-o", "bad.exr"});
        CHECK(outcome.code == 2);
        CHECK(outcome.err.find("unknown plane") != std::string::npos);
        CHECK(outcome.err.find("crypto_phase") != std::string::npos);
        CHECK_FALSE(std::filesystem::exists(shell.directory / "bad.exr"));
    }
    const Outcome png = shell.run({"render", "scene.json", "--planes", "depth", "-o", "bad.png"});
    CHECK(png.code == 2);
    CHECK(png.err.find(".exr") != std::string::npos);
}

TEST_CASE("without -o: the scene's name, .exr and .png, here") {
    const Shell shell;
    std::filesystem::create_directory(shell.directory / "scenes");
    write_text(shell.directory / "scenes/ball.json", SceneText().text());
    CHECK(shell.run({"render", "scenes/ball.json", "--quiet"}).code == 0);
    CHECK(std::filesystem::exists(shell.directory / "ball.exr"));
    CHECK(std::filesystem::exists(shell.directory / "ball.png"));
    CHECK(shell.directory.size() == 3);
}

TEST_CASE("progress in plain lines where there is no terminal, rising to 100 %") {
    const Shell shell;
    write_text(shell.directory / "scene.json", SceneText().text());
    const Outcome o = shell.run({"render", "scene.json", "-o", "a.exr"});
    CHECK(o.code == 0);
    CHECK(o.out == "");
    int last = -1, count = 0;
    for (const std::string& line : lines_of(o.err)) {
        std::smatch match;
        if (!std::regex_match(line, match, std::regex("Progress: ([0-9]+)%(, [0-9]+:[0-9]+ elapsed(, ETA .*)?)?")))
            continue;
        const int percent = std::stoi(match[1]);
        CHECK(percent > last);
        last = percent;
        ++count;
    }
    CHECK(last == 100);
    CHECK(count >= 3);
    CHECK(lines_of(o.err).back().find("a.exr") == 0);
    CHECK(o.err.find('\r') == std::string::npos);
    CHECK(o.err.find('\x1b') == std::string::npos);
}

TEST_CASE("--stats is JSON and tells what was done") {
    const Shell shell;
    write_text(shell.directory / "scene.json", SceneText().text());
    const Outcome o = shell.run({"render", "scene.json", "-o", "a.exr", "--quiet", "--stats", "stats.json", "--spp",
                                 "3", "--size", "20x10", "--crop", "5,2,15,8", "--threads", "2"});
    REQUIRE(o.code == 0);
    const nlohmann::json stats = nlohmann::json::parse(bytes_of(shell.directory / "stats.json"));
    CHECK(stats.at("scene") == "scene.json");
    CHECK(stats.at("width") == 10);
    CHECK(stats.at("height") == 6);
    CHECK(stats.at("samples") == 3);
    CHECK(stats.at("threads") == 2);
    CHECK(stats.at("paths") == 180);
    CHECK(stats.at("render_seconds").is_number());
    CHECK(stats.at("instructions").get<int>() > 0);
    CHECK(stats.at("rays").get<int>() >= 180);
    for (const char* number : {"cell_visits_per_ray", "batches_per_ray", "samples_per_ray", "phantom_steps_per_ray"}) {
        CAPTURE(number);
        CHECK(stats.at(number).get<double>() >= 0);
    }
    CHECK(stats.at("instructions_per_cell").at("most").get<int>() >=
          stats.at("instructions_per_cell").at("median").get<int>());
    CHECK(shell.directory.size() == 3);

    std::vector<int> cells;
    for (const char* const quality : {"low", "medium"}) {
        REQUIRE(shell
                    .run({"render", "scene.json", "-o", "a.exr", "--quiet", "--stats", "stats.json", "--spp", "1",
                          "--size", "4x4", "--build-quality", quality})
                    .code == 0);
        cells.push_back(nlohmann::json::parse(bytes_of(shell.directory / "stats.json")).at("cells").get<int>());
    }
    CHECK(cells[0] < cells[1]);
    CHECK(cells[1] == stats.at("cells"));
}

TEST_CASE("--cells keeps the prepared object from one rendering to the next") {
    const Shell shell;
    SceneText scene;
    scene.tree = R"({"set": {"phase": "wood", "of": "ball"}})";
    write_text(shell.directory / "scene.json", scene.text());
    const auto render = [&](std::vector<std::string> more) {
        std::vector<std::string> all{"render", "scene.json", "-o", "a.exr", "--quiet"};
        all.insert(all.end(), more.begin(), more.end());
        return shell.run(all);
    };
    const std::vector<std::string> kept{"--cells", "object.cells"};
    const auto image = [&] { return bytes_of(shell.directory / "a.exr"); };
    const auto file = [&] { return bytes_of(shell.directory / "object.cells"); };
    REQUIRE(render({}).code == 0);
    const auto first_image = image();
    REQUIRE(render(kept).code == 0);
    const auto first_file = file();
    CHECK(image() == first_image);
    const auto written = std::filesystem::last_write_time(shell.directory / "object.cells");
    REQUIRE(render(kept).code == 0);
    CHECK(image() == first_image);
    CHECK(std::filesystem::last_write_time(shell.directory / "object.cells") == written);

    // Of another object, or damaged: built and rewritten, and the image is right.
    scene.shapes = R"({"ball": {"sphere": {"radius": 1.3}}})";
    write_text(shell.directory / "scene.json", scene.text());
    REQUIRE(render({}).code == 0);
    const auto second_image = image();
    CHECK(second_image != first_image);
    REQUIRE(render(kept).code == 0);
    CHECK(image() == second_image);
    const auto second_file = file();
    CHECK(second_file != first_file);
    write_text(shell.directory / "object.cells", std::string(second_file.begin(), second_file.end() - 5));
    REQUIRE(render(kept).code == 0);
    CHECK(image() == second_image);
    CHECK(file() == second_file);
    CHECK(shell.directory.size() == 3);

    // Files of other kinds are left alone.
    write_text(shell.directory / "notes.txt", "not to be lost, however long it takes to say so\n");
    const Outcome o = render({"--cells", "notes.txt"});
    CHECK(o.code == 2);
    CHECK(o.err.find("notes.txt") != std::string::npos);
    CHECK(o.err.find("not a cell file") != std::string::npos);
    CHECK(bytes_of(shell.directory / "notes.txt").size() == 48);
    CHECK(render({"--cells", "no/such/folder"}).code == 1);
    CHECK(render({"--cells", "."}).code == 1);
}

TEST_CASE("Ctrl-C writes what there is and exits with 130") {
    const Shell shell;
    write_text(shell.directory / "scene.json", SceneText().text());
    Interrupt interrupt{SIGINT, samples_begin};
    const Outcome o =
        shell.run({"render", "scene.json", "-o", "a.exr", "-o", "a.png", "--spp", "16000000"}, "", std::ref(interrupt));
    CAPTURE(o.err);
    CHECK(interrupt.is_sent);
    CHECK(o.code == 130);
    CHECK(o.signal == 0);
    CHECK(o.processor_seconds - interrupt.used < 3 * sanitizer_slowdown);
    CHECK(o.err.find("interrupted") != std::string::npos);
    CHECK(std::regex_search(o.err, std::regex("[1-9][0-9]* of 16000000 samples")));
    CHECK(shell.directory.size() == 3);
    // The whole picture: it has the size of one that was not interrupted, but for the compression.
    CHECK(bytes_of(shell.directory / "a.png").find("IEND") != std::string::npos);
    CHECK(bytes_of(shell.directory / "a.exr").size() > 500);
}

TEST_CASE("Ctrl-C while the object is prepared ends it at once and writes nothing") {
    const Shell shell;
    // A ball of grains with noise as fine as dust: more than a million cells.
    SceneText scene;
    scene.tree =
        R"({"set": {"phase": "glass", "of": {"displace": {"amplitude": 0.002, "scale": 0.01, "octaves": 6, "of":
        {"fibonacci_sphere": {"count": 20000, "radius": 1, "of": {"smooth_union": {"radius": 0.01, "of": [
            {"sphere": {"radius": 0.01}}, {"box": {"size": [0.01, 0.01, 0.03]}}]}}}}}}}})";
    write_text(shell.directory / "scene.json", scene.text());
    Interrupt interrupt{SIGTERM};
    const Outcome o = shell.run({"render", "scene.json", "-o", "a.exr", "--quiet"}, "", std::ref(interrupt));
    CAPTURE(o.err);
    CHECK(interrupt.is_sent);
    CHECK(o.code == 1);
    CHECK(o.processor_seconds - interrupt.used < 3 * sanitizer_slowdown);
    CHECK(o.err == "phasetree: interrupted while the object was being prepared; no file was written\n");
    CHECK(shell.directory.size() == 1);
}

// Even a picture of one sample a pixel, cut off in its only pass, is not told to be whole.
TEST_CASE("Ctrl-C in the first pass exits with 130 too") {
    const Shell shell;
    write_text(shell.directory / "scene.json", SceneText().text());
    Interrupt interrupt{SIGINT, samples_begin};
    const Outcome o = shell.run({"render", "scene.json", "-o", "a.exr", "--spp", "1", "--size", "3000x2000"}, "",
                                std::ref(interrupt));
    CAPTURE(o.err);
    CHECK(o.code == 130);
    CHECK(o.err.find("interrupted") != std::string::npos);
    CHECK(shell.directory.size() == 2);
}

}  // namespace test_render
