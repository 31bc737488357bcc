// Pictures of objects that move while the shutter is open, compared with closed forms and each other.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "tracer/support/paths.hpp"

namespace test_motion_blur {

using namespace phasetree;
using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

Scene scene_with(const std::string& rest, const std::string& render, const std::string& transform,
                 const std::string& camera) {
    return read_scene(Document::from_text(
        R"({"version": 1, "phases": {"black": {"diffuse": {"color": [0, 0, 0]}}, "glass": {"clear": {"ior": 1.5}}},
        "objects": [{"name": "wall", "tree": {"set": {"phase": "black", "of": {"box": {"size": [4, 1, 40]}}}},
                     "transform": )" +
            transform + "}" + rest + R"(], "lights": [{"constant": {}}], "camera": )" + camera +
            R"(, "render": {"width": 40, "height": 8, )" + render + "}}",
        "test.json"));
}

const std::string along_x =
    R"({"keys": [[0, {"translate": {"by": [-3, 0, 0]}}], [2, {"translate": {"by": [1, 0, 0]}}]]})";
// Eight metres high and forty wide: a pixel is a metre.
const std::string from_above =
    R"({"orthographic": {"position": [0, -9, 0], "look_at": [0, 0, 0], "height": 8, "filter": "box"}})";

// The share of the time, averaged over the column from x to x + 1, in which the wall does not cover it. The wall is 4
// wide, and moves by this much at a constant speed; its middle is at `start` first.
double free_time(double x, double start, double moved) {
    double sum = 0;
    constexpr int n = 4000;
    for (int i = 0; i < n; ++i) {
        const double at = x + (i + 0.5) / n;
        // It covers a point while its middle is within 2.
        const double first = std::clamp((at - 2 - start) / moved, 0.0, 1.0);
        const double last = std::clamp((at + 2 - start) / moved, 0.0, 1.0);
        sum += 1 - (last - first);
    }
    return sum / n;
}

double worst_column(const Image& image, double start, double moved) {
    double worst = 0;
    for (int x = 0; x < image.width; ++x) {
        double sum = 0;
        for (int y = 0; y < image.height; ++y)
            sum += static_cast<double>(image.pixels[static_cast<std::size_t>(y * image.width + x)].y);
        worst = std::max(worst, std::abs(sum / image.height - free_time(x - 20, start, moved)));
    }
    return worst;
}

bool equal_bits(const Image& a, const Image& b) {
    return a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec3)) == 0;
}

Image image_of(const Scene& scene, int threads = 0) {
    const World world(scene);
    RenderJob job;
    job.pixels = scene.film.whole();
    job.threads = threads;
    return render(world, scene, job).image;
}

}  // namespace

TEST_CASE("a blurred wall covers each pixel for as long as it is before it") {
    const std::string render = R"("samples": 4096, "shutter": [0, 2])";
    const Image image = image_of(scene_with("", render, along_x, from_above));
    // Time and position in a pixel are drawn independently, so in a column at an edge, the mean of 8 × 4096 samples has
    // a standard error of about 0.0005.
    CHECK(worst_column(image, -3, 4) < 0.003);
    // A path that is 1 % longer would be detected.
    CHECK(worst_column(image, -3, 4.04) > 0.006);
    CHECK(worst_column(image, -3.04, 4) > 0.006);
    // A shutter that is open for half of that time, and one before the time of the picture.
    CHECK(worst_column(image_of(scene_with("", R"("samples": 4096, "shutter": [0.5, 1.5])", along_x, from_above)), -2,
                       2) < 0.003);
    CHECK(worst_column(image_of(scene_with("", R"("samples": 4096, "shutter": [-1, 1])", along_x, from_above)), -3, 4) >
          0.1);
}

TEST_CASE("a camera that moves blurs as if all else moved the other way") {
    const std::string stands = R"({"translate": {"by": [-3, 0, 0]}})";
    const std::string moving =
        R"({"orthographic": {"position": {"keys": [[0, [0, -9, 0]], [2, [-4, -9, 0]]]},
            "look_at": {"keys": [[0, [0, 0, 0]], [2, [-4, 0, 0]]]}, "height": 8, "filter": "box"}})";
    const Image image = image_of(scene_with("", R"("samples": 4096, "shutter": [0, 2])", stands, moving));
    CHECK(worst_column(image, -3, 4) < 0.003);
    CHECK(worst_column(image, -3, 4.04) > 0.006);
    // Together they stand still.
    const Image together = image_of(scene_with("", R"("samples": 64, "shutter": [0, 2])", R"({"keys":
        [[0, {"translate": {"by": [-3, 0, 0]}}], [2, {"translate": {"by": [-7, 0, 0]}}]]})",
                                               moving));
    CHECK(worst_column(together, -3, 1e-9) < 1e-4);
}

TEST_CASE("a shutter changes no bit of what stands still") {
    const std::string ball = R"(, {"name": "ball", "tree": {"set": {"phase": "glass", "of": {"sphere": {"radius": 2}}}},
        "transform": {"translate": {"by": [6, 0, 0]}}})";
    const std::string stands = R"({"translate": {"by": [-3, 0, 0]}})";
    const Image without = image_of(scene_with(ball, R"("samples": 7)", stands, from_above));
    const Image with = image_of(scene_with(ball, R"("samples": 7, "shutter": [0, 2])", stands, from_above));
    CHECK(equal_bits(without, with));
    // An object whose motion ends before the shutter opens is at rest.
    const std::string done =
        R"({"keys": [[-2, {"translate": {"by": [0, 0, 0]}}], [0, {"translate": {"by": [-3, 0, 0]}}]]})";
    CHECK(equal_bits(without, image_of(scene_with(ball, R"("samples": 7, "shutter": [1, 1])", done, from_above))));
    CHECK_FALSE(
        equal_bits(without, image_of(scene_with(ball, R"("samples": 7, "shutter": [0, 2])", along_x, from_above))));
}

TEST_CASE("photons light what is there at their time") {
    // A ball of glass over a floor, and a lamp. Once the ball moves, and once it is at rest at nine points of its path.
    const auto scene = [](const std::string& transform, const std::string& more) {
        return read_scene(Document::from_text(
            R"({"version": 1, "phases": {"glass": {"clear": {"ior": 1.5}}, "floor": {"diffuse": {"color": [0.8, 0.8, 0.8]}}},
            "objects": [{"name": "ball", "tree": {"set": {"phase": "glass", "of": {"sphere": {"radius": 0.5}}}},
                         "transform": )" +
                transform +
                R"(}, {"name": "ground", "tree": {"set": {"phase": "floor", "of": {"box": {"size": [6, 6, 0.2]}}}}}],
            "lights": [{"point": {"position": [0, 0, 6], "intensity": 30}}],
            "camera": {"orthographic": {"position": [0, 0, 8], "look_at": [0, 0, 0], "height": 3}},
            "render": {"width": 12, "height": 8, "samples": 90, "caustics": true, "photons": 30)" +
                more + "}}",
            "test.json"));
    };
    const Scene moving =
        scene(R"({"keys": [[0, {"translate": {"by": [-1, 0, 1]}}], [1, {"translate": {"by": [1, 0, 1]}}]]})",
              R"(, "shutter": [0, 1])");
    const Image blurred = image_of(moving, 1);
    CHECK(equal_bits(blurred, image_of(moving, 3)));
    double mean = 0, expected = 0, dark = 0;
    constexpr int places = 9;
    std::vector<double> still(blurred.pixels.size());
    for (int i = 0; i < places; ++i) {
        const double x = -1 + 2 * (i + 0.5) / places;
        const Image image = image_of(scene(fmt::format(R"({{"translate": {{"by": [{}, 0, 1]}}}})", x), ""));
        for (std::size_t k = 0; k < still.size(); ++k) still[k] += static_cast<double>(image.pixels[k].y) / places;
    }
    for (std::size_t k = 0; k < still.size(); ++k) {
        mean += static_cast<double>(blurred.pixels[k].y);
        expected += still[k];
    }
    CHECK(std::abs(mean / expected - 1) < 0.02);
    // Paths at another time than their photons would find light in the ball's shadow, so pictures are compared pixel by
    // pixel.
    for (std::size_t k = 0; k < still.size(); ++k)
        dark = std::max(dark, std::abs(static_cast<double>(blurred.pixels[k].y) - still[k]));
    CHECK(dark < 0.25 * expected / static_cast<double>(still.size()));
}

}  // namespace test_motion_blur
