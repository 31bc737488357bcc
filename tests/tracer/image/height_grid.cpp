// An image as a terrain: written by OpenImageIO and named in a scene.
#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "phasetree/model/handle.hpp"
#include "phasetree_support/temporary_directory.hpp"
#include "scene/scene.hpp"

namespace test_height_grid {

using namespace phasetree;
using support::TemporaryDirectory;

namespace {

/// Three pixels wide, two high: white above on the left, half grey below on the right, else black.
void write_image(const std::filesystem::path& path) {
    const OIIO::ImageSpec spec(3, 2, 1, OIIO::TypeDesc::UINT16);
    const std::uint16_t pixels[] = {65535, 0, 0, 0, 0, 32768};
    const auto out = OIIO::ImageOutput::create(path.string());
    REQUIRE(out);
    REQUIRE(out->open(path.string(), spec));
    REQUIRE(out->write_image(OIIO::TypeDesc::UINT16, pixels));
    REQUIRE(out->close());
}

std::string scene(const char* file) {
    return std::string(
               R"({"version": 1, "phases": {"rock": {"diffuse": {"color": [0.5, 0.5, 0.5]}}}, "tree": {"set": {"phase": "rock", "of":
        {"intersection": [{"height_map": {"file": ")") +
           file +
           R"(", "size_x": 6, "size_y": 4, "height": 2}}, {"box": {"size": [6, 4, 8]}}]}}}, "camera": {"position": [0, -9, 9], "look_at": [0, 0, 0]}})";
}

}  // namespace

TEST_CASE("an image of sixteen bits is a terrain, its first row farthest along y") {
    const TemporaryDirectory folder;
    write_image(folder.path() / "hills.png");
    std::ofstream(folder.path() / "scene.json") << scene("hills.png");
    const tracer::Scene read = tracer::read_scene(Document::from_file(folder.path() / "scene.json"));
    const auto height_at = [&](float x, float y) {
        float low = -1, high = 3;
        for (int i = 0; i < 30; ++i) {
            const float middle = 0.5f * (low + high);
            (label(distances(read.object, {x, y, middle})) == Phase{1} ? low : high) = middle;
        }
        return low;
    };
    // In the middle of a pixel, the spline has 3/4 of its value and 1/8 of each neighbour's, along x and y. Beyond the
    // border, the border's pixels continue.
    CHECK(height_at(-2.99f, 1.99f) == doctest::Approx(2).epsilon(1e-3));
    CHECK(height_at(-2, 1) == doctest::Approx(2 * (0.75 + 0.125) * (0.75 + 0.125)).epsilon(1e-4));
    CHECK(height_at(2, -1) == doctest::Approx((0.75 + 0.125) * (0.75 + 0.125)).epsilon(1e-4));
    CHECK(height_at(0, 1) == doctest::Approx(2 * 0.125 * (0.75 + 0.125) + 0.125 * 0.125).epsilon(1e-4));
    CHECK(height_at(-2, -1) == doctest::Approx(2 * (0.75 + 0.125) * 0.125).epsilon(1e-4));
}

TEST_CASE("an image that cannot be used is an error at its name") {
    const TemporaryDirectory folder;
    std::ofstream(folder.path() / "text.png") << "no image";
    const auto error = [&](const char* file) -> std::string {
        std::ofstream(folder.path() / "scene.json") << scene(file);
        try {
            (void)tracer::read_scene(Document::from_file(folder.path() / "scene.json"));
        } catch (const std::exception& e) {
            return e.what();
        }
        return "no error";
    };
    CHECK(error("missing.png").find("scene.json:2:") != std::string::npos);
    CHECK(error("missing.png").find("no such file") != std::string::npos);
    CHECK(error("text.png").find("cannot use the height map") != std::string::npos);
    CHECK(error(".").find("it is not a file") != std::string::npos);
}

}  // namespace test_height_grid
