// Planes of the film against closed forms, and Cryptomatte read back from a file by a reader that knows only the
// specification.
#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "film/channel_name.hpp"
#include "film/cryptomatte.hpp"
#include "output/environment.hpp"
#include "output/write.hpp"
#include "phasetree_support/temporary_directory.hpp"
#include "tracer/support/paths.hpp"

namespace test_planes {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

// A ball of radius 1 of clay in the middle, over a floor, seen from 5 m away; two groups of lights.
Scene ball(const std::string& camera = R"({"position": [0, -5, 0], "look_at": [0, 0, 0], "fov": 60})") {
    Scene scene = scene_of(
        R"("clay": {"diffuse": {"color": [0.6, 0.3, 0.2]}}, "a.b": {"clear": {"ior": 1.5}})",
        R"({"set": {"phase": "clay", "of": {"sphere": {"radius": 1}}}})",
        std::string(R"("meshes": [{"floor": {"height": -1.5, "material": {"diffuse": {"color": [0.5, 0.5, 0.5]}}}}],
                              "lights": [{"constant": {"group": "sky"}},
                                         {"rectangle": {"centre": [0, -3, 4], "target": [0, 0, 0], "width": 1, "height": 1, "radiance": [9, 9, 9]}}],
                              "render": {"width": 21, "height": 15, "samples": 8},
                              "camera": )") +
            camera);
    scene.film.planes = Planes::all();
    return scene;
}

// Not a std::string, because GCC 13 and later would mistake the result for a reference into a temporary.
const std::vector<float>& channel(const Image& image, const char* name) {
    for (const Channel& c : image.extra_channels)
        if (c.name == name) return c.values;
    FAIL("there is no channel " << name);
    throw std::logic_error("unreachable");
}

// Reads Cryptomatte as specified: the attributes cryptomatte/KEY/…, and the channels NAME00.R …, which are pairs of an
// ID and a coverage. Returns the coverages by names of the manifest, pixel by pixel.
struct Mattes {
    std::map<std::string, std::map<std::string, std::vector<float>>> layers;
    bool is_ranked = true;
    float most_sum = 0;
};

Mattes read_mattes(const std::string& path) {
    const auto input = OIIO::ImageInput::open(path);
    REQUIRE(input);
    const OIIO::ImageSpec spec = input->spec();
    const auto pixels = static_cast<std::size_t>(spec.width * spec.height);
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    std::vector<float> values(pixels * channels);
    REQUIRE(input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()));
    const auto value = [&](const std::string& name, std::size_t pixel) {
        const int c = spec.channelindex(name);
        REQUIRE(c >= 0);
        return values[pixel * channels + static_cast<std::size_t>(c)];
    };
    Mattes mattes;
    for (const auto& attribute : spec.extra_attribs) {
        const std::string key = attribute.name().string();
        if (!key.starts_with("cryptomatte/") || !key.ends_with("/name")) continue;
        const std::string prefix = key.substr(0, key.size() - 4), layer = attribute.get_string();
        CHECK(prefix.size() == std::string("cryptomatte/1234567/").size());
        CHECK(spec.get_string_attribute(prefix + "hash") == "MurmurHash3_32");
        CHECK(spec.get_string_attribute(prefix + "conversion") == "uint32_to_float32");
        std::map<std::uint32_t, std::string> names;
        const auto manifest = nlohmann::json::parse(spec.get_string_attribute(prefix + "manifest"));
        for (const auto& [name, hex] : manifest.items())
            names[static_cast<std::uint32_t>(std::stoul(hex.get<std::string>(), nullptr, 16))] = name;
        for (std::size_t p = 0; p < pixels; ++p) {
            float before = 1, sum = 0;
            for (int rank = 0; rank < 6; ++rank) {
                const std::string of = layer + "0" + std::to_string(rank / 2) + ".";
                const float id = value(of + (rank % 2 ? "B" : "R"), p), covers = value(of + (rank % 2 ? "A" : "G"), p);
                mattes.is_ranked = mattes.is_ranked && covers <= before;
                before = covers;
                sum += covers;
                if (covers == 0) continue;
                const auto name = names.find(std::bit_cast<std::uint32_t>(id));
                REQUIRE(name != names.end());
                auto& of_name = mattes.layers[layer][name->second];
                of_name.resize(pixels);
                of_name[p] = covers;
            }
            mattes.most_sum = std::max(mattes.most_sum, sum);
        }
    }
    return mattes;
}

}  // namespace

TEST_CASE("numbers of names: published values of the hash, and no exponent of a number that is none") {
    CHECK(murmur_hash3_32("") == 0);
    CHECK(murmur_hash3_32("hello") == 0x248bfa47u);
    CHECK(murmur_hash3_32("hello, world") == 0x149bbb7fu);
    CHECK(murmur_hash3_32("The quick brown fox jumps over the lazy dog") == 0x2e4ff723u);
    // The hashes with which the authors of the specification test their own readers.
    const std::map<std::string, float> floats{{"hello", 6.0705627102400005616e-17f},
                                              {"cube", -4.08461912519e+15f},
                                              {"sphere", 2.79018604383e+15f},
                                              {"plane", 3.66557617593e-11f},
                                              {"mädchen", 6.2361298211599995797e+25f}};
    for (const auto& [name, number] : floats)
        CHECK(std::bit_cast<float>(cryptomatte_id(name)) == doctest::Approx(number).epsilon(1e-7));
    int flipped = 0;
    for (int i = 0; i < 4000; ++i) {
        const std::string name = "name " + std::to_string(i);
        CHECK(std::isnormal(std::bit_cast<float>(cryptomatte_id(name))));
        if (const std::uint32_t other = cryptomatte_id(name) ^ murmur_hash3_32(name)) {
            CHECK(other == 1u << 23);
            ++flipped;
        }
    }
    CHECK(flipped > 5);  // 31 are expected
}

TEST_CASE("depth is along the axis, also where the middle of the picture or of the lens is beside it") {
    for (const char* const camera :
         {R"({"tilt_shift": {"position": [0, -5, 0], "look_at": [0, 0, 0], "fov": 60, "shift": [0.1, -0.3]}})",
          R"({"position": [0, -5, 0], "look_at": [0, 0, 0], "fov": 60, "lens_radius": 0.5, "blades": 5})"}) {
        CAPTURE(camera);
        const Scene scene = ball(camera);
        const World world(scene);
        const Image image = image_of(world, scene);
        const auto &depth = channel(image, "depth.Z"), &y = channel(image, "position.Y");
        int seen = 0;
        for (std::size_t p = 0; p < image.pixels.size(); ++p) {
            if (depth[p] == 1e10f) continue;
            ++seen;
            CHECK(depth[p] == doctest::Approx(y[p] + 5).epsilon(1e-5));
        }
        CHECK(seen > 100);
    }
}

TEST_CASE("a ball: depth, position, normal, albedo, numbers, lengths") {
    const Scene scene = ball();
    const World world(scene);
    const Image image = image_of(world, scene);
    REQUIRE(count_non_finite(image) == 0);
    const auto& depth = channel(image, "depth.Z");
    const auto &x = channel(image, "position.X"), &y = channel(image, "position.Y"), &z = channel(image, "position.Z");
    int on_ball = 0, on_floor = 0, nowhere = 0;
    for (std::size_t p = 0; p < image.pixels.size(); ++p) {
        CAPTURE(p);
        const float object = channel(image, "object.X")[p];
        if (object == -1) {
            ++nowhere;
            CHECK(depth[p] == 1e10f);
            continue;
        }
        // The camera looks along y, so the depth along its axis follows from y alone.
        CHECK(depth[p] == doctest::Approx(y[p] + 5).epsilon(1e-5));
        CHECK(channel(image, "phase_from.X")[p] == 0);
        CHECK(channel(image, "instance.X")[p] == 0);
        if (object == 0) {
            ++on_ball;
            CHECK(glm::length(glm::vec3(x[p], y[p], z[p])) == doctest::Approx(1).epsilon(1e-4));
            CHECK(channel(image, "phase_to.X")[p] == 1);
        } else {
            ++on_floor;
            CHECK(object == 1);
            // Points of meshes are recorded where rays leave them, with an offset of 10⁻⁵ of the largest coordinate or
            // of the object's diagonal.
            CHECK(std::abs(z[p] + 1.5f) <= 1.01e-5f * std::max({3.4642f, std::abs(x[p]), std::abs(y[p])}) + 2e-7f);
            CHECK(channel(image, "phase_to.X")[p] == -1);
        }
    }
    CHECK(on_ball > 20);
    CHECK(on_floor > 20);
    CHECK(nowhere > 20);
    // Only the ball is visible in the middle pixel, so the pixel's means are those of the ball's surface.
    const std::size_t middle = 7 * 21 + 10;
    CHECK(depth[middle] == doctest::Approx(4).epsilon(0.02));
    CHECK(channel(image, "normal.Y")[middle] == doctest::Approx(-1).epsilon(0.05));
    CHECK(channel(image, "albedo.R")[middle] == doctest::Approx(0.6).epsilon(1e-5));
    CHECK(channel(image, "albedo_behind.B")[middle] == doctest::Approx(0.2).epsilon(1e-5));
    CHECK(channel(image, "depth_behind.Z")[middle] == doctest::Approx(4).epsilon(0.05));
    CHECK(channel(image, "length_vacuum.X")[middle] == doctest::Approx(4).epsilon(0.05));
    CHECK(channel(image, "length_a_b.X")[middle] == 0);
    CHECK(channel(image, "samples.X")[middle] == 8);
    CHECK(channel(image, "variance.G")[middle] > 0);
}

TEST_CASE("parts of the light add up to the picture, and planes change none of its bits") {
    Scene scene = ball();
    const World world(scene);
    const Image image = image_of(world, scene);
    for (std::size_t p = 0; p < image.pixels.size(); ++p) {
        const float beauty = image.pixels[p].r;
        CHECK(channel(image, "direct.R")[p] + channel(image, "indirect.R")[p] == doctest::Approx(beauty).epsilon(1e-6));
        CHECK(channel(image, "light_default.R")[p] + channel(image, "light_sky.R")[p] ==
              doctest::Approx(beauty).epsilon(1e-6));
    }
    scene.film.planes = Planes::by_default();
    const Image alone = image_of(world, scene);
    CHECK(alone.extra_channels.empty());
    CHECK(alone.attributes.empty());
    CHECK(alone.pixels == image.pixels);
}

TEST_CASE("alpha: glass, lamps and what scatters cover the background, and what bends nothing does not") {
    // A ball of radius 1 in a picture of 4 by 4, so that it covers π/16 of it.
    const auto covered = [](const std::string& material, const std::string& lights) {
        Scene scene = scene_of(R"("m": )" + material, R"({"set": {"phase": "m", "of": {"sphere": {"radius": 1}}}})",
                               R"("lights": [{"constant": {}})" + lights + R"(], "background": [0, 0, 0],
            "camera": {"orthographic": {"position": [0, -5, 0], "look_at": [0, 0, 0], "height": 4, "filter": "box"}},
            "render": {"width": 48, "height": 48, "samples": 64})");
        scene.film.planes[Planes::index_of<AlphaPlane>()] = true;
        const Image image = image_of(World(scene), scene);
        const std::vector<float>& alpha = channel(image, "A");
        double sum = 0;
        for (const float a : alpha) {
            REQUIRE((a >= 0 && a <= 1));
            sum += static_cast<double>(a);
        }
        CHECK(alpha.front() == 0);
        return sum / static_cast<double>(alpha.size());
    };
    constexpr double ball_alone = std::numbers::pi / 16;
    CHECK(covered(R"({"diffuse": {"color": [0.5, 0.5, 0.5]}})", "") == doctest::Approx(ball_alone).epsilon(0.003));
    CHECK(covered(R"({"clear": {"ior": 1.5}})", "") == doctest::Approx(ball_alone).epsilon(0.003));
    CHECK(covered(R"({"clear": {"ior": 1}})", "") == 0);
    // Almost all rays through the dense middle are scattered.
    const double milk = covered(R"({"clear": {"ior": 1, "scattering": [9, 9, 9]}})", "");
    CHECK(milk > 0.9 * ball_alone);
    CHECK(milk < 0.999 * ball_alone);
    CHECK(covered(R"({"clear": {"ior": 1}})", R"(, {"sphere": {"centre": [0, 2, 0], "radius": 0.5}})") ==
          doctest::Approx(ball_alone / 4).epsilon(0.003));
}

TEST_CASE("Cryptomatte, as a file's reader sees it") {
    const Scene scene = ball();
    const World world(scene);
    const Image image = image_of(world, scene);
    const phasetree::support::TemporaryDirectory folder;
    const test::OcioVariable unset;
    const std::string file = (folder / "planes.exr").string();
    write_image(image, file, {"scene.json", 8, 0}, DisplayTransform(std::nullopt, std::nullopt, 0));
    const Mattes mattes = read_mattes(file);
    CHECK(mattes.is_ranked);
    CHECK(mattes.most_sum <= 1);
    REQUIRE(mattes.layers.size() == 3);
    const auto& phases = mattes.layers.at("CryptoPhase");
    const auto& objects = mattes.layers.at("CryptoObject");
    const auto& materials = mattes.layers.at("CryptoMaterial");
    CHECK(phases.size() == 1);
    REQUIRE(objects.contains("object"));
    REQUIRE(objects.contains("floor"));
    CHECK(phases.at("clay") == objects.at("object"));
    CHECK(materials.at("clay") == objects.at("object"));
    CHECK(materials.at("floor") == objects.at("floor"));
    // The ball's matte covers its disc: the cone of half angle asin(1/5) on a film at the distance of 1 is a disc of
    // radius 1/√24, and a pixel's side is 2 tan 30°/15 there.
    double covered = 0;
    int mixed = 0;
    for (const float c : objects.at("object")) {
        covered += static_cast<double>(c);
        mixed += c > 0 && c < 1 ? 1 : 0;
    }
    CHECK(mixed > 5);
    const double side = 2 * std::tan(3.14159265358979 / 6) / 15;
    CHECK(covered == doctest::Approx(3.14159265358979 / 24 / (side * side)).epsilon(0.03));
}

TEST_CASE("channels of names that are alike once they are plain") {
    CHECK(channel_names("length_", {"vacuum", "a.b", "a b", "ä"}, ".X") ==
          std::vector<std::string>{"length_vacuum.X", "length_a_b.X", "length_a_b_2.X", "length___.X"});
}

}  // namespace test_planes
