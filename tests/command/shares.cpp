// However a render is cut into threads and shares, and however these are merged, the bytes of its image are the same.
#include <algorithm>
#include <limits>

#include "cut_scene.hpp"

namespace test_shares {

using namespace phasetree::tests;

namespace {

// Numbers from 0 to `samples`, the first and the last of them among them: where one share ends and the next begins.
std::vector<int> random_cuts(Uniform& random, int samples) {
    std::vector<int> cuts{0, samples};
    for (int more = 1 + below(random, 4); more > 0; --more) cuts.push_back(1 + below(random, samples - 1));
    std::ranges::sort(cuts);
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    return cuts;
}

template <class T>
void shuffle(Uniform& random, std::vector<T>& list) {
    for (std::size_t i = list.size(); i > 1; --i)
        std::swap(list[i - 1], list[static_cast<std::size_t>(below(random, static_cast<int>(i)))]);
}

}  // namespace

TEST_CASE("any partition of the samples, rendered with any threads and merged in any order, is the whole") {
    constexpr int samples = 12;
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(samples));
    const std::vector<std::string> render{"render", "scene.json", "--planes", "all", "--quiet"};
    REQUIRE(shell.run(joined(render, {"-o", "whole.exr", "--threads", "1"})).code == 0);
    const std::string whole = bytes_of(shell.directory / "whole.exr");
    REQUIRE(whole.size() > 10'000);
    Uniform random(37);
    for (int partitions = long_tests() ? 30 : 3; partitions > 0; --partitions) {
        const std::vector<int> cuts = random_cuts(random, samples);
        std::vector<std::string> parts;
        for (std::size_t i = 1; i < cuts.size(); ++i) {
            const std::string range = std::to_string(cuts[i - 1]) + ":" + std::to_string(cuts[i]);
            parts.push_back(range + ".part");
            const std::string threads = std::to_string(1 + below(random, 4));
            REQUIRE(
                shell.run(joined(render, {"--sample-range", range, "-o", parts.back(), "--threads", threads})).code ==
                0);
        }
        CAPTURE(parts);
        // The first two become one, which is merged with the others.
        const Outcome two = shell.run({"merge", parts[1], parts[0], "-o", "two.part", "--quiet"});
        CHECK_MESSAGE(two.code == 0, two.err);
        std::vector<std::string> others{"two.part"};
        others.insert(others.end(), parts.begin() + 2, parts.end());
        for (std::vector<std::string>* list : {&parts, &others}) {
            shuffle(random, *list);
            const Outcome o = shell.run(joined(joined({"merge"}, *list), {"-o", "joined.exr", "--quiet"}));
            CHECK_MESSAGE(o.code == 0, o.err);
            const bool same = bytes_of(shell.directory / "joined.exr") == whole;
            CHECK(same);
            std::filesystem::remove(shell.directory / "joined.exr");
        }
    }
}

TEST_CASE("a crop and a picture as people see it are merged, too") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(4));
    const std::vector<std::string> render{"render", "scene.json", "--crop", "3,2,20,19", "--quiet", "--exposure", "1"};
    REQUIRE(shell.run(joined(render, {"-o", "whole.exr", "-o", "whole.png"})).code == 0);
    REQUIRE(shell.run(joined(render, {"-o", "a.part", "--sample-range", "0:3"})).code == 0);
    REQUIRE(shell.run(joined(render, {"-o", "b.part", "--sample-range", "3:4"})).code == 0);
    const Outcome o = shell.run({"merge", "a.part", "b.part", "-o", "a.exr", "-o", "a.png", "--exposure", "1"});
    CHECK(o.code == 0);
    CHECK(o.err.find("a.exr (17x17, 4 samples per pixel, 2 parts)") != std::string::npos);
    for (const char* kind : {".exr", ".png"}) {
        const bool same = bytes_of(shell.directory / (std::string("a") + kind)) ==
                          bytes_of(shell.directory / (std::string("whole") + kind));
        CHECK(same);
    }
}

TEST_CASE("--samples, the old name of --sample-range, still works and prints one warning") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(4));
    const auto part = [&](const std::string& option, const std::string& file) {
        return shell.run({"render", "scene.json", "--quiet", option, "1:3", "-o", file});
    };
    const Outcome now = part("--sample-range", "now.part"), before = part("--samples", "before.part");
    CHECK(now.code == 0);
    CHECK(now.err == "");
    CHECK(before.code == 0);
    CHECK(before.err == "phasetree: warning: --samples is deprecated; use --sample-range instead\n");
    const bool same = bytes_of(shell.directory / "now.part") == bytes_of(shell.directory / "before.part");
    CHECK(same);
    const Outcome both =
        shell.run({"render", "scene.json", "--samples", "1:3", "--sample-range", "1:3", "-o", "a.part"});
    CHECK(both.code == 2);
    CHECK(both.err.find("--samples is the old name of --sample-range; give only one of them") == 0);
    CHECK(shell.run({"render", "--help"}).out.find("--samples") == std::string::npos);
}

TEST_CASE("what does not belong together is rejected by name") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(8));
    std::string darker = cut_scene(8);
    darker.replace(darker.find("0.4"), 3, "0.3");
    write_text(shell.directory / "darker.json", darker);
    const auto part = [&](const std::string& name, const std::string& scene, std::vector<std::string> words) {
        words.insert(words.begin(), {"render", scene, "--quiet", "-o", name});
        const Outcome o = shell.run(words);
        REQUIRE_MESSAGE(o.code == 0, o.err);
    };
    part("first.part", "scene.json", {"--sample-range", "0:4"});
    part("again.part", "scene.json", {"--sample-range", "3:8"});
    part("last.part", "scene.json", {"--sample-range", "6:8"});
    part("scene.part", "darker.json", {"--sample-range", "4:8"});
    part("seed.part", "scene.json", {"--sample-range", "4:8", "--seed", "5"});
    part("planes.part", "scene.json", {"--sample-range", "4:8", "--planes", "depth"});
    part("size.part", "scene.json", {"--sample-range", "4:8", "--size", "20x20"});
    part("crop.part", "scene.json", {"--sample-range", "4:8", "--crop", "0,0,8,8"});
    part("spp.part", "scene.json", {"--sample-range", "4:8", "--spp", "9"});
    part("quality.part", "scene.json", {"--sample-range", "4:8", "--build-quality", "low"});
    part("detail.part", "scene.json", {"--sample-range", "4:8", "--detail", "2"});
    write_text(shell.directory / "picture.part", "\x89PNG and so on, for some more bytes");
    write_text(shell.directory / "empty.part", "");
    part("second.part", "scene.json", {"--sample-range", "4:8"});
    const std::string second = bytes_of(shell.directory / "second.part");
    write_text(shell.directory / "short.part", second.substr(0, second.size() / 2));
    std::string changed = second;
    changed[changed.size() / 2] ^= 4;
    write_text(shell.directory / "changed.part", changed);
    std::filesystem::create_directory(shell.directory / "folder.part");
    const auto refused = [&](const std::string& name, const std::string& why) {
        CAPTURE(name);
        const Outcome o = shell.run({"merge", "first.part", name, "-o", "a.exr", "--quiet"});
        CAPTURE(o.err);
        CHECK(o.code == 2);
        CHECK(o.out.empty());
        CHECK(o.err.find(name) != std::string::npos);
        CHECK(o.err.find(why) != std::string::npos);
        CHECK(std::ranges::count(o.err, '\n') == 1);
        CHECK_FALSE(std::filesystem::exists(shell.directory / "a.exr"));
    };
    refused("again.part", "its samples 3:8 are also in \"first.part\"");
    refused("last.part", "samples 4:6 are missing between \"first.part\" and it");
    refused("scene.part", "it belongs to another scene");
    refused("seed.part", "it has seed 5, not 0");
    refused("planes.part", "planes");
    refused("size.part", "it has size 20x20, not 28x21");
    refused("crop.part", "it has crop 0,0,8,8, not 0,0,28,21");
    refused("spp.part", "it belongs to a render with 9 samples per pixel");
    refused("quality.part", "it has build quality low, not medium");
    refused("detail.part", "it has detail 2 pixels, not the finest");
    refused("picture.part", "it is neither a part nor a checkpoint");
    refused("empty.part", "it is neither a part nor a checkpoint");
    refused("short.part", "it is truncated");
    refused("changed.part", "it is damaged");
    refused("folder.part", "it is not a regular file");
    refused("absent.part", "no such file");
    // What is missing at the end belongs to no part.
    const Outcome o = shell.run({"merge", "first.part", "-o", "a.exr"});
    CHECK(o.code == 2);
    CHECK(o.err.find("samples 4:8 are missing") != std::string::npos);
    CHECK(shell.run({"merge", "first.part", "-o", "a.exr", "--allow-gaps"}).code == 0);
    CHECK(shell.run({"merge", "first.part", "last.part", "-o", "a.exr", "--allow-gaps"}).code == 0);
}

TEST_CASE("the memory of a merge does not grow with the number of the parts" * doctest::skip(under_sanitizer)) {
    Shell shell;
    shell.executes_program = true;
    SceneText scene;
    scene.rest = R"("render": {"width": 640, "height": 480, "samples": 10, "max_depth": 1})";
    write_text(shell.directory / "scene.json", scene.text());
    std::vector<std::string> merge{"merge"};
    // The least of a few runs: which thread of the writer takes how much at the same time is chance, and a few
    // megabytes.
    const auto megabytes = [&] {
        double least = std::numeric_limits<double>::infinity();
        for (int i = 0; i < 5; ++i) {
            const Outcome o = shell.run(joined(merge, {"-o", "a.exr", "--quiet", "--allow-gaps"}));
            CHECK_MESSAGE(o.code == 0, o.err);
            least = std::min(least, o.peak_megabytes);
        }
        return least;
    };
    double of_two = 0;
    for (int i = 0; i < 10; ++i) {
        merge.push_back(std::to_string(i) + ".part");
        const std::string range = std::to_string(i) + ":" + std::to_string(i + 1);
        REQUIRE(shell.run({"render", "scene.json", "--sample-range", range, "-o", merge.back(), "--quiet"}).code == 0);
        if (i == 1) of_two = megabytes();
    }
    const double of_part = static_cast<double>(bytes_of(shell.directory / "0.part").size()) / 1e6;
    CHECK(of_part > 2);
    // Eight parts more would be eight times a part if they were kept; what is chance is about one.
    CHECK(megabytes() < of_two + 3 * of_part);
}

}  // namespace test_shares
