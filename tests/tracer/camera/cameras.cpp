// Cameras in scene files, and a picture of a camera without perspective.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "scene/read_parts.hpp"
#include "tracer/support/paths.hpp"

namespace test_cameras {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

const std::string ball = R"({"set": {"phase": "black", "of": {"sphere": {"radius": 1}}}})";

Scene scene_with(const std::string& camera, const std::string& more = "") {
    return scene_of(R"("black": {"diffuse": {"color": [0, 0, 0]}})", ball,
                    std::string(white_environment) + R"(, "camera": )" + camera + more);
}

std::string message_of(const std::string& camera) {
    try {
        (void)scene_with(camera);
    } catch (const phasetree::SceneError& e) {
        return e.what();
    }
    return "";
}

bool says(const std::string& camera, const std::string& part) {
    const std::string message = message_of(camera);
    CAPTURE(message);
    return message.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a camera without a kind is a thin lens") {
    const std::string members =
        R"({"position": [1, -5, 2], "look_at": [0, 0, 1], "fov": 33, "lens_radius": 0.5, "focus_distance": 4})";
    const Scene plain = scene_with(members), named = scene_with(R"({"thin_lens": )" + members + "}");
    for (const Scene* scene : {&plain, &named}) {
        const auto& lens = std::get<ThinLensParameters>(scene->camera);
        CHECK(lens.position == glm::vec3(1, -5, 2));
        CHECK(lens.look_at == glm::vec3(0, 0, 1));
        CHECK(lens.vertical_fov_degrees == 33);
        CHECK(lens.lens_radius == 0.5f);
        CHECK(lens.focus_distance == 4.0f);
        CHECK(scene->film.width == 1024);
        CHECK(scene->film.height == 768);
    }
}

TEST_CASE("a camera that is turned stands elsewhere on a circle, and looks at the same point") {
    const auto lens = [](const std::string& more, double seconds = 0) {
        const std::string text = R"({"position": [1, -5, 2], "look_at": [1, 0, 1], "lens_radius": 0.5)" + more + "}";
        FilmSettings film;
        const auto document = phasetree::Document::from_text(text, "camera.json").at(seconds);
        return std::get<ThinLensParameters>(read_camera(document, document.root(), film));
    };
    const auto is_near = [](const glm::vec3& a, const glm::vec3& b) { return glm::length(a - b) < 1e-5f; };
    const std::string turn = R"(, "up": [0, 0, 2], "turn": 90)";
    CHECK(is_near(lens(turn).position, {6, 0, 2}));
    CHECK(is_near(lens(R"(, "turn": -90)").position, {-4, 0, 2}));
    CHECK(lens(R"(, "turn": 0)").position == glm::vec3(1, -5, 2));
    CHECK(lens(turn).look_at == glm::vec3(1, 0, 1));
    // The point in focus stays where it is.
    CHECK(lens(turn + R"(, "focus_at": [3, 0, 1.6])").focus_distance.value() ==
          doctest::Approx(lens(R"(, "focus_at": [1, -2, 1.6])").focus_distance.value()));
    // Over y, and about an axis that the scene gives.
    CHECK(is_near(lens(R"(, "up": [0, 0, 0], "turn": 180)").position, {1, -5, 0}));
    CHECK(is_near(lens(R"(, "up": [1, 0, 0], "turn": 180)").position, {1, 5, 0}));
    const std::string keys = R"(, "turn": {"keys": [[0, 0], [4, 360]]})";
    for (const double seconds : {0.0, 0.5, 1.0, 3.0, 4.0}) {
        const double angle = seconds / 4 * 2 * std::numbers::pi;
        CHECK(is_near(lens(keys, seconds).position, {1 + 5 * std::sin(angle), -5 * std::cos(angle), 2}));
    }
}

TEST_CASE("an orthographic camera, and what is none") {
    const Scene scene = scene_with(
        R"({"orthographic": {"position": [1, -5, 2], "look_at": [0, 0, 1], "up": [1, 0, 0], "height": 7, "filter": "box"}})");
    const auto& parallel = std::get<OrthographicParameters>(scene.camera);
    CHECK(parallel.position == glm::vec3(1, -5, 2));
    CHECK(parallel.look_at == glm::vec3(0, 0, 1));
    CHECK(parallel.up == glm::vec3(1, 0, 0));
    CHECK(parallel.height == 7);
    CHECK(scene.film.filter.shape() == PixelFilter::Shape::box);

    CHECK(says(R"({"orthografic": {}})", "did you mean \"orthographic\"?"));
    CHECK(says(R"({"orthographic": {"position": [0, -5, 0], "look_at": [0, 0, 0]}})", "height"));
    CHECK(says(R"({"orthographic": {"position": [0, -5, 0], "look_at": [0, 0, 0], "height": 0}})", "height"));
    CHECK(says(R"({"orthographic": {"position": [0, -5, 0], "look_at": [0, 0, 0], "height": 1.1e10}})", "1e10"));
    CHECK(says(R"({"orthographic": {"position": [0, -5, 0], "look_at": [0, 0, 0], "height": 1, "fov": 3}})", "fov"));
    CHECK(says(R"({"orthographic": {"position": [0, 0, 0], "look_at": [0, 0, 0], "height": 1}})", "are the same"));
    CHECK(says(R"({"orthographic": 5})", "look_at") == false);
    CHECK_FALSE(message_of(R"({"orthographic": 5})").empty());
    CHECK(says(R"({"position": [0, -5, 0]})", "look_at"));
}

TEST_CASE("in an orthographic picture a ball is a disk of its own radius, from near and from far") {
    // A black ball in front of white light. Pixels are 0.1 wide, and those that touch the rim are not tested.
    constexpr int width = 41, height = 31;
    for (const double distance : {2.0, 2000.0}) {
        CAPTURE(distance);
        const Scene scene = scene_with(R"({"orthographic": {"position": [0.2, )" + std::to_string(-distance) +
                                           R"(, 0], "look_at": [0.2, 0, 0], "height": 3.1, "filter": "box"}})",
                                       R"(, "render": {"width": 41, "height": 31, "samples": 1})");
        const World world(scene);
        const Image image = image_of(world, scene);
        int wrong = 0, inside = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double from_centre =
                    std::hypot(0.2 + 0.1 * (x + 0.5 - 0.5 * width), 0.1 * (0.5 * height - y - 0.5));
                if (std::abs(from_centre - 1) < 0.08) continue;
                inside += from_centre < 1;
                const glm::vec3 expected(from_centre < 1 ? 0.0f : 1.0f);
                wrong += image.pixels[static_cast<std::size_t>(y * width + x)] != expected;
            }
        CHECK(wrong == 0);
        CHECK(inside > 200);

        RenderJob job;
        job.pixels = {7, 5, 20, 11};
        const Image crop = render(world, scene, job).image;
        int different = 0;
        for (int y = 5; y < 11; ++y)
            for (int x = 7; x < 20; ++x)
                different +=
                    crop.pixels[job.pixels.index(x, y)] != image.pixels[static_cast<std::size_t>(y * width + x)];
        CHECK(different == 0);
    }
}

TEST_CASE("the largest orthographic picture has no ray that Embree cannot bear") {
    const Scene scene =
        scene_with(R"({"orthographic": {"position": [0, -1e15, 0], "look_at": [0, 0, 0], "height": 1e10}})",
                   R"(, "render": {"width": 32768, "height": 1, "samples": 1})");
    const World world(scene);
    RenderJob job;
    job.pixels = {0, 0, 2, 1};
    CHECK(render(world, scene, job).image.pixels[0] == glm::vec3(1));
}

TEST_CASE("orthographic rays start in the phase at their own origins") {
    // The plane on which rays start cuts a ball with the index of its surroundings that absorbs. After half of the
    // ball, e⁻¹ is left in the middle, and all light beside the ball.
    const Scene scene = scene_of(
        R"("haze": {"clear": {"ior": 1, "absorption": [1, 1, 1]}})",
        R"({"set": {"phase": "haze", "of": {"sphere": {"radius": 1}}}})",
        std::string(white_environment) +
            R"(, "camera": {"orthographic": {"position": [0, 0, 0], "look_at": [0, 1, 0], "height": 3, "filter": "box"}},
               "render": {"width": 301, "height": 301, "samples": 1})");
    const World world(scene);
    RenderJob job;
    job.pixels = {150, 150, 151, 151};
    CHECK(render(world, scene, job).image.pixels[0].x == doctest::Approx(std::exp(-1.0)).epsilon(1e-3));
    job.pixels = {290, 150, 291, 151};
    CHECK(render(world, scene, job).image.pixels[0].x == 1.0f);
}

}  // namespace test_cameras
