// Pixels that stop early because they have little noise: when they stop, with which error, the same bits however the
// work is divided, and no significant bias.
#include "render/noise_limit.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <cstring>

#include "support/uniform.hpp"
#include "tracer/support/paths.hpp"

namespace test_noise_limit {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;
using phasetree::tests::Uniform;

namespace {

// A floor with a ball of glass: under a small lamp, only a few bright paths find its caustic by chance, and the rest of
// the floor is smooth. With 23 by 19 pixels, some blocks are incomplete.
Scene lamp_and_glass(float noise, int samples) {
    Scene scene = scene_of(
        R"("glass": {"clear": {"ior": 1.5}})", R"({"set": {"phase": "glass", "of": {"sphere": {"radius": 0.6}}}})",
        std::string(
            R"("meshes": [{"floor": {"height": -0.7, "material": {"diffuse": {"color": [0.5, 0.5, 0.5]}}}}],
               "lights": [{"constant": {"intensity": 0.05}}, {"sphere": {"centre": [1, 1, 3], "radius": 0.7, "intensity": 4}}],
               "camera": {"position": [0, -4, 2], "look_at": [0, 0, -0.4], "fov": 40},
               "render": {"width": 23, "height": 19, "max_depth": 8})"));
    scene.settings.noise = noise;
    scene.settings.samples = samples;
    return scene;
}

RenderJob whole(const Scene& scene, int threads = 0) {
    RenderJob job;
    job.pixels = scene.film.whole();
    job.threads = threads;
    return job;
}

const std::vector<float>& samples_of(const Image& image) {
    const auto found = std::ranges::find(image.extra_channels, std::string("samples.X"), &Channel::name);
    REQUIRE(found != image.extra_channels.end());
    return found->values;
}

bool equal_bits(const Image& a, const Image& b) {
    if (a.pixels.size() != b.pixels.size() || a.extra_channels.size() != b.extra_channels.size()) return false;
    if (std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof a.pixels[0]) != 0) return false;
    for (std::size_t c = 0; c < a.extra_channels.size(); ++c)
        if (a.extra_channels[c].values != b.extra_channels[c].values) return false;
    return true;
}

double mean_luminance(const Image& image) {
    double sum = 0;
    for (const glm::vec3& pixel : image.pixels) sum += static_cast<double>(luminance(pixel));
    return sum / static_cast<double>(image.pixels.size());
}

}  // namespace

TEST_CASE("blocks are examined after 32, 48, 64, 96, ... samples") {
    std::vector<int> looks;
    for (int done = 0; done < 400;) looks.push_back(done = NoiseLimit::next_look(done));
    CHECK(looks == std::vector<int>{32, 48, 64, 96, 128, 192, 256, 384, 512});
    int found = 0;
    for (int n = 0; n <= 512; ++n) found += NoiseLimit::is_look(n);
    CHECK(found == 9);
}

TEST_CASE("the error is the root mean square of what pixels are off, relative to them or to a hundredth of white") {
    FilmSettings settings;
    settings.width = 2;
    settings.height = 1;
    settings.planes[Planes::index_of<NoisePlane>()] = true;
    FilmTile tile(settings.whole(), settings.planes, {});
    const auto add = [&](int x, float value, std::uint32_t number) {
        FilmSample sample{.number = number};
        sample.radiance = glm::vec3(value);
        tile.add(x, 0, sample);
    };
    // The first pixel has the samples 1 and 3: their mean is 2, their variance 2, and the variance of the mean 1. The
    // second has 0 and 0.002.
    for (const std::uint32_t i : {0u, 1u}) {
        add(0, i == 0 ? 1.0f : 3.0f, i);
        add(1, i == 0 ? 0.0f : 0.002f, i);
    }
    RenderSettings limit;
    CHECK_FALSE(NoiseLimit::of(limit));
    limit.noise = 0.1f;
    const auto expected = [](double darkest) { return std::sqrt((1.0 / 4 + 1e-6 / (darkest * darkest)) / 2); };
    CHECK(NoiseLimit::of(limit)->error(tile, settings.whole()) == doctest::Approx(expected(0.01)).epsilon(1e-5));
    // One stop brighter, half as much is white.
    limit.exposure_ev = 1;
    CHECK(NoiseLimit::of(limit)->error(tile, settings.whole()) == doctest::Approx(expected(0.005)).epsilon(1e-5));
}

TEST_CASE("blocks stop at different times, whole, and the noisy ones have all samples") {
    const Scene scene = lamp_and_glass(0.07f, 192);
    const World world(scene);
    const Rendering r = render(world, scene, whole(scene));
    const std::vector<float>& samples = samples_of(r.image);
    std::vector<float> different(samples);
    std::ranges::sort(different);
    different.erase(std::unique(different.begin(), different.end()), different.end());
    CHECK(different.size() > 2);
    CHECK(different.front() >= 32);
    CHECK(different.back() == 192);
    CHECK(r.noisy_blocks > 0);
    CHECK(r.noisy_blocks < r.blocks);
    CHECK(r.blocks == 9);
    int torn = 0;
    for (const PixelRange& block : blocks_of(scene.film.whole()))
        for (int y = block.y0; y < block.y1; ++y)
            for (int x = block.x0; x < block.x1; ++x)
                torn +=
                    samples[scene.film.whole().index(x, y)] != samples[scene.film.whole().index(block.x0, block.y0)];
    CHECK(torn == 0);
    // Without a limit, the film has no additional plane.
    CHECK(film_of(lamp_and_glass(0, 4), whole(scene)).settings().planes == Planes::by_default());
}

TEST_CASE("the same bits with any threads, in any crop, and after any interruptions") {
    const Scene scene = lamp_and_glass(0.08f, 100);
    const World world(scene);
    const Image one = render(world, scene, whole(scene, 1)).image;
    CHECK(equal_bits(one, render(world, scene, whole(scene, 3)).image));

    // A crop that cuts blocks: each pixel is as in the whole.
    RenderJob job = whole(scene);
    job.pixels = {5, 3, 18, 13};
    const Image crop = render(world, scene, job).image;
    REQUIRE(crop.width == 13);
    REQUIRE(crop.height == 10);
    CHECK(equal_bits(crop, part_of(one, 5, 3, 13, 10)));

    Uniform random(5);
    for (int repeat = 0; repeat < 5; ++repeat) {
        Film film = film_of(scene, whole(scene));
        int interruptions = 0;
        for (bool is_cancelled = true; is_cancelled; ++interruptions) {
            // Blocks that may begin before this run is cancelled.
            std::atomic<int> left = 1 + static_cast<int>(60 * random());
            RenderJob cut = whole(scene, 2);
            cut.cancelled = [&] { return left-- <= 0; };
            is_cancelled = render(world, scene, cut, film).cancelled;
        }
        CHECK(interruptions > 1);
        CHECK(equal_bits(one, film.image()));
    }

    Scene other = scene;
    other.settings.seed = 9;
    CHECK_FALSE(equal_bits(one, render(world, other, whole(other)).image));
}

TEST_CASE("the time that is over leaves the picture of as many samples as there was time for") {
    Scene scene = lamp_and_glass(0, 1 << 24);
    const World world(scene);
    RenderJob job = whole(scene);
    job.deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(300);
    const Rendering timed = render(world, scene, job);
    CHECK(timed.is_out_of_time);
    CHECK_FALSE(timed.cancelled);
    CHECK(timed.samples > 0);
    scene.settings.samples = timed.samples;
    CHECK(equal_bits(timed.image, render(world, scene, whole(scene)).image));
    // After the deadline, a render takes one sample per pixel, and continues with whole samples.
    job.deadline = std::chrono::steady_clock::now();
    scene.settings.samples = 1 << 24;
    Film film = film_of(scene, job);
    CHECK(render(world, scene, job, film).samples == 1);
    CHECK(render(world, scene, job, film).samples == 1);
}

// The difference between a picture that stops early and one with all samples and the same seed, whose expectation is
// the converged picture. Their first samples are the same, so differences far below the noise are visible.
TEST_CASE("no bias of a hundredth of the picture, nor of its half with the caustic") {
    constexpr int seeds = 60;
    Scene scene = lamp_and_glass(0, 128);
    const World world(scene);
    Moments difference, lit, all;
    std::uint64_t spent = 0, possible = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
        scene.settings.seed = static_cast<std::uint32_t>(seed);
        scene.settings.noise = 0;
        const Image full = render(world, scene, whole(scene)).image;
        scene.settings.noise = 0.12f;
        const Image stopped = render(world, scene, whole(scene)).image;
        for (const float n : samples_of(stopped)) spent += static_cast<std::uint64_t>(n);
        possible += 128 * stopped.pixels.size();
        const auto left = [](const Image& image) { return mean_luminance(part_of(image, 0, 8, 16, 11)); };
        all.add(mean_luminance(full));
        difference.add((mean_luminance(stopped) - mean_luminance(full)));
        lit.add((left(stopped) - left(full)) / left(full));
    }
    MESSAGE("bias ", difference.mean() / all.mean(), " +- ", difference.standard_error() / all.mean(), ", of the part ",
            lit.mean(), " +- ", lit.standard_error(), ", with ",
            100.0 * static_cast<double>(spent) / static_cast<double>(possible), " % of the samples");
    CHECK(spent < possible * 8 / 10);
    // There is a small bias, certainly below half a hundredth.
    const auto furthest = [](const Moments& m) { return std::abs(m.mean()) + 4 * m.standard_error(); };
    CHECK(furthest(difference) < 0.005 * all.mean());
    CHECK(furthest(lit) < 0.005);
}

}  // namespace test_noise_limit
