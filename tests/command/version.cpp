// What `--version` prints, and that samples and cells of another build are not mixed with those of this one.
#include "phasetree/version.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <regex>

#include "cells/file_header.hpp"
#include "cut_scene.hpp"
#include "film/film.hpp"
#include "film_file/read.hpp"
#include "film_file/write.hpp"

namespace test_version {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

constexpr const char* other_build = "0.9.0+0123456789ab";

// The same samples, as another build would have rendered them.
void rewrite_as_of_other_build(const std::filesystem::path& path) {
    const tracer::FilmFile file(path);
    tracer::FilmFileHeader header = file.header();
    tracer::Film film(header.film, header.area, header.scene_names);
    file.add_to(film);
    REQUIRE(header.settings.at(0) == std::pair<std::string, std::string>("version", build_id()));
    REQUIRE(header.settings.at(1) == std::pair<std::string, std::string>("commit", source_commit()));
    header.settings[0].second = other_build;
    header.settings[1].second = "c0ffee123456";
    tracer::write_film(path, header, film);
}

}  // namespace

TEST_CASE("--version: the build, and a line for each library") {
    const Outcome o = Shell().run({"--version"});
    CHECK(o.code == 0);
    CHECK(o.err.empty());
    std::istringstream lines(o.out);
    std::string line;
    REQUIRE(std::getline(lines, line));
    CHECK(line == std::string("phasetree ") + build_id());
    CHECK(std::regex_match(build_id(), std::regex(R"(\d+\.\d+\.\d+\+[0-9a-f]{12})")));
    CHECK(std::string(build_id()).starts_with(std::string(version()) + "+"));
    std::vector<std::string> names, values;
    while (std::getline(lines, line)) {
        const std::size_t colon = line.find(": ");
        REQUIRE_MESSAGE(colon != std::string::npos, line);
        names.push_back(line.substr(0, colon));
        values.push_back(line.substr(colon + 2));
        CHECK_MESSAGE(!values.back().empty(), line);
    }
    CHECK(names == std::vector<std::string>{"commit", "compiler", "processor", "simd", "embree", "tbb", "openimageio",
                                            "opencolorio", "openvdb", "harfbuzz", "draco", "meshoptimizer",
                                            "open-image-denoise", "live-view"});
    const auto value = [&](std::string_view name) {
        return values.at(static_cast<std::size_t>(std::ranges::find(names, name) - names.begin()));
    };
    CHECK(value("compiler") == compiler());
    CHECK(std::regex_match(value("commit"), std::regex("[0-9a-f]{12}( with changes)?|unknown")));
    for (const char* library : {"embree", "tbb", "openimageio", "opencolorio"})
        CHECK_MESSAGE(std::regex_match(value(library), std::regex(R"(\d+\.\d+.*)")), value(library));
    for (const char* library : {"openvdb", "harfbuzz", "open-image-denoise"})
        CHECK_MESSAGE(std::regex_match(value(library), std::regex(R"(no|\d+\.\d+.*)")), value(library));
}

TEST_CASE("parts of different builds are not merged, and a checkpoint of another build is not resumed") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(4));
    const std::vector<std::string> render{"render", "scene.json", "--quiet"};
    REQUIRE(shell.run(joined(render, {"--sample-range", "0:2", "-o", "a.part"})).code == 0);
    REQUIRE(shell.run(joined(render, {"--sample-range", "2:4", "-o", "b.part"})).code == 0);
    rewrite_as_of_other_build(shell.directory / "b.part");
    const auto mine = [] {
        const std::string commit = source_commit();
        return std::string("phasetree ") + build_id() + (commit.empty() ? "" : " (commit " + commit + ")");
    }();
    const std::string other = std::string("phasetree ") + other_build + " (commit c0ffee123456)";
    const std::string advice = "; render all samples of a picture with the same build\n";

    const Outcome merged = shell.run({"merge", "a.part", "b.part", "-o", "a.exr"});
    CHECK(merged.code == 2);
    CHECK(merged.err == "phasetree: cannot use \"b.part\": it was rendered by " + other + ", not by " + mine + advice);
    CHECK_FALSE(std::filesystem::exists(shell.directory / "a.exr"));

    const Outcome resumed = shell.run(joined(render, {"--sample-range", "2:4", "--resume", "b.part", "-o", "c.part"}));
    CHECK(resumed.code == 2);
    CHECK(resumed.err == "phasetree: cannot use \"b.part\": it was rendered by " + other + ", not by " + mine + advice);
    CHECK_FALSE(std::filesystem::exists(shell.directory / "c.part"));

    // Any build may join parts that are all of one other build. The picture says which rendered it.
    rewrite_as_of_other_build(shell.directory / "a.part");
    const Outcome joined_parts = shell.run({"merge", "a.part", "b.part", "-o", "a.exr"});
    CHECK(joined_parts.code == 0);
    CHECK(joined_parts.err.starts_with(std::string("phasetree: note: the parts were rendered by build ") + other_build +
                                       " and are merged by build " + build_id() + "\n"));
    CHECK(bytes_of(shell.directory / "a.exr").find(std::string("phasetree ") + other_build) != std::string::npos);
}

TEST_CASE("kept cells of another build are built again and replaced") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cut_scene(1));
    const std::vector<std::string> render{"render", "scene.json", "--quiet", "-o", "a.exr", "--cells", "kept"};
    REQUIRE(shell.run(render).code == 0);
    const std::string kept = bytes_of(shell.directory / "kept");
    cells::CellsFileHeader header;
    REQUIRE(kept.size() > sizeof header);
    std::memcpy(&header, kept.data(), sizeof header);
    CHECK(std::string(header.library.data()) == build_id());
    header.library = {'0', '.', '9', '.', '0'};
    header.header_checksum = header.own_checksum();
    std::string older = kept;
    std::memcpy(older.data(), &header, sizeof header);
    write_text(shell.directory / "kept", older);
    const Outcome o = shell.run(render);
    CHECK(o.code == 0);
    CHECK(o.err.empty());
    const bool is_replaced = bytes_of(shell.directory / "kept") == kept;
    CHECK(is_replaced);
}

}  // namespace test_version
