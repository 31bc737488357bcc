// Pictures in files of all formats: their numbers, channels, tags and codes.
#include "output/write.hpp"

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <thread>

#include "environment.hpp"
#include "image/read_image.hpp"
#include "output/file.hpp"
#include "phasetree/version.hpp"
#include "phasetree_support/temporary_directory.hpp"
#include "phasetree_support/whole_file.hpp"
#include "pictures.hpp"

namespace test_write {

namespace fs = std::filesystem;
using namespace phasetree::tracer;
using namespace phasetree::support;
using namespace phasetree::tracer::test;

namespace {

OIIO::ImageSpec spec_of(const fs::path& path) {
    const auto input = OIIO::ImageInput::open(path.string());
    REQUIRE(input);
    return input->spec();
}

template <class T>
std::vector<T> values_of(const fs::path& path, OIIO::TypeDesc type) {
    const auto input = OIIO::ImageInput::open(path.string());
    REQUIRE(input);
    CHECK(input->spec().format == type);
    CHECK(input->spec().nchannels == 3);
    std::vector<T> values(input->spec().image_pixels() * 3);
    REQUIRE(input->read_image(0, 0, 0, 3, type, values.data()));
    return values;
}

double srgb(double v) {
    return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
}

}  // namespace

TEST_CASE("EXR keeps every bit of every float") {
    const OcioVariable none;
    const TemporaryDirectory folder;
    Image image = noise(67, 35);
    std::size_t i = 0;
    using limits = std::numeric_limits<float>;
    for (const float v : {-0.0f, -1.5f, limits::denorm_min(), -limits::denorm_min(), limits::min() / 3, limits::max(),
                          limits::lowest(), 1e30f, 65504.0f, 65536.0f, 1.0f + limits::epsilon(), limits::infinity(),
                          -limits::infinity(), limits::quiet_NaN()}) {
        image.pixels[i++ * 7] = glm::vec3(v, 0.5f, -v);
    }
    write_image(image, folder / "a.exr", metadata, DisplayTransform(std::nullopt, std::nullopt, 3.0f));
    const auto values = values_of<float>(folder / "a.exr", OIIO::TypeDesc::FLOAT);
    REQUIRE(values.size() == image.pixels.size() * 3);
    CHECK(std::memcmp(values.data(), image.pixels.data(), values.size() * sizeof(float)) == 0);
    CHECK(count_non_finite(image) == 3);
}

TEST_CASE("EXR keeps further channels under their names, other formats leave them out") {
    const OcioVariable none;
    const TemporaryDirectory folder;
    const DisplayTransform transform(std::nullopt, std::nullopt, 0.0f);
    const Image plain = noise(31, 17);
    Image image = plain;
    image.extra_channels = {{"depth.Z", {}}, {"a.b", {}}};
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        image.extra_channels[0].values.push_back(static_cast<float>(i));
        image.extra_channels[1].values.push_back(-1.0f / static_cast<float>(i + 1));
    }
    write_image(image, folder / "a.exr", metadata, transform);
    const auto input = OIIO::ImageInput::open((folder / "a.exr").string());
    REQUIRE(input);
    const OIIO::ImageSpec& spec = input->spec();
    REQUIRE(spec.nchannels == 5);
    std::vector<float> values(image.pixels.size() * 5);
    REQUIRE(input->read_image(0, 0, 0, 5, OIIO::TypeDesc::FLOAT, values.data()));
    int different = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const auto value = [&](const char* name) {
            return values[i * 5 + static_cast<std::size_t>(spec.channelindex(name))];
        };
        different += glm::vec3(value("R"), value("G"), value("B")) != image.pixels[i] ||
                     value("depth.Z") != image.extra_channels[0].values[i] ||
                     value("a.b") != image.extra_channels[1].values[i];
    }
    CHECK(different == 0);
    for (const Format format : {Format::png, Format::jpeg, Format::tiff}) {
        const bool same = encode(image, format, metadata, transform) == encode(plain, format, metadata, transform);
        CHECK(same);
    }
    image.extra_channels[1].values.pop_back();
    CHECK_THROWS_AS(encode(image, Format::exr, metadata, transform), std::invalid_argument);
}

TEST_CASE("PNG and TIFF have alpha, and the colours of what covers the background; JPEG has neither") {
    const OcioVariable none;
    const TemporaryDirectory folder;
    const DisplayTransform transform(std::nullopt, "Standard", 0.0f);
    // A colour over black, with alpha from 0 to 1.
    const glm::vec3 colour(0.8f, 0.4f, 0.1f);
    Image image{64, 4, {}};
    image.extra_channels = {{"A", {}}};
    for (int i = 0; i < 64 * 4; ++i) {
        const float alpha = static_cast<float>(i % 64) / 63.0f;
        image.pixels.push_back(alpha * colour);
        image.extra_channels[0].values.push_back(alpha);
    }
    for (const char* const name : {"a.png", "a.tif"}) {
        CAPTURE(name);
        write_image(image, folder / name, metadata, transform);
        // Asked for as it is in the file: OpenImageIO multiplies colours by alpha otherwise.
        OIIO::ImageSpec as_stored;
        as_stored.attribute("oiio:UnassociatedAlpha", 1);
        const auto input = OIIO::ImageInput::open((folder / name).string(), &as_stored);
        REQUIRE(input);
        REQUIRE(input->spec().nchannels == 4);
        CHECK(input->spec().alpha_channel == 3);
        std::vector<float> values(image.pixels.size() * 4);
        REQUIRE(input->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, values.data()));
        // One code of eight bits, by which dithering rounds up or down.
        constexpr double code = 1.0 / 255 + 1e-6;
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const double alpha = static_cast<double>(image.extra_channels[0].values[i]);
            CHECK(std::abs(static_cast<double>(values[4 * i + 3]) - alpha) < code);
            for (int c = 0; c < 3; ++c) {
                const double expected = alpha > 0 ? srgb(static_cast<double>(colour[c])) : 0.0;
                CHECK(std::abs(static_cast<double>(values[4 * i + static_cast<std::size_t>(c)]) - expected) < code);
            }
        }
    }
    // Over a background that shines nobody knows the colour of what covers it in part: there is no alpha.
    Image without = image;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        without.pixels[i] += (1.0f - image.extra_channels[0].values[i]) * glm::vec3(0.5f);
    write_image(without, folder / "b.png", metadata, transform);
    CHECK(spec_of(folder / "b.png").nchannels == 3);
    without = image;
    without.extra_channels.clear();
    CHECK((encode(image, Format::jpeg, metadata, transform) == encode(without, Format::jpeg, metadata, transform)));
}

TEST_CASE("equal pictures are equal files, whenever they are written") {
    const OcioVariable none;
    const TemporaryDirectory folder;
    const Image image = noise(61, 40);
    const DisplayTransform transform;
    std::array<std::string, names.size()> first;
    for (std::size_t i = 0; i < names.size(); ++i) {
        write_image(image, folder / names[i], metadata, transform);
        first[i] = bytes_of(folder / names[i]);
        CHECK(first[i].size() > 1000);
        CHECK(spec_of(folder / names[i]).get_string_attribute("DateTime").empty());
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // file formats count whole seconds
    for (std::size_t i = 0; i < names.size(); ++i) {
        write_image(image, folder / names[i], metadata, transform);
        CHECK_MESSAGE(bytes_of(folder / names[i]) == first[i], names[i]);
    }
    Image other = image;
    other.pixels[100].g = std::nextafter(other.pixels[100].g, 9.0f);
    write_image(other, folder / "a.exr", metadata, transform);
    CHECK(bytes_of(folder / "a.exr") != first[0]);
}

TEST_CASE("EXR tells how it was made and what its numbers mean") {
    const OcioVariable none;
    const TemporaryDirectory folder;
    // It holds linear light, so it needs no display transform.
    CHECK_FALSE(needs_display("a.exr"));
    for (const char* shown : {"a.png", "a.jpg", "a.TIF"}) CHECK(needs_display(shown));
    write_image(noise(8, 6), folder / "a.exr", metadata, std::nullopt);
    const OIIO::ImageSpec spec = spec_of(folder / "a.exr");
    CHECK(std::string(spec.get_string_attribute("Software")) == std::string("phasetree ") + phasetree::build_id());
    CHECK(spec.get_string_attribute("phasetree:scene") == "hourglass.json");
    CHECK(spec.get_int_attribute("phasetree:samplesPerPixel") == 128);
    CHECK(spec.get_string_attribute("phasetree:seed") == "18446744073709551615");
    CHECK(spec.get_string_attribute("compression") == "zip");
    CHECK(spec.get_string_attribute("oiio:ColorSpace") == "Linear");
    CHECK(spec.channelnames == std::vector<std::string>{"R", "G", "B"});
    const OIIO::ParamValue* chromaticities = spec.find_attribute("chromaticities");
    REQUIRE(chromaticities);
    const std::array<float, 8> rec709{0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
    CHECK(std::memcmp(chromaticities->data(), rec709.data(), sizeof rec709) == 0);
}

TEST_CASE("a crop is EXR's data window, and elsewhere the same codes as in the whole picture") {
    const OcioVariable none;
    const TemporaryDirectory folder;
    const Image whole = noise(40, 30);
    Image crop{9, 5, {}, Crop{13, 21, 40, 30}};
    for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 9; ++x) crop.pixels.push_back(whole.pixels[(y + 21) * 40 + x + 13]);
    }
    const DisplayTransform transform;
    write_image(crop, folder / "crop.exr", metadata, transform);
    const OIIO::ImageSpec spec = spec_of(folder / "crop.exr");
    CHECK(spec.x == 13);
    CHECK(spec.y == 21);
    CHECK(spec.width == 9);
    CHECK(spec.height == 5);
    CHECK(spec.full_x == 0);
    CHECK(spec.full_y == 0);
    CHECK(spec.full_width == 40);
    CHECK(spec.full_height == 30);
    // As an image of a scene it is the whole picture, black where it was not rendered.
    std::vector<glm::vec3> read;
    read_image(
        folder / "crop.exr", "image", [](const ImageHeader&) { return 3; },
        [&](std::span<const float> values) {
            for (std::size_t i = 0; i < values.size(); i += 3)
                read.emplace_back(values[i], values[i + 1], values[i + 2]);
        });
    REQUIRE(read.size() == whole.pixels.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
        const bool is_rendered = i % 40 >= 13 && i % 40 < 22 && i / 40 >= 21 && i / 40 < 26;
        CHECK(read[i] == (is_rendered ? whole.pixels[i] : glm::vec3(0)));
    }

    write_image(whole, folder / "whole.png", metadata, transform);
    write_image(crop, folder / "crop.png", metadata, transform);
    const auto all = values_of<std::uint8_t>(folder / "whole.png", OIIO::TypeDesc::UINT8);
    const auto part = values_of<std::uint8_t>(folder / "crop.png", OIIO::TypeDesc::UINT8);
    REQUIRE(part.size() == 9 * 5 * 3);
    int different = 0;
    for (int y = 0; y < 5; ++y) {
        for (int i = 0; i < 27; ++i) different += part[y * 27 + i] != all[((y + 21) * 40 + 13) * 3 + i];
    }
    CHECK(different == 0);

    crop.crop->x0 = 32;
    CHECK_THROWS_AS(write_image(crop, folder / "crop.exr", metadata, transform), std::invalid_argument);
    crop.pixels.pop_back();
    CHECK_THROWS_AS(write_image(crop, folder / "crop.exr", metadata, transform), std::invalid_argument);
    CHECK(folder.size() == 3);
}

TEST_CASE("the Standard view of a PNG is the sRGB curve within one code") {
    const OcioVariable none;
    const TemporaryDirectory folder;
    Image image{256, 256, {}};
    for (int i = 0; i < 65536; ++i) image.pixels.emplace_back(static_cast<float>(i) / 65535.0f);
    const DisplayTransform standard(std::nullopt, "Standard");
    write_image(image, folder / "a.png", metadata, standard);
    const auto codes = values_of<std::uint8_t>(folder / "a.png", OIIO::TypeDesc::UINT8);
    double worst = 0.0;
    bool neutral = true;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        worst = std::max(worst, std::abs(codes[3 * i] - 255.0 * srgb(static_cast<double>(i) / 65535.0)));
        neutral = neutral && codes[3 * i] == codes[3 * i + 1] && codes[3 * i] == codes[3 * i + 2];
    }
    CHECK(worst < 1.0);
    CHECK(neutral);
    CHECK(codes.front() == 0);
    CHECK(codes.back() == 255);

    // sRGB(0.5) is code 187.516: both neighbours, in the proportion that gives this mean.
    write_image(flat(64, 64, glm::vec3(0.5f)), folder / "half.png", metadata, standard);
    double sum = 0.0;
    for (const int code : values_of<std::uint8_t>(folder / "half.png", OIIO::TypeDesc::UINT8)) {
        CHECK((code == 187 || code == 188));
        sum += code;
    }
    // 1/256 for the levels of the threshold, as much again for the discrepancy of 4096 points of the recurrence.
    CHECK(sum / (64 * 64 * 3) == doctest::Approx(255.0 * srgb(0.5)).epsilon(2.0 / 256.0 / 187.0));

    write_image(flat(8, 8, glm::vec3(0.5f)), folder / "half.tiff", metadata, standard);
    for (const int code : values_of<std::uint16_t>(folder / "half.tiff", OIIO::TypeDesc::UINT16)) {
        CHECK(std::abs(code - 65535.0 * srgb(0.5)) < 1.5);
    }
}

TEST_CASE("exposure brightens what is displayed by powers of two") {
    const OcioVariable none;
    const TemporaryDirectory folder;
    write_image(flat(8, 8, glm::vec3(0.1f)), folder / "a.tif", metadata,
                DisplayTransform(std::nullopt, "Standard", 2.0f));
    const auto codes = values_of<std::uint16_t>(folder / "a.tif", OIIO::TypeDesc::UINT16);
    CHECK(std::abs(codes[0] - 65535.0 * srgb(0.4)) < 1.5);
}

TEST_CASE("pixels that are no numbers are black in eight bits and harm no neighbour") {
    const OcioVariable none;
    const TemporaryDirectory folder;
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Image image = flat(16, 16, glm::vec3(0.5f));
    image.pixels[3] = glm::vec3(std::nanf(""), 1.0f, 1.0f);
    image.pixels[4] = glm::vec3(1.0f, infinity, 1.0f);
    image.pixels[5] = glm::vec3(-infinity);
    image.pixels[6] = glm::vec3(std::numeric_limits<float>::max());
    image.pixels[7] = glm::vec3(std::numeric_limits<float>::lowest());
    CHECK(count_non_finite(image) == 3);
    for (const char* view : {"Photographic", "ACES 1.0 SDR", "Standard", "Raw"}) {
        write_image(image, folder / "a.png", metadata, DisplayTransform(std::nullopt, view, 100.0f));
        const auto codes = values_of<std::uint8_t>(folder / "a.png", OIIO::TypeDesc::UINT8);
        for (int i = 0; i < 16 * 16; ++i) {
            const int expected = (i >= 3 && i <= 5) || i == 7 ? 0 : 255;
            for (int c = 0; c < 3; ++c) CHECK_MESSAGE(codes[3 * i + c] == expected, view << " " << i);
        }
    }
}

TEST_CASE("PNG is tagged sRGB, JPEG is fine") {
    const OcioVariable none;
    const TemporaryDirectory folder;
    const Image image = noise(32, 32);
    write_image(image, folder / "a.PNG", metadata, DisplayTransform());
    const std::string srgb_chunk("\0\0\0\1sRGB", 8);  // its length and type
    CHECK(contains(bytes_of(folder / "a.PNG"), srgb_chunk));
    CHECK_FALSE(contains(bytes_of(folder / "a.PNG"), "tIME"));
    CHECK(contains(spec_of(folder / "a.PNG").get_string_attribute("ImageDescription"), "hourglass.json"));

    write_image(image, folder / "a.jpeg", metadata, DisplayTransform());
    CHECK(spec_of(folder / "a.jpeg").get_string_attribute("jpeg:subsampling") == "4:4:4");
    // The first quantisation table begins with that of the standard, 16, scaled: (16 · (200 − 2 · 95) + 50) / 100 = 2.
    const std::string bytes = bytes_of(folder / "a.jpeg");
    const std::size_t table = bytes.find("\xff\xdb");
    REQUIRE(table != std::string::npos);
    CHECK(static_cast<int>(bytes[table + 5]) == 2);
}

}  // namespace test_write
