// Images that scenes name: windows of OpenEXR files, rejected files, and files that claim wrong sizes, scans or
// samples, or are truncated.
#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "image/jpeg_header.hpp"
#include "image/read_image.hpp"
#include "image/texture_image.hpp"
#include "lights/load_environment.hpp"
#include "phasetree_support/temporary_directory.hpp"

namespace test_images {

using namespace phasetree::tracer;

namespace {

std::string big_endian(std::uint32_t n, int bytes) {
    std::string s;
    for (int i = bytes - 1; i >= 0; --i) s += static_cast<char>(n >> (8 * i));
    return s;
}

// A segment of a JPEG file.
std::string segment(int marker, const std::string& content) {
    return std::string{'\xff', static_cast<char>(marker)} +
           big_endian(static_cast<std::uint32_t>(content.size() + 2), 2) + content;
}

// A JPEG file of middle grey. Each block takes one bit for its mean, and a second one for everything else if the file
// is not progressive.
struct Jpeg {
    int width = 16, height = 16;
    bool is_progressive = true, has_tables = true;
    int scans = 1;
    std::string behind = {};

    std::string bytes() const {
        std::string s = "\xff\xd8" + segment(0xDB, std::string(1, '\0') + std::string(64, '\1'));
        s += segment(is_progressive ? 0xC2 : 0xC0, "\x08" + big_endian(static_cast<std::uint32_t>(height), 2) +
                                                       big_endian(static_cast<std::uint32_t>(width), 2) +
                                                       std::string{1, 1, 0x11, 0});
        // Tables of the means and of everything else, with one code each.
        for (const int kind : {0x00, 0x10})
            if (has_tables)
                s += segment(0xC4,
                             std::string{static_cast<char>(kind), 1} + std::string(15, '\0') + std::string(1, '\0'));
        const auto bits = static_cast<std::size_t>((width + 7) / 8 * ((height + 7) / 8) * (is_progressive ? 1 : 2));
        for (int i = 0; i < scans; ++i)
            s += segment(0xDA, std::string{1, 1, 0, 0, is_progressive ? '\0' : '\x3f', 0}) +
                 std::string(std::min<std::size_t>(bits / 8, 1000), '\0');
        return s + "\xff\xd9" + behind;
    }
};

// A PNG file of black pixels with a palette, one bit each.
std::string palette_png(std::uint32_t width, std::uint32_t height, std::uint32_t rows) {
    const auto chunk = [](const std::string& type, const std::string& data) {
        std::uint32_t crc = 0xffffffffu;
        for (const char c : type + data) {
            crc ^= static_cast<unsigned char>(c);
            for (int k = 0; k < 8; ++k) crc = crc & 1 ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
        }
        return big_endian(static_cast<std::uint32_t>(data.size()), 4) + type + data + big_endian(~crc, 4);
    };
    // Deflate's fixed codes: a zero, copies of 258 bytes before, and zeros again; and the end.
    const std::size_t count = rows * (width / 8 + 1);
    std::string data = "\x78\x9c";
    int used = 8;
    const auto put = [&](int code, int length) {
        for (int i = length - 1; i >= 0; --i, ++used) {
            if (used % 8 == 0) data += '\0';
            data.back() = static_cast<char>(data.back() | (code >> i & 1) << used % 8);
        }
    };
    put(0b110, 3);  // the last block, of fixed codes: its bits come lowest first
    put(0x30, 8);
    for (std::size_t i = 0; i < (count - 1) / 258; ++i) put(0b11000101, 8), put(0, 5);
    for (std::size_t i = 0; i < (count - 1) % 258; ++i) put(0x30, 8);
    put(0, 7);
    data += big_endian(static_cast<std::uint32_t>(count % 65521 << 16 | 1), 4);
    return "\x89PNG\r\n\x1a\n" +
           chunk("IHDR", big_endian(width, 4) + big_endian(height, 4) + std::string{1, 3, 0, 0, 0}) +
           chunk("PLTE", std::string("\0\0\0\xff\xff\xff", 6)) + chunk("IDAT", data) + chunk("IEND", "");
}

struct Read {
    std::string error;
    int begun = 0;
    ImageHeader header;
    std::vector<float> values;
};

// The image in memory or in a file. At most `most` pixels are requested.
Read read(const std::string& bytes, const char* file = nullptr, std::int64_t most = 1 << 24) {
    Read r;
    const auto begin = [&](const ImageHeader& header) {
        ++r.begun;
        r.header = header;
        if (std::int64_t{header.width} * header.height > most) throw std::runtime_error("it is not wanted");
        return 1;
    };
    const auto add = [&](std::span<const float> values) {
        r.values.insert(r.values.end(), values.begin(), values.end());
    };
    try {
        if (file == nullptr) {
            read_image_in_memory(bytes, "a", "image", begin, add);
        } else {
            const phasetree::support::TemporaryDirectory folder;
            phasetree::support::write_text(folder / file, bytes);
            read_image(folder / file, "image", begin, add);
        }
    } catch (const std::runtime_error& e) {
        const std::string text = e.what();
        r.error = text.substr(text.find("\": ") + 3);
    }
    return r;
}

// Also files whose names claim another format.
constexpr const char* places[]{nullptr, "a.jpg", "a.png"};

JpegHeader header_of(const std::string& bytes, std::size_t block) {
    std::size_t at = 0;
    return read_jpeg_header([&]() -> std::string_view {
        const std::string_view some = std::string_view(bytes).substr(std::min(at, bytes.size()), block);
        at += block;
        return some;
    });
}

}  // namespace

TEST_CASE("the markers of a JPEG file say what it is, in blocks of any size") {
    for (const bool is_progressive : {false, true})
        for (const std::size_t block : {1, 2, 7, 100'000}) {
            const JpegHeader h = header_of(
                Jpeg{.width = 300, .height = 200, .is_progressive = is_progressive, .scans = 3, .behind = "more"}
                    .bytes(),
                block);
            CHECK(h.width == 300);
            CHECK(h.height == 200);
            CHECK(h.components == 1);
            CHECK(h.bits == 8);
            CHECK(h.is_progressive == is_progressive);
            CHECK(h.scans == 3);
            CHECK(h.least_bytes == 38 * 25 / 8);
        }
}

TEST_CASE("a JPEG file is asked for its size before anything is decoded") {
    for (const char* const file : places) {
        CAPTURE(file);
        for (const bool is_progressive : {false, true}) {
            const Read good = read(Jpeg{.is_progressive = is_progressive, .behind = "bytes behind"}.bytes(), file);
            CHECK(good.error == "");
            CHECK(good.begun == 1);
            REQUIRE(good.values.size() == 256);
            CHECK(good.values[100] == doctest::Approx(128 / 255.0));
        }
        // Without tables it cannot be decoded, but its size is rejected before.
        const Jpeg huge{.width = 65500, .height = 65500, .has_tables = false};
        const Read refused = read(huge.bytes(), file);
        CHECK(refused.error == "it is not wanted");
        CHECK(refused.header.width == 65500);
        CHECK(refused.header.height == 65500);
        // Such a size requires bytes for its blocks.
        CHECK(read(huge.bytes(), file, std::int64_t{1} << 40).error ==
              "it is too short for the image size in its header");
    }
}

TEST_CASE("a JPEG file of very many scans is rejected") {
    CHECK(read(Jpeg{.scans = 100}.bytes()).error == "");
    for (const bool is_progressive : {false, true})
        for (const char* const file : places)
            CHECK(read(Jpeg{.is_progressive = is_progressive, .scans = 101}.bytes(), file).error ==
                  "it has more than 100 scans; save it as a baseline JPEG");
}

TEST_CASE("a JPEG file that is cut off is rejected, wherever that is") {
    for (const bool is_progressive : {false, true}) {
        const std::string whole = Jpeg{.is_progressive = is_progressive, .scans = 2}.bytes();
        for (std::size_t n = 2; n < whole.size(); ++n) {
            CAPTURE(n);
            CHECK(read(whole.substr(0, n)).error == "its image data are truncated");
        }
        CHECK(read(whole.substr(0, whole.size() - 2), "a.jpg").error == "its image data are truncated");
    }
    CHECK(read("\xff\xd8\xff\xd9").error == "it has no image");
}

TEST_CASE("JPEG files as programs write them have the size that OpenImageIO sees, also with any byte changed") {
    const phasetree::support::TemporaryDirectory folder;
    std::mt19937 random(1);
    for (const int channels : {1, 3}) {
        const std::string path = folder / "a.jpg";
        std::vector<unsigned char> values(static_cast<std::size_t>(37 * 21 * channels));
        for (unsigned char& v : values) v = static_cast<unsigned char>(random());
        const auto out = OIIO::ImageOutput::create(path);
        REQUIRE(out->open(path, OIIO::ImageSpec(37, 21, channels, OIIO::TypeDesc::UINT8)));
        REQUIRE(out->write_image(OIIO::TypeDesc::UINT8, values.data()));
        REQUIRE(out->close());
        std::ifstream file(path, std::ios::binary);
        const std::string bytes(std::istreambuf_iterator<char>(file), {});
        const Read whole = read(bytes);
        CHECK(whole.error == "");
        CHECK(whole.header.width == 37);
        CHECK(whole.header.channels == channels);
        int readable = 0;
        for (std::size_t i = 0; i < std::min<std::size_t>(bytes.size(), 700); ++i) {
            std::string changed = bytes;
            changed[i] = static_cast<char>(random());
            const Read r = read(changed, nullptr, 1000);
            readable += r.error.empty();
            CHECK(r.error != "the decoded image has a different size than its header declares");
        }
        CHECK(readable > 100);
    }
}

TEST_CASE("a PNG file of few bits and one colour is not too short, and a shortened one is") {
    const std::string png = palette_png(1024, 1024, 1024);
    REQUIRE(png.size() < 1024 * 1024 * 3 / 1032);
    for (const char* const file : places) {
        const Read good = read(png, file);
        CHECK(good.error == "");
        CHECK(good.values.size() == 1024 * 1024);
    }
    CHECK(read(palette_png(16384, 16384, 2), nullptr, 1 << 30).error ==
          "it is too short for the image size in its header");
}

namespace {

// Columns [x0, x1) and rows [y0, y1).
struct Box {
    int x0, y0, x1, y1;
    bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
};

// The value of a channel of the test pictures at a pixel; never 0.
float value_at(int x, int y, int channel) {
    return 1000.0f + static_cast<float>(x) + 64.0f * static_cast<float>(y) + 0.125f * static_cast<float>(channel);
}

// An OpenEXR file with these windows, of tiles unless `tile` is 0. The channels are red, green, blue and alpha, in the
// order of their letters in `order`.
void write_exr(const std::string& path, const Box& data, const Box& display, int tile = 0,
               const std::string& order = "RGBA", const std::string& compression = "zip") {
    OIIO::ImageSpec spec(data.x1 - data.x0, data.y1 - data.y0, static_cast<int>(order.size()), OIIO::TypeDesc::FLOAT);
    spec.x = data.x0, spec.y = data.y0;
    spec.full_x = display.x0, spec.full_y = display.y0;
    spec.full_width = display.x1 - display.x0, spec.full_height = display.y1 - display.y0;
    spec.tile_width = tile, spec.tile_height = tile / 2;
    spec.attribute("compression", compression);
    spec.channelnames.clear();
    for (const char c : order) spec.channelnames.emplace_back(1, c);
    std::vector<float> values;
    for (int y = data.y0; y < data.y1; ++y)
        for (int x = data.x0; x < data.x1; ++x)
            for (const char c : order) values.push_back(value_at(x, y, static_cast<int>(std::string("RGBA").find(c))));
    const auto out = OIIO::ImageOutput::create(path);
    REQUIRE(out->open(path, spec));
    REQUIRE(out->write_image(OIIO::TypeDesc::FLOAT, values.data()));
    REQUIRE(out->close());
}

// An OpenEXR file of these floats.
void write_floats(const std::string& path, int width, int height, int channels, const std::vector<float>& values) {
    const auto out = OIIO::ImageOutput::create(path);
    REQUIRE(out->open(path, OIIO::ImageSpec(width, height, channels, OIIO::TypeDesc::FLOAT)));
    REQUIRE(out->write_image(OIIO::TypeDesc::FLOAT, values.data()));
    REQUIRE(out->close());
}

// The message about a file, without its name.
template <class F>
std::string said(F&& f) {
    try {
        (void)f();
    } catch (const std::runtime_error& e) {
        const std::string text = e.what();
        return text.substr(std::min(text.find("\": ") + 3, text.size()));
    }
    return "nothing";
}

}  // namespace

TEST_CASE("what is read of an OpenEXR file is its display window, and 0 where it has no pixels") {
    const phasetree::support::TemporaryDirectory folder;
    const std::string path = folder / "a.exr";
    const Box display{10, -7, 74, 143};  // more rows than are read at a time
    const std::array<Box, 9> windows{display,
                                     Box{20, 0, 40, 10},        // within
                                     Box{20, 70, 40, 140},      // within, and more rows than are read at a time
                                     Box{-15, -40, 20, 30},     // beyond a corner
                                     Box{60, 100, 100, 250},    // beyond the opposite one
                                     Box{-10, -100, 101, 300},  // all around
                                     Box{200, 0, 210, 20},      // beside
                                     Box{20, -50, 30, -20},     // above
                                     Box{20, 400, 30, 420}};    // below
    for (const Box& data : windows)
        for (const int tile : {0, 16, 256})
            for (const ChannelRange channels : {ChannelRange(3), ChannelRange(1), ChannelRange(3, 1)}) {
                CAPTURE(data.x0);
                CAPTURE(data.y0);
                CAPTURE(tile);
                write_exr(path, data, display, tile, tile == 0 ? "ABGR" : "RGBA");
                std::vector<float> values;
                read_image(
                    path, "image",
                    [&](const ImageHeader& header) {
                        CHECK(header.width == 64);
                        CHECK(header.height == 150);
                        CHECK(header.channels == 4);
                        return channels;
                    },
                    [&](std::span<const float> rows) {
                        CHECK(rows.size() % static_cast<std::size_t>(64 * channels.count) == 0);
                        values.insert(values.end(), rows.begin(), rows.end());
                    });
                std::vector<float> wanted;
                for (int y = display.y0; y < display.y1; ++y)
                    for (int x = display.x0; x < display.x1; ++x)
                        for (int c = channels.first; c < channels.first + channels.count; ++c)
                            wanted.push_back(data.contains(x, y) ? value_at(x, y, c) : 0.0f);
                CHECK((values == wanted));
            }
}

TEST_CASE("an environment is the display window of its image, whatever part of it the file holds") {
    const phasetree::support::TemporaryDirectory folder;
    const std::string path = folder / "a.exr";
    write_exr(path, {22, 11, 42, 21}, {0, 0, 64, 32});
    const auto image = load_environment_image(path);
    CHECK(image->width == 64);
    CHECK(image->height == 32);
    int lit = 0;
    for (const glm::vec3& p : image->pixels) lit += p.x > 0;
    CHECK(lit == 20 * 10);
    CHECK(image->pixels[11 * 64 + 22].x == value_at(22, 11, 0));
    // The shape is that of the display window.
    write_exr(path, {0, 0, 64, 32}, {0, 0, 64, 64});
    CHECK(said([&] { return load_environment_image(path); }) ==
          "an environment map must be twice as wide as high, but this one has 64 × 64");
    // In a texture, too, alpha is 0 where there are no pixels.
    write_exr(path, {0, 0, 1, 1}, {0, 0, 2, 1});
    const auto alpha = load_texture_image(path, ImageMeaning::alpha);
    CHECK(alpha->pixels() == 2);
    CHECK(alpha->at({0.25f, 0.5f}).x == 1.0f);
    CHECK(alpha->at({0.75f, 0.5f}).x == 0.0f);
}

TEST_CASE("small files with huge windows are rejected by the limits of their use") {
    const phasetree::support::TemporaryDirectory folder;
    const std::string path = folder / "a.exr";
    // Sets the last column and row of a window in the file's header.
    const auto set_window = [&](const std::string& name, int column, int row) {
        std::string bytes = phasetree::support::bytes_of(path);
        const std::size_t at = bytes.find(name) + name.size() + 1 + std::strlen("box2i") + 1 + 4;
        const std::array<std::int32_t, 2> last{column, row};
        std::memcpy(bytes.data() + at + 8, last.data(), sizeof last);
        phasetree::support::write_text(path, bytes);
    };
    write_exr(path, {0, 0, 4, 2}, {0, 0, 4, 2});
    set_window("displayWindow", (1 << 29) - 1, (1 << 28) - 1);
    CHECK(said([&] { return load_environment_image(path); }) == "it is larger than 16384 × 8192");
    CHECK(said([&] { return load_texture_image(path); }) == "it is larger than 4096 × 4096");
    // The same for the data window, of which a few rows are in memory at a time.
    write_exr(path, {0, 0, 4, 32}, {0, 0, 4, 32});
    set_window("dataWindow", (1 << 20) - 1, 31);
    CHECK(said([&] { return load_texture_image(path); }) ==
          "its data window of 1048576 × 32 pixels is much larger than its display window of 4 × 32; crop it");
    // A data window whose area is not too large, but whose single row is. OpenEXR itself limits compressed rows.
    write_exr(path, {0, 0, 4, 1}, {0, 0, 4, 1}, 0, "R", "none");
    set_window("displayWindow", 16383, 8191);
    set_window("dataWindow", (1 << 28) - 1, 0);
    CHECK(said([&] { return load_environment_image(path); }) ==
          "a row of its data window of 268435456 × 1 pixels takes 1024 MB, but the limit is 512 MB; crop it");
    // OpenEXR itself rejects tiled files that are too short for their tables of tiles.
    write_exr(path, {0, 0, 4, 2}, {0, 0, 4, 2}, 16);
    set_window("dataWindow", (1 << 23) - 1, 3);
    CHECK(said([&] { return load_texture_image(path); }) != "nothing");
}

TEST_CASE("numbers that are not finite are rejected: how many pixels have them, and where the first is") {
    const phasetree::support::TemporaryDirectory folder;
    const std::string path = folder / "a.exr";
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const std::string repair =
        "(counted from 0 at the top left); repair the image, for example with: "
        "oiiotool IN.exr --fixnan box3 -o OUT.exr";
    const auto each_use = [&](const std::string& wanted) {
        CHECK(said([&] { return load_environment_image(path); }) == wanted);
        CHECK(said([&] { return load_texture_image(path); }) == wanted);
        CHECK(said([&] { return load_texture_image(path, ImageMeaning::numbers); }) == wanted);
    };
    // The largest 16-bit number is valid, and negative numbers are black.
    std::vector<float> values(200 * 100 * 3, 65504.0f);
    values[5] = -1;
    write_floats(path, 200, 100, 3, values);
    each_use("nothing");
    for (const float bad : {infinity, -infinity, std::numeric_limits<float>::quiet_NaN()}) {
        values[3 * (200 * 81 + 7) + 2] = bad;
        write_floats(path, 200, 100, 3, values);
        each_use("1 pixel is infinite or not a number, at column 7, row 81 " + repair);
    }
    std::fill_n(values.begin() + 3 * (200 * 20 + 199), 9, infinity);
    write_floats(path, 200, 100, 3, values);
    each_use("4 pixels are infinite or not a number, the first at column 199, row 20 " + repair);
    // Only channels that are used matter.
    write_floats(path, 2, 1, 4, {infinity, 0, 0, 0.5f, 0, 0, 0, 1});
    CHECK(said([&] { return load_texture_image(path, ImageMeaning::alpha); }) == "nothing");
    write_floats(path, 2, 1, 4, {0, 0, 0, infinity, 0, 0, 0, 1});
    CHECK(said([&] { return load_texture_image(path); }) == "nothing");
    CHECK(said([&] { return load_texture_image(path, ImageMeaning::alpha); }) ==
          "1 pixel is infinite or not a number, at column 0, row 0 " + repair);
}

TEST_CASE("an environment whose sum overflows is rejected, with its brightest pixel") {
    const phasetree::support::TemporaryDirectory folder;
    const std::string path = folder / "a.exr";
    std::vector<float> values(8 * 4 * 3, 1.0f);
    values[3 * (8 * 2 + 5) + 1] = 3e38f;
    write_floats(path, 8, 4, 3, values);
    CHECK_THROWS_WITH(
        (void)load_environment_image(path),
        ("cannot use the environment image \"" + path +
         "\": its radiance adds up to more than a float can hold; its largest value is 3e+38, at column 5, "
         "row 2 (counted from 0 at the top left); repair this pixel, or scale the image")
            .c_str());
}

TEST_CASE("a TIFF file that is a part of a larger picture is rejected") {
    const phasetree::support::TemporaryDirectory folder;
    const std::string path = folder / "a.tif";
    OIIO::ImageSpec spec(4, 2, 1, OIIO::TypeDesc::UINT8);
    const std::vector<unsigned char> values(8, 255);
    const auto write = [&] {
        const auto out = OIIO::ImageOutput::create(path);
        REQUIRE(out->open(path, spec));
        REQUIRE(out->write_image(OIIO::TypeDesc::UINT8, values.data()));
        REQUIRE(out->close());
    };
    write();
    CHECK(said([&] { return load_texture_image(path); }) == "nothing");
    spec.x = 3;
    spec.full_x = 0, spec.full_width = 10, spec.full_height = 5;
    write();
    CHECK(said([&] { return load_texture_image(path); }) ==
          "its 4 × 2 pixels are a crop of a 10 × 5 picture; save the whole picture, or save the crop as OpenEXR");
}

}  // namespace test_images
