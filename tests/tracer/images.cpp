// Images that scenes name, as files claim them: sizes, scans and samples, and files that are cut off.
#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "image/jpeg_header.hpp"
#include "image/read_image.hpp"
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

// A JPEG file of middle grey. Each block takes a bit for its mean, and a second one for all else if the file is not
// progressive.
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
        // Tables of the means and of all else, with one code each.
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

// A PNG file of black pixels of a palette, of one bit each.
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

// The image in memory or in a file. A `most` of pixels that are wanted.
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

// Files by names that say otherwise, too.
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
        // Without tables it cannot be decoded, and is refused by its size all the same.
        const Jpeg huge{.width = 65500, .height = 65500, .has_tables = false};
        const Read refused = read(huge.bytes(), file);
        CHECK(refused.error == "it is not wanted");
        CHECK(refused.header.width == 65500);
        CHECK(refused.header.height == 65500);
        // Who wants it must have bytes for its blocks.
        CHECK(read(huge.bytes(), file, std::int64_t{1} << 40).error == "it is too short for the size that it claims");
    }
}

TEST_CASE("a JPEG file of very many scans is refused") {
    CHECK(read(Jpeg{.scans = 100}.bytes()).error == "");
    for (const bool is_progressive : {false, true})
        for (const char* const file : places)
            CHECK(read(Jpeg{.is_progressive = is_progressive, .scans = 101}.bytes(), file).error ==
                  "it has more than a hundred scans; save it as a JPEG of one scan");
}

TEST_CASE("a JPEG file that is cut off is refused, wherever that is") {
    for (const bool is_progressive : {false, true}) {
        const std::string whole = Jpeg{.is_progressive = is_progressive, .scans = 2}.bytes();
        for (std::size_t n = 2; n < whole.size(); ++n) {
            CAPTURE(n);
            CHECK(read(whole.substr(0, n)).error == "it ends before its image does");
        }
        CHECK(read(whole.substr(0, whole.size() - 2), "a.jpg").error == "it ends before its image does");
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
            CHECK(r.error != "it decodes to another size than its header says");
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
    CHECK(read(palette_png(16384, 16384, 2), nullptr, 1 << 30).error == "it is too short for the size that it claims");
}

}  // namespace test_images
