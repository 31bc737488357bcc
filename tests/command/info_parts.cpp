// Options of `phasetree info`: carved bounds, and cells with a memory limit.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <regex>

#include "command.hpp"

namespace test_info_parts {

using namespace phasetree::tests;

namespace {

// A cube that is turned by 45°, whose bounding box has twice its volume, and a ball.
const std::string cube_and_ball = R"({"version": 1,
    "phases": {"wood": {"diffuse": {"color": [0.5, 0.3, 0.1]}}, "glass": {"clear": {"ior": 1.5}}},
    "tree": {"over": [
        {"set": {"phase": "wood", "of": {"rotate": {"angle": 45, "of": {"box": {"size": [1, 1, 1]}}}}}},
        {"translate": {"by": [3, 0, 0], "of": {"set": {"phase": "glass", "of": {"sphere": {"radius": 0.5}}}}}}]}})";

glm::dvec3 vector_of(const nlohmann::json& numbers) {
    return {numbers[0].get<double>(), numbers[1].get<double>(), numbers[2].get<double>()};
}

}  // namespace

TEST_CASE("info --carve: planes around the whole and each phase") {
    const Shell shell;
    write_text(shell.directory / "scene.json", cube_and_ball);
    const Outcome o = shell.run({"info", "scene.json", "--carve", "--json"});
    REQUIRE(o.code == 0);
    const nlohmann::json carved = nlohmann::json::parse(o.out).at("carved");
    REQUIRE(carved.size() == 3);
    CHECK(carved[0].at("phase").is_null());
    CHECK(carved[1].at("phase") == "wood");
    CHECK(carved[2].at("phase") == "glass");
    // No carved volume is less than the solid's. The cube's planes are its six faces and the four sides of its box.
    const double ball = 4 * 3.14159265358979 / 3 / 8;
    CHECK(carved[1].at("planes").size() == 10);
    CHECK(carved[0].at("volume").get<double>() >= carved[1].at("volume").get<double>() + ball);
    CHECK(carved[1].at("volume").get<double>() >= 1);
    CHECK(carved[1].at("volume").get<double>() < 1.02);
    CHECK(carved[2].at("volume").get<double>() >= ball);
    CHECK(carved[2].at("volume").get<double>() < 1.15 * ball);
    for (const nlohmann::json& part : carved) {
        CHECK(part.at("empty") == false);
        CHECK(part.at("planes").size() <= 40);
        const bool has_cube = part.at("phase") != "glass", has_ball = part.at("phase") != "wood";
        for (const nlohmann::json& plane : part.at("planes")) {
            const glm::dvec3 normal = vector_of(plane.at("normal"));
            const double offset = plane.at("offset").get<double>();
            CHECK(glm::length(normal) == doctest::Approx(1).epsilon(1e-6));
            const double cube_support =
                std::sqrt(0.5) * std::max(std::abs(normal.x), std::abs(normal.y)) + 0.5 * std::abs(normal.z);
            if (has_cube) CHECK(offset >= cube_support - 1e-6);
            if (has_ball) CHECK(offset >= 3 * normal.x + 0.5 - 1e-6);
        }
        // The corners lie on the planes, and within all of them.
        CHECK(part.at("corners").size() >= 8);
        for (const nlohmann::json& corner : part.at("corners")) {
            int touched = 0;
            double most = -1;
            for (const nlohmann::json& plane : part.at("planes")) {
                const double above =
                    glm::dot(vector_of(plane.at("normal")), vector_of(corner)) - plane.at("offset").get<double>();
                touched += std::abs(above) < 1e-5;
                most = std::max(most, above);
            }
            CHECK(touched >= 3);
            CHECK(most < 1e-5);
        }
    }

    const Outcome few = shell.run({"info", "scene.json", "--carve", "--planes", "8"});
    CHECK(few.code == 0);
    CHECK(std::regex_search(
        few.out, std::regex("\ncarved +whole object: 8 planes, volume [0-9.]+, [0-9]+ % of its bounding box")));
    CHECK(std::regex_search(few.out, std::regex("\ncarved +wood: [78] planes, volume ")));
    CHECK(std::regex_search(few.out, std::regex("\ncarved +glass: [78] planes, volume ")));
}

TEST_CASE("info --carve of one material, and of nothing") {
    const Shell shell;
    const std::string head = R"({"version": 1, "phases": {"wood": {"diffuse": {"color": [0.5, 0.3, 0.1]}}}, "tree": )";
    const auto carved = [&](const std::string& tree) {
        write_text(shell.directory / "scene.json", head + tree + "}");
        const Outcome o = shell.run({"info", "scene.json", "--carve", "--json"});
        REQUIRE(o.code == 0);
        return nlohmann::json::parse(o.out).at("carved");
    };
    CHECK(carved(R"({"set": {"phase": "wood", "of": {"sphere": {"radius": 1}}}})").size() == 1);
    const nlohmann::json nothing = carved(R"({"set": {"phase": "wood", "of": {"intersection": [
        {"sphere": {"radius": 1}}, {"translate": {"by": [5, 0, 0], "of": {"sphere": {"radius": 1}}}}]}}})");
    CHECK(nothing.empty());
}

TEST_CASE("--max-memory: sizes as people write them; less memory means fewer cells") {
    const Shell shell;
    write_text(shell.directory / "scene.json", R"({"version": 1, "phases": {"stone": {"diffuse": {"color": [1, 1, 1]}}},
        "tree": {"set": {"phase": "stone", "of": {"displace": {"amplitude": 0.05, "scale": 0.2, "of":
        {"sphere": {"radius": 1}}}}}}})");
    const auto with = [&](const std::string& size) {
        return shell.run({"info", "scene.json", "--json", "--cells", "--max-memory", size});
    };
    const auto cells = [&](const std::string& size) {
        const Outcome o = with(size);
        CAPTURE(size);
        CAPTURE(o.err);
        REQUIRE(o.code == 0);
        return nlohmann::json::parse(o.out).at("cells").get<int>();
    };
    const int all = cells("1G");
    for (const char* const size : {"512M", "1.5G", "2 GiB", "0.001T", "900000 k", "32 MB", "100000000", "64MiB"}) {
        CAPTURE(size);
        CHECK(cells(size) == all);
    }
    CHECK(cells("4M") < all / 2);
    CHECK(cells("4194304") == cells("4M"));
    for (const char* const size : {"0", "-1", "x", "5Q", "1e9", "1..5G", "2Bytes", "1 M M", "", "9999999999999999G"}) {
        CAPTURE(size);
        const Outcome o = with(size);
        CHECK(o.code == 2);
        CHECK(o.err == fmt::format("--max-memory: must be a size such as 512M or 2G, but is \"{}\"\nRun with --help "
                                   "for more information.\n",
                                   size));
    }
}

}  // namespace test_info_parts
