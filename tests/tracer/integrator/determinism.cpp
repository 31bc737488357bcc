// The picture is the same bit for bit, however it is computed.
#include <doctest/doctest.h>

#include <cstring>

#include "output/encode.hpp"
#include "output/environment.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "tracer/support/paths.hpp"

namespace test_determinism {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

// Some of everything: clear, rough, diffuse, textured, coated and metal phases, a mesh, lights near and far, a lens;
// optionally caustics and a guide.
Scene everything(bool caustics = false, bool guiding = false) {
    return scene_of(
        R"("glass": {"clear": {"ior": 1.5, "absorption": [0.2, 0.1, 0.3]}}, "water": {"clear": {"ior": 1.33}},
           "frost": {"clear": {"ior": 1.4, "roughness": 0.2}}, "sand": {"diffuse": {"color": {"speckle": {"grain": 0.02}}}},
           "wood": {"coated": {"color": {"wood": {"ring_spacing": 0.08}}, "roughness": 0.1}},
           "metal": {"conductor": {"metal": "gold", "roughness": 0.1}})",
        R"({"under": [
            {"change": {"from": "water", "to": "sand", "shape": {"plane": {"offset": -0.3}}, "of":
                {"thin_shell": {"of": {"sphere": {"radius": 0.8}}, "shell": "glass", "inside": "water", "half_thickness": 0.04}}}},
            {"set": {"phase": "metal", "of": {"translate": {"by": [0.5, -0.9, -0.5], "of": {"twist": {"rate": 120, "of": {"box": {"size": [0.2, 0.3, 1]}}}}}}}},
            {"set": {"phase": "frost", "of": {"translate": {"by": [-0.7, -0.9, -0.6], "of": {"torus": {"major": 0.3, "minor": 0.1}}}}}},
            {"set": {"phase": "wood", "of": {"translate": {"by": [0, 0, -1], "of": {"cylinder": {"radius": 1.5, "height": 0.3}}}}}}]})",
        std::string(R"("meshes": [{"floor": {"height": -1.3, "material": {"diffuse": {"color": [0.5, 0.4, 0.3]}}}}],
           "lights": [{"gradient": {"zenith": [0.5, 0.6, 0.9], "horizon": [0.5, 0.5, 0.5], "ground": [0.1, 0.1, 0.1]}},
                      {"rectangle": {"centre": [-2, -2, 3], "target": [0, 0, 0], "width": 1, "height": 1, "radiance": [9, 8, 7]}}],
           "camera": {"position": [0.5, -4, 1.2], "look_at": [0, 0, -0.3], "fov": 40, "lens_radius": 0.05},
           "render": {"width": 37, "height": 29, "samples": 5, "seed": 3, "caustics": )") +
            (caustics ? "true" : "false") + R"(, "guiding": )" + (guiding ? "true" : "false") + "}");
}

Image image_with(const World& world, const Scene& scene, int threads, std::optional<PixelRange> part = {}) {
    RenderJob job;
    job.pixels = part.value_or(scene.film.whole());
    job.threads = threads;
    return render(world, scene, job).image;
}

bool equal_bits(const glm::vec3& a, const glm::vec3& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

bool equal_bits(const Image& a, const Image& b) {
    return a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec3)) == 0;
}

}  // namespace

TEST_CASE("any number of threads, any crop") {
    Scene scene = everything();
    const World world(scene);
    const Image one = image_with(world, scene, 1);
    REQUIRE(count_non_finite(one) == 0);

    const test::OcioVariable unset;
    const DisplayTransform display(std::nullopt, std::nullopt, 0);
    const auto exr = [&](const Image& image) { return encode(image, Format::exr, {"scene.json", 5, 3}, display); };
    for (const int threads : {2, 7}) {
        CAPTURE(threads);
        const Image other = image_with(world, scene, threads);
        CHECK(equal_bits(one, other));
        const bool same_file = exr(one) == exr(other);
        CHECK(same_file);
    }

    const PixelRange part{5, 3, 30, 20};
    const Image crop = image_with(world, scene, 2, part);
    REQUIRE(crop.width == part.width());
    REQUIRE(crop.height == part.height());
    int different = 0;
    for (int y = part.y0; y < part.y1; ++y)
        for (int x = part.x0; x < part.x1; ++x)
            if (!equal_bits(crop.pixels[static_cast<std::size_t>((y - part.y0) * part.width() + x - part.x0)],
                            one.pixels[static_cast<std::size_t>(y * one.width + x)]))
                ++different;
    CHECK(different == 0);

    // The comparison can fail.
    scene.settings.seed = 4;
    CHECK_FALSE(equal_bits(one, image_with(world, scene, 1)));
}

namespace {

void check_threads_and_crop(const Scene& scene) {
    const World world(scene);
    const Image one = image_with(world, scene, 1);
    CHECK(equal_bits(one, image_with(world, scene, 3)));
    const PixelRange part{5, 3, 30, 20};
    const Image crop = image_with(world, scene, 2, part);
    int different = 0;
    for (int y = part.y0; y < part.y1; ++y)
        for (int x = part.x0; x < part.x1; ++x)
            different += !equal_bits(crop.pixels[part.index(x, y)], one.pixels[scene.film.whole().index(x, y)]);
    CHECK(different == 0);
    // Photons and guides have an effect.
    CHECK_FALSE(equal_bits(one, image_with(world, everything(), 1)));
}

}  // namespace

TEST_CASE("any number of threads, any crop, with photons") {
    check_threads_and_crop(everything(true));
}

TEST_CASE("any number of threads, any crop, with a guide") {
    check_threads_and_crop(everything(false, true));
}

TEST_CASE("any number of threads, any crop, with photons and a guide") {
    check_threads_and_crop(everything(true, true));
}

TEST_CASE("any number of threads, any crop, with wavelengths, photons and a guide") {
    Scene scene = everything(true, true);
    scene.settings.spectral = true;
    check_threads_and_crop(scene);
}

TEST_CASE("any instruction set") {
    const Scene scene = everything();
    const World world(scene);
    const std::string best = phasetree::simd_target();
    const Image expected = image_with(world, scene, 2);
    for (const std::string& target : phasetree::simd_targets()) {
        CAPTURE(target);
        phasetree::use_simd_target(target);
        CHECK(equal_bits(expected, image_with(world, scene, 2)));
    }
    phasetree::use_simd_target(best);
}

}  // namespace test_determinism
