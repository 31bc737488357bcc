// A file for each plane: the same channels, values and manifests as one file has of all.
#include "output/layers.hpp"

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <set>

#include "environment.hpp"
#include "film/cryptomatte.hpp"
#include "output/write.hpp"
#include "phasetree_support/temporary_directory.hpp"

namespace test_layers {

using namespace phasetree::tracer;
using namespace phasetree::support;
using namespace phasetree::tracer::test;

namespace {

const Metadata metadata{"scene.json", 4, 1};

// A crop, with all that planes may have.
Image image_with_planes() {
    Image image{13, 7, {}, Crop{2, 3, 40, 30}};
    float value = 0;
    for (int i = 0; i < 13 * 7; ++i) image.pixels.emplace_back(value += 0.25f, 2 * i, -i);
    for (const char* name :
         {"depth.Z", "normal.X", "normal.Y", "normal.Z", "light_sun.R", "light_lamp.R", "CryptoPhase00.R",
          "CryptoPhase00.G", "CryptoPhase01.R", "CryptoPhaseX.R", "CryptoObject00.R", "beauty.V", "a/b.X", "plain"}) {
        image.extra_channels.push_back({name, {}});
        for (int i = 0; i < 13 * 7; ++i) image.extra_channels.back().values.push_back(value += 0.25f);
    }
    for (const char* layer : {"CryptoPhase", "CryptoObject"})
        for (const auto& attribute : cryptomatte_attributes(layer, {"vacuum", layer}))
            image.attributes.push_back(attribute);
    image.attributes.emplace_back("phasetree:note", "of all");
    return image;
}

struct Read {
    OIIO::ImageSpec spec;
    std::map<std::string, std::vector<float>> channels{};
};

Read read(const std::filesystem::path& path) {
    const auto input = OIIO::ImageInput::open(path.string());
    REQUIRE_MESSAGE(input, path.string());
    Read file{input->spec()};
    for (int c = 0; c < file.spec.nchannels; ++c) {
        std::vector<float> values(file.spec.image_pixels());
        REQUIRE(input->read_image(0, 0, c, c + 1, OIIO::TypeDesc::FLOAT, values.data()));
        file.channels[file.spec.channelnames[static_cast<std::size_t>(c)]] = std::move(values);
    }
    return file;
}

}  // namespace

TEST_CASE("many files have together what one file has, under the same names") {
    const OcioVariable none;
    const TemporaryDirectory folder;
    const DisplayTransform transform(std::nullopt, std::nullopt, 0.0f);
    const Image image = image_with_planes();
    write_image(image, folder / "all.exr", metadata, transform);
    write_image(image, folder / "one.{plane}.exr", metadata, transform);
    const Read all = read(folder / "all.exr");
    std::map<std::string, std::vector<float>> channels;
    std::set<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        if (entry.path().filename() == "all.exr") continue;
        files.insert(entry.path().filename().string());
        const Read one = read(entry.path());
        for (const auto& [name, values] : one.channels) {
            CHECK_FALSE(channels.contains(name));
            channels[name] = values;
        }
        CHECK(one.spec.x == 2);
        CHECK(one.spec.y == 3);
        CHECK(one.spec.full_width == 40);
        CHECK(one.spec.full_height == 30);
        CHECK(one.spec.get_int_attribute("phasetree:samplesPerPixel") == 4);
    }
    const bool same = channels == all.channels;
    CHECK(same);
    CHECK(channels.size() == 3 + image.extra_channels.size());
    CHECK(files == std::set<std::string>{"one.CryptoObject.exr", "one.CryptoPhase.exr", "one.CryptoPhaseX.exr",
                                         "one.a_b.exr", "one.beauty.exr", "one.depth.exr", "one.light_lamp.exr",
                                         "one.light_sun.exr", "one.normal.exr", "one.plain.exr"});
}

TEST_CASE("a Cryptomatte has all ranks and its own manifest, and the others have none") {
    const Image image = image_with_planes();
    for (const Layer& layer : layers_of(image)) {
        CAPTURE(layer.name);
        const bool is_matte = layer.name == "CryptoPhase" || layer.name == "CryptoObject";
        if (!is_matte) {
            CHECK(layer.attributes.size() == (layer.has_picture ? 1 : 0));  // "of all"
            continue;
        }
        CHECK(layer.attributes.size() == 4);
        CHECK(layer.attributes == cryptomatte_attributes(layer.name, {"vacuum", layer.name}));
        CHECK(layer.channels.size() == (layer.name == "CryptoPhase" ? 3 : 1));
    }
}

TEST_CASE("where the file of one plane cannot be written the others are") {
    const OcioVariable none;
    const TemporaryDirectory folder;
    const DisplayTransform transform(std::nullopt, std::nullopt, 0.0f);
    std::filesystem::create_directory(folder / "a.normal.exr");
    const Image image = image_with_planes();
    const std::string message =
        message_of<OutputError>([&] { write_image(image, folder / "a.{plane}.exr", metadata, transform); });
    CHECK(message.find("a.normal.exr\"") != std::string::npos);
    CHECK(folder.size() == static_cast<std::ptrdiff_t>(layers_of(image).size()));
    CHECK(std::filesystem::exists(folder / "a.plain.exr"));  // the last
}

TEST_CASE("what {plane} cannot be in is rejected before there is an image") {
    const TemporaryDirectory folder;
    for (const char* name : {"a.{plane}.png", "{plane}/a.exr", "{plane}/{plane}.exr"}) {
        const std::string message = message_of<OutputError>([&] { check_writable(folder / name); });
        CHECK_MESSAGE(message.find("{plane}") != std::string::npos, message);
    }
    CHECK_NOTHROW(check_writable(folder / "a.{plane}.exr"));
    CHECK(folder.size() == 0);
}

}  // namespace test_layers
