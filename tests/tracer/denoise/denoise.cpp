// Denoising: what it must preserve, how much noise it removes, and the same bits for any number of threads.
#include "denoise/denoise.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <cstring>

#include "denoise/features.hpp"
#include "film/film.hpp"
#include "film/half_plane.hpp"
#include "support/uniform.hpp"
#include "tracer/support/paths.hpp"

namespace test_denoise {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;
using phasetree::tests::Uniform;

namespace {

constexpr int width = 70, height = 50, samples = 64;
constexpr double sigma = 0.4;  // of a sample

// A test picture: its radiance without noise, and the albedo that guides the filter.
struct Truth {
    std::function<double(int x, int y)> radiance, albedo;
};

std::vector<float>& channel(Image& image, const std::string& name) {
    const auto found = std::ranges::find(image.extra_channels, name, &Channel::name);
    REQUIRE(found != image.extra_channels.end());
    return found->values;
}

// An image from a film with the planes for denoising. Its samples are uniformly distributed around the truth. If
// `are_rare`, they are black except for one in 32 on average, like those of a caustic that is found by chance.
Image made(const Truth& truth, double deviation, std::uint32_t seed, bool are_rare = false) {
    Image image = black_image({.width = width, .height = height}, {0, 0, width, height},
                              Planes::Sums(denoising_planes(), {}, 0).channels());
    Uniform random(seed);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto i = static_cast<std::size_t>(y * width + x);
            for (const int c : {0, 1, 2}) {
                double sum = 0, first = 0;
                for (int s = 0; s < samples; ++s) {
                    const double unit = std::sqrt(12.0) * (static_cast<double>(random()) - 0.5);
                    const double value = are_rare
                                             ? (static_cast<double>(random()) < 1.0 / 32) * 32 * truth.radiance(x, y)
                                             : truth.radiance(x, y) + deviation * unit;
                    sum += value;
                    if (HalfOfSamplesPlane::contains(static_cast<std::uint32_t>(s))) first += value;
                }
                image.pixels[i][c] = static_cast<float>(sum / samples);
                const char* const names[]{"half.R", "half.G", "half.B"};
                channel(image, names[c])[i] = static_cast<float>(first / (samples / 2));
            }
            for (const char* name : {"albedo.R", "half_albedo.R", "albedo_behind.R", "half_albedo_behind.R"})
                channel(image, name)[i] = static_cast<float>(truth.albedo(x, y));
            channel(image, "samples.X")[i] = samples;
            channel(image, "half_samples.X")[i] = samples / 2;
        }
    return image;
}

std::optional<std::vector<glm::vec3>> regressed(const Image& image) {
    return denoise(image, {.by = Denoiser::regression});
}

double error(const std::vector<glm::vec3>& pixels, const Truth& truth) {
    double sum = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (const int c : {0, 1, 2}) {
                const double off =
                    static_cast<double>(pixels[static_cast<std::size_t>(y * width + x)][c]) - truth.radiance(x, y);
                sum += off * off;
            }
    return std::sqrt(sum / (3 * width * height));
}

// A checked texture under slowly varying light. In one half of the samples, noise hides it.
double texture(int x, int y) {
    return (x / 3 + y / 3) % 2 == 0 ? 0.45 : 0.55;
}
const Truth textured{[](int x, int y) { return texture(x, y) * (0.7 + 0.005 * x + 0.003 * y); }, texture};

}  // namespace

TEST_CASE("noise on an even grey falls to less than a quarter") {
    const Truth grey{[](int, int) { return 0.5; }, [](int, int) { return 0.5; }};
    const Image image = made(grey, sigma, 1);
    const double before = error(image.pixels, grey);
    CHECK(before == doctest::Approx(sigma / std::sqrt(samples)).epsilon(0.05));
    CHECK(error(*regressed(image), grey) < before / 4);
}

TEST_CASE("a texture that the albedo shows keeps its edges, and loses its noise") {
    const Image image = made(textured, sigma, 2);
    const double guided = error(*regressed(image), textured);
    CHECK(guided < error(image.pixels, textured) / 2.5);
    // Without the albedo's help the filter takes it for noise.
    Truth blind = textured;
    blind.albedo = [](int, int) { return 0.5; };
    CHECK(error(*regressed(made(blind, sigma, 2)), textured) > 1.5 * guided);
}

TEST_CASE("the mean of the picture stays, also where bright samples are rare") {
    const auto mean_of = [](const std::vector<glm::vec3>& pixels) {
        double mean = 0;
        for (const glm::vec3& pixel : pixels) mean += static_cast<double>(pixel.g) / (width * height);
        return mean;
    };
    const Image image = made(textured, sigma, 3);
    CHECK(mean_of(*regressed(image)) == doctest::Approx(mean_of(image.pixels)).epsilon(0.002));
    // Pixels that chose similar ones by the same samples would choose dark ones.
    const Truth grey{[](int, int) { return 0.5; }, [](int, int) { return 0.5; }};
    const Image rare = made(grey, 0, 3, true);
    CHECK(mean_of(*regressed(rare)) == doctest::Approx(mean_of(rare.pixels)).epsilon(0.015));
}

TEST_CASE("halves of unequal size, and the variance that their difference tells of") {
    // The same at all pixels: three of four samples have the mean 2, and the fourth is 6, so the mean of all is 3.
    Image image = made(textured, 0, 1);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        image.pixels[i] = glm::vec3(3);
        channel(image, "half.G")[i] = 2;
        channel(image, "half_samples.X")[i] = 48;
        channel(image, "normal.Y")[i] = 3;
        channel(image, "half_normal.Y")[i] = 2;
    }
    const Halves halves = halves_of(image);
    CHECK(halves.shares.at(9, 7) == doctest::Approx(0.75));
    CHECK(halves.pictures[0].at(9, 7).mean[1] == doctest::Approx(2));
    CHECK(halves.pictures[1].at(9, 7).mean[1] == doctest::Approx(6));
    // (6 − 2)² is σ² (1/48 + 1/16), so σ²/64 is 3, σ²/48 is 4 and σ²/16 is 12.
    CHECK(halves.features.at(9, 7).variance[4] == doctest::Approx(3));
    CHECK(halves.pictures[0].at(9, 7).variance[1] == doctest::Approx(4));
    CHECK(halves.pictures[1].at(9, 7).variance[1] == doctest::Approx(12));
    // They are joined in the same way as they were divided.
    CHECK((*regressed(image))[200].g == doctest::Approx(3).epsilon(1e-4));
}

TEST_CASE("features lose their noise and keep their edges") {
    Grid<Estimate<feature_count>> features(width, height);
    Uniform random(8);
    const auto truth = [](int x) { return x < 30 ? 0.2 : 0.8; };
    constexpr double deviation = 0.02;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (std::size_t c = 0; c < feature_count; ++c) {
                const double unit = std::sqrt(12.0) * (static_cast<double>(random()) - 0.5);
                features.at(x, y).mean[c] = static_cast<float>(truth(x) + deviation * unit);
                features.at(x, y).variance[c] = static_cast<float>(deviation * deviation);
            }
    features.fill_margin();
    const PixelRange area{0, 0, width, height};
    const std::vector<Features> clean = without_noise(features, area);
    double sum = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (const float value : clean[area.index(x, y)])
                sum += std::pow(static_cast<double>(value) - truth(x), 2) / (width * height * feature_count);
    CHECK(std::sqrt(sum) < deviation / 3);
}

TEST_CASE("what has no noise stays as it is, a shadow's edge and a single bright pixel that no feature shows too") {
    const Truth shadow{[](int x, int y) { return x == 30 && y == 20 ? 50.0
                                                 : x + 2 * y < 80   ? 1.0
                                                                    : 0.25; },
                       [](int, int) { return 0.5; }};
    const std::vector<glm::vec3> clean = *regressed(made(shadow, 0, 4));
    double worst = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            worst = std::max(worst, std::abs(static_cast<double>(clean[static_cast<std::size_t>(y * width + x)].r) /
                                                 shadow.radiance(x, y) -
                                             1));
    CHECK(worst < 1e-4);
}

TEST_CASE("a glint that few samples found stays in its pixel") {
    const Truth grey{[](int, int) { return 0.5; }, [](int, int) { return 0.5; }};
    Image image = made(grey, sigma, 5);
    // One sample of 64, of the first half, was 60,000: the sun itself.
    const std::size_t at = 25 * width + 35;
    image.pixels[at] += glm::vec3(60000.0f / samples);
    for (const char* name : {"half.R", "half.G", "half.B"}) channel(image, name)[at] += 60000.0f / (samples / 2);
    std::vector<glm::vec3> clean = *regressed(image);
    CHECK(clean[at].g == doctest::Approx(60000.0f / samples).epsilon(0.002));
    clean[at] = glm::vec3(0.5f);
    CHECK(error(clean, grey) < error(made(grey, sigma, 5).pixels, grey) / 3.5);
    // In the black half of the picture, any light is much brighter than its surroundings, but is not a glint because of
    // that.
    const Truth half_black{[](int x, int) { return x < 35 ? 0.0 : 1.0; },
                           [](int x, int) { return x < 35 ? 0.2 : 0.8; }};
    Image dim = made(half_black, 0, 6);
    const std::size_t in_the_dark = 25 * width + 10;
    dim.pixels[in_the_dark] = glm::vec3(1);
    for (const char* name : {"half.R", "half.G", "half.B"}) channel(dim, name)[in_the_dark] = 2;
    CHECK((*regressed(dim))[in_the_dark].g < 0.5f);
}

TEST_CASE("the same bits with one thread and with several, and no less of a small part than of the whole") {
    const Image image = made(textured, sigma, 5);
    const std::vector<glm::vec3> one = *denoise(image, {.by = Denoiser::regression, .threads = 1}),
                                 several = *denoise(image, {.by = Denoiser::regression, .threads = 3});
    CHECK(std::memcmp(one.data(), several.data(), one.size() * sizeof one[0]) == 0);
    // A picture that is smaller than a window.
    const std::vector<glm::vec3> part = *regressed(part_of(image, 10, 10, 3, 2));
    CHECK(part.size() == 6);
    for (const glm::vec3& pixel : part) CHECK(std::isfinite(pixel.r + pixel.g + pixel.b));
}

TEST_CASE("it can be stopped, and says how far it is") {
    const Image image = made(textured, sigma, 6);
    std::atomic<int> asked = 0;
    CHECK_FALSE(denoise(image, {.by = Denoiser::regression, .cancelled = [&] { return ++asked > 3; }}));
    double last = 0;
    bool rises = true;
    REQUIRE(denoise(image, {.by = Denoiser::regression, .progress = [&](double done) {
                                rises = rises && done > last && done <= 1;
                                last = done;
                            }}));
    CHECK(rises);
    CHECK(last == 1);
}

TEST_CASE("a film that lacks a channel or samples is rejected") {
    Image image = made(textured, sigma, 7);
    Image lacking = image;
    std::erase_if(lacking.extra_channels, [](const Channel& c) { return c.name == "half_normal.Y"; });
    CHECK_THROWS_WITH_AS((void)regressed(lacking), doctest::Contains("half_normal.Y"), DenoiseError);
    channel(image, "half_samples.X")[99] = samples;
    CHECK_THROWS_WITH_AS((void)regressed(image), doctest::Contains("8 samples"), DenoiseError);
}

TEST_CASE("half of a render's samples are in the half, and with the others they make the whole") {
    Scene scene = scene_of(R"("glass": {"clear": {"ior": 1.5}})",
                           R"({"set": {"phase": "glass", "of": {"sphere": {"radius": 0.6}}}})",
                           R"("meshes": [{"floor": {"height": -0.7, "material": {"diffuse": {"color": "#808080"}}}}],
                              "lights": [{"constant": {"intensity": 1}}],
                              "camera": {"position": [0, -4, 2], "look_at": [0, 0, 0]},
                              "render": {"width": 12, "height": 9, "samples": 20})");
    scene.film.planes = denoising_planes();
    const World world(scene);
    RenderJob job;
    job.pixels = scene.film.whole();
    const auto image_of = [&](SampleRange range) {
        job.samples = range;
        Film film = film_of(scene, job);
        return render(world, scene, job, film).image;
    };
    // Of 20 samples, 0 to 3, 8 to 11 and 16 to 19 are in the half.
    Image all = image_of({0, 20});
    std::array<Image, 3> blocks{image_of({0, 4}), image_of({8, 12}), image_of({16, 20})};
    for (std::size_t i = 0; i < all.pixels.size(); ++i) {
        REQUIRE(channel(all, "half_samples.X")[i] == 12);
        float mean = 0, normal = 0;
        for (Image& block : blocks) {
            mean += block.pixels[i].g / 3;
            normal += channel(block, "normal_behind.Z")[i] / 3;
        }
        CHECK(channel(all, "half.G")[i] == doctest::Approx(mean).epsilon(1e-5));
        CHECK(channel(all, "half_normal_behind.Z")[i] == doctest::Approx(normal).epsilon(1e-5));
    }
    CHECK(regressed(all).has_value());
}

}  // namespace test_denoise
