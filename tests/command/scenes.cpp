// The scenes of the project: each is valid, has its picture, and matches its description in the gallery.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "command/command.hpp"
#include "source_directory.hpp"

namespace test_scenes {

using namespace phasetree::tests;

namespace {

const std::filesystem::path root = source_directory();

std::vector<std::filesystem::path> scenes(const std::filesystem::path& folder = root / "scenes") {
    std::vector<std::filesystem::path> all;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".json" && entry.path().filename() != "scene.schema.json")
            all.push_back(entry.path());
    return all;
}

}  // namespace

TEST_CASE("every scene is sound, has a picture, and is quoted in the gallery with its own numbers") {
    const std::string gallery = bytes_of(root / "scenes" / "README.md");
    const Shell shell;
    CHECK(scenes().size() >= 20);
    for (const std::filesystem::path& scene : scenes()) {
        const std::string name = scene.stem().string();
        CAPTURE(name);
        const Outcome check = shell.run({"check", scene.string()});
        CHECK(check.code == 0);
        CHECK(check.err == "");
        const Outcome info = shell.run({"info", "--json", scene.string()});
        REQUIRE(info.code == 0);
        const auto numbers = nlohmann::json::parse(info.out);
        const double bytes = numbers.at("tree_bytes").get<double>();
        const std::string caption =
            fmt::format("{} phases, {} nodes, {}", numbers.at("phases").size(), numbers.at("nodes").get<int>(),
                        bytes < 1e6 ? fmt::format("{:.1f} kB", bytes / 1e3) : fmt::format("{:.1f} MB", bytes / 1e6));
        CAPTURE(caption);
        const std::size_t at = gallery.find(fmt::format("({}.json)<br>", name));
        REQUIRE(at != std::string::npos);
        CHECK(gallery.substr(at, gallery.find('|', at) - at).find(caption) != std::string::npos);
        CHECK(std::filesystem::exists(root / "scenes" / "gallery" / (name + ".jpg")));
    }
}

TEST_CASE("every scene of several objects is sound, and no object overlaps another") {
    const Shell shell;
    CHECK(!scenes(root / "scenes" / "objects").empty());
    for (const std::filesystem::path& scene : scenes(root / "scenes" / "objects")) {
        CAPTURE(scene.string());
        const Outcome check = shell.run({"check", scene.string()});
        CHECK(check.code == 0);
        CHECK(check.err == "");
    }
}

TEST_CASE("every scene that only the benchmarks need is sound") {
    const Shell shell;
    CHECK(scenes(root / "scenes" / "benchmark").size() == 8);
    for (const std::filesystem::path& scene : scenes(root / "scenes" / "benchmark")) {
        CAPTURE(scene.string());
        const Outcome check = shell.run({"check", scene.string()});
        CHECK(check.code == 0);
        CHECK(check.err == "");
        const Outcome info = shell.run({"info", "--json", scene.string()});
        REQUIRE(info.code == 0);
        // The monophase trees have no phases to speak of.
        const bool is_monophase = scene.stem().string().ends_with("_monophase");
        CHECK((nlohmann::json::parse(info.out).at("phases").size() == 1) == is_monophase);
    }
}

TEST_CASE("the gallery's pictures are below six megabytes together") {
    std::uintmax_t bytes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(root / "scenes" / "gallery"))
        bytes += entry.file_size();
    CHECK(bytes < 6'000'000);
}

TEST_CASE("the gallery's pictures say nothing of how they were made into small files") {
    for (const auto& entry : std::filesystem::directory_iterator(root / "scenes" / "gallery")) {
        CAPTURE(entry.path().string());
        std::ifstream file(entry.path(), std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(file), {}};
        CHECK(bytes.size() > 1000);
        for (const char* word : {"oiiotool", "Exif", "Photoshop"}) CHECK(bytes.find(word) == std::string::npos);
    }
}

}  // namespace test_scenes
