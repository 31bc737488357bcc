// Labels from stacks of images, and messages about stacks that cannot be used.
#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "phasetree/io/error.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree_support/temporary_directory.hpp"
#include "scene/read_parts.hpp"
#include "volume/read_volume.hpp"

namespace test_image_stack {

using namespace phasetree;

namespace {

namespace fs = std::filesystem;

class Stack {
  public:
    template <class T>
    void write(const std::string& name, int width, int height, const std::vector<T>& values, int channels = 1) {
        const std::string path = (directory_.path() / name).string();
        const auto out = OIIO::ImageOutput::create(path);
        const auto type = OIIO::BaseTypeFromC<T>::value;
        REQUIRE(out);
        REQUIRE(out->open(path, OIIO::ImageSpec(width, height, channels, type)));
        REQUIRE(out->write_image(type, values.data()));
        out->close();
    }
    fs::path path(const std::string& name) const { return directory_.path() / name; }
    std::string said_of(const std::string& name) const {
        try {
            (void)tracer::read_label_grid(path(name), "");
        } catch (const std::runtime_error& e) {
            std::string text = e.what();
            // Of the path its name is enough.
            for (std::size_t at = text.find(directory_.path().string()); at != std::string::npos;
                 at = text.find(directory_.path().string()))
                text.erase(at, directory_.path().string().size() + 1);
            return text;
        }
        return "nothing";
    }

  private:
    support::TemporaryDirectory directory_;
};

using Bytes = std::vector<unsigned char>;

}  // namespace

TEST_CASE("images are layers of voxels, the first row at the largest y") {
    Stack stack;
    for (const char* ending : {"png", "tif"}) {
        CAPTURE(ending);
        for (int z = 0; z < 3; ++z) {
            Bytes values;
            for (int i = 0; i < 6; ++i) values.push_back(static_cast<unsigned char>(10 * z + i));
            stack.write((z == 0 ? "s_009." : z == 1 ? "s_010." : "s_011.") + std::string(ending), 3, 2, values);
        }
        const LabelGrid grid = tracer::read_label_grid(stack.path("s_###." + std::string(ending)), "");
        CHECK(grid.lattice.size == std::array{3, 2, 3});
        REQUIRE(grid.voxels.size() == 18);
        CHECK_FALSE(grid.has_spacing);
        for (int z = 0; z < 3; ++z)
            for (int y = 0; y < 2; ++y)
                for (int x = 0; x < 3; ++x) {
                    const auto at = static_cast<std::size_t>(x + 3 * (y + 2 * z));
                    CHECK(grid.numbers[grid.voxels[at]] == 10 * z + 3 * (1 - y) + x);
                }
    }
}

TEST_CASE("all numbers of 8 and of 16 bits are what they were") {
    Stack stack;
    Bytes bytes(256);
    for (std::size_t i = 0; i < 256; ++i) bytes[i] = static_cast<unsigned char>(i);
    stack.write("bytes.png", 256, 1, bytes);
    const LabelGrid of_bytes = tracer::read_label_grid(stack.path("bytes.png"), "");
    for (std::size_t i = 0; i < 256; ++i) CHECK(of_bytes.numbers[of_bytes.voxels[i]] == static_cast<int>(i));
    for (int first = 0; first < 65536; first += 251) {
        std::vector<unsigned short> words;
        for (int i = 0; i < 251; ++i) words.push_back(static_cast<unsigned short>(std::min(first + i, 65535)));
        stack.write("words.tif", 251, 1, words);
        const LabelGrid of_words = tracer::read_label_grid(stack.path("words.tif"), "");
        for (std::size_t i = 0; i < 251; ++i) REQUIRE(of_words.numbers[of_words.voxels[i]] == words[i]);
    }
}

TEST_CASE("labels of any other kind of integers are what they were") {
    Stack stack;
    const auto numbers_in = [&](const std::string& name) {
        const LabelGrid grid = tracer::read_label_grid(stack.path(name), "");
        std::vector<std::int32_t> numbers;
        for (const std::uint8_t v : grid.voxels) numbers.push_back(grid.numbers[v]);
        return numbers;
    };
    stack.write<short>("signed.tif", 5, 1, {-32768, -1, 0, 1, 32767});
    CHECK(numbers_in("signed.tif") == std::vector<std::int32_t>{-32768, -1, 0, 1, 32767});
    stack.write<char>("small.tif", 4, 1, {'\x80', '\xff', '\x01', '\x7f'});
    CHECK(numbers_in("small.tif") == std::vector<std::int32_t>{-128, -1, 1, 127});
    for (int first = 0; first < 1 << 20; first += 40'009) {
        std::vector<unsigned> words;
        std::vector<int> signed_words;
        std::vector<std::int32_t> expected;
        for (int i = 0; i < 200; ++i) {
            words.push_back(static_cast<unsigned>(first + i));
            signed_words.push_back(-first - i);
            expected.push_back(first + i);
        }
        stack.write("long.tif", 200, 1, words);
        REQUIRE(numbers_in("long.tif") == expected);
        for (std::int32_t& n : expected) n = -n;
        stack.write("signed_long.tif", 200, 1, signed_words);
        REQUIRE(numbers_in("signed_long.tif") == expected);
    }
    stack.write<unsigned>("large.tif", 2, 1, {1, (1 << 20) + 1});
    CHECK(stack.said_of("large.tif").find("it has a label beyond 1048576; renumber its labels") != std::string::npos);
    // Bits are spread over bytes when they are decoded.
    for (const int bits : {1, 2, 4, 10, 12}) {
        CAPTURE(bits);
        const std::string path = stack.path("bits.tif").string();
        const auto out = OIIO::ImageOutput::create(path);
        OIIO::ImageSpec spec(2, 1, 1, bits > 8 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8);
        spec.attribute("oiio:BitsPerSample", bits);
        REQUIRE(out->open(path, spec));
        REQUIRE(out->write_image(OIIO::TypeDesc::FLOAT, std::array{0.0f, 1.0f}.data()));
        out->close();
        CHECK(numbers_in("bits.tif") == std::vector<std::int32_t>{0, (1 << bits) - 1});
    }
}

TEST_CASE("what is no stack is rejected, with the image and what is wrong") {
    Stack stack;
    CHECK(stack.said_of("no_###.png") ==
          "cannot use the labels \"no_###.png\": there is no file with this name and digits instead of #");
    CHECK(stack.said_of("nowhere/no_###.png").find("there is no file with this name") != std::string::npos);
    CHECK(
        stack.said_of("a_##_##.png") ==
        "cannot use the labels \"a_##_##.png\": the # in its name must be adjacent, because they stand for one number");
    CHECK(stack.said_of("none.png").find("no such file") != std::string::npos);
    stack.write("g_01.png", 2, 2, Bytes{0, 1, 2, 3});
    stack.write("g_02.png", 2, 2, Bytes{0, 1, 2, 3});
    stack.write("g_04.png", 2, 2, Bytes{0, 1, 2, 3});
    CHECK(stack.said_of("g_##.png") ==
          "cannot use the labels \"g_##.png\": \"g_04.png\" exists, but \"g_03.png\", which comes before it, does not");
    stack.write("g_03.png", 2, 3, Bytes{0, 1, 2, 3, 4, 5});
    CHECK(stack.said_of("g_##.png") ==
          "cannot use the labels \"g_##.png\": cannot use the layer \"g_03.png\": it has 2 × 3 pixels, but the layers "
          "below it have 2 × 2");
    stack.write("rgb.png", 1, 1, Bytes{0, 1, 2}, 3);
    CHECK(stack.said_of("rgb.png").find(
              "labels must be grey integers of at most 32 bits, or the palette of a PNG, but it has 3 channels") !=
          std::string::npos);
    stack.write("real.exr", 1, 1, std::vector<float>{0.5f});
    CHECK(stack.said_of("real.exr").find("palette of a PNG, but it has floating-point numbers of 32 bits") !=
          std::string::npos);
    std::vector<unsigned short> many(300);
    for (std::size_t i = 0; i < 300; ++i) many[i] = static_cast<unsigned short>(i);
    stack.write("many.png", 300, 1, many);
    CHECK(stack.said_of("many.png").find("it has more than 256 different numbers") != std::string::npos);
    stack.write("wide.png", 9000, 1, Bytes(9000));
    CHECK(stack.said_of("wide.png").find("it has 9000 × 1 × 1 voxels; the limits are 8192 along an axis") !=
          std::string::npos);
    std::ofstream(stack.path("text.png")) << "This is no image.";
    CHECK(stack.said_of("text.png").find("cannot use the layer \"text.png\"") != std::string::npos);
}

TEST_CASE("errors in volumes have a position in the scene") {
    Stack stack;
    stack.write("s_1.png", 2, 1, Bytes{0, 7});
    const auto said_of = [&](const std::string& node) {
        const std::string text = R"({"phases": {"a": {}, "b": {}}, "tree": )" + node + "}";
        try {
            (void)read_tree(Document::from_text(text, (stack.path("scene.json")).string()), tracer::file_readers());
        } catch (const SceneError& e) {
            CHECK(e.line() == 1);
            return std::to_string(e.column()) + ": " + std::string(e.what());
        }
        return std::string("nothing");
    };
    const auto contains = [&](const std::string& node, const std::string& column, const std::string& what) {
        const std::string said = said_of(node);
        CAPTURE(said);
        CHECK(said.starts_with(column + ": "));
        CHECK(said.find(what) != std::string::npos);
    };
    CHECK(said_of(R"({"labels": {"file": "s_#.png", "phases": ["a"], "values": [7], "spacing": [1, 1, 1]}})") ==
          "nothing");
    contains(R"({"labels": {"file": "s_#.png", "phases": ["a"], "spacing": [1, 1, 1]}})", "41",
             "the voxel (1, 0, 0), counted from 0, has the number 7");
    contains(R"({"labels": {"file": "s_#.png", "phases": ["a"], "values": [7]}})", "41", "\"spacing\" must be");
    contains(R"({"labels": {"file": "t_#.png", "phases": ["a"]}})", "60", "there is no file with this name");
    contains(R"({"labels": {"file": "s_#.png", "grid": "x", "phases": ["a"]}})", "60", "images have no named grids");
    contains(R"({"set": {"phase": "a", "of": {"volume": {"file": "s_1.png"}}}})", "89", "its name must end in .vdb");
    contains(R"({"set": {"phase": "a", "of": {"volume": {"file": ""}}}})", "89", "\"file\" must not be empty");
    contains(R"({"set": {"phase": "a", "of": {"volume": {"grid": "g"}}}})", "80", "\"file\"");
}

TEST_CASE("numbers of a stack stand about the origin, the first row at the largest y, integers from 0 to 1") {
    Stack stack;
    stack.write<unsigned char>("a_1.png", 3, 2, {0, 51, 102, 153, 204, 255});
    stack.write<unsigned short>("a_2.png", 3, 2, {0, 65535, 0, 0, 0, 13107});
    const glm::dvec3 spacing(0.5, 0.25, 2);
    const VoxelGrid grid = tracer::read_number_stack(stack.path("a_#.png"), spacing);
    CHECK(grid.lattice.size == std::array<int, 3>{3, 2, 2});
    const voxels::Table at(grid.table.data());
    for (int x = 0; x < 3; ++x) {
        CAPTURE(x);
        CHECK(at(x, 1, 0) == doctest::Approx(0.2 * x));
        CHECK(at(x, 0, 0) == doctest::Approx(0.6 + 0.2 * x));
    }
    CHECK(at(1, 1, 1) == 1.0f);
    CHECK(at(2, 0, 1) == doctest::Approx(0.2));
    const Bounds box = grid.extent();
    CHECK(box.low == glm::vec3(-0.75f, -0.25f, -2));
    CHECK(box.high == glm::vec3(0.75f, 0.25f, 2));
    // Floats are what they are, but for what is below 0.
    stack.write<float>("f.exr", 2, 1, {-3, 12.5f});
    const VoxelGrid floats = tracer::read_number_stack(stack.path("f.exr"), spacing);
    const voxels::Table of_floats(floats.table.data());
    CHECK(of_floats(0, 0, 0) == 0.0f);
    CHECK(of_floats(1, 0, 0) == 12.5f);
}

TEST_CASE("what a stack of numbers is rejected for") {
    Stack stack;
    stack.write<unsigned char>("rgb.png", 2, 2, Bytes(12), 3);
    stack.write<unsigned char>("b_1.png", 2, 2, Bytes(4));
    stack.write<unsigned char>("b_2.png", 2, 3, Bytes(6));
    stack.write<float>("nan.exr", 1, 1, {std::nanf("")});
    const auto said = [&](const std::string& name) {
        try {
            (void)tracer::read_number_stack(stack.path(name), glm::dvec3(1));
        } catch (const std::runtime_error& e) {
            return std::string(e.what());
        }
        return std::string("nothing");
    };
    const auto is_said = [&](const std::string& text, const std::string& part) {
        CAPTURE(text);
        CHECK(text.find(part) != std::string::npos);
        CHECK(text.find("cannot use the voxels \"") == 0);
    };
    is_said(said("rgb.png"), "the images must be grey, but it has 3 channels");
    is_said(said("b_#.png"), "it has 2 × 3 pixels, but the layers below it have 2 × 2");
    is_said(said("nan.exr"),
            "nan.exr\": 1 pixel is infinite or not a number, at column 0, row 0 (counted from 0 at the top left)");
    is_said(said("no_#.png"), "there is no file with this name");
}

namespace {

std::string big_endian(std::uint32_t n) {
    return {static_cast<char>(n >> 24), static_cast<char>(n >> 16), static_cast<char>(n >> 8), static_cast<char>(n)};
}

std::string chunk(const std::string& type, const std::string& data) {
    std::uint32_t crc = 0xffffffffu;
    for (const char c : type + data) {
        crc ^= static_cast<unsigned char>(c);
        for (int k = 0; k < 8; ++k) crc = crc & 1 ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
    }
    return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(~crc);
}

// The rows of a part of an image: every `dx`-th column from x0 on, every `dy`-th row from y0 on.
std::string packed_rows(int width, int height, int bits, const Bytes& indices, int x0, int y0, int dx, int dy) {
    std::string rows;
    for (int y = y0; y < height && x0 < width; y += dy) {
        rows += '\0';  // no filter
        int used = 8;
        for (int x = x0; x < width; x += dx, used += bits) {
            if (used == 8) rows += '\0', used = 0;
            rows.back() =
                static_cast<char>(rows.back() | indices[static_cast<std::size_t>(x + y * width)] << (8 - bits - used));
        }
    }
    return rows;
}

// A palette of colours that say nothing of their indices.
std::string palette(int colours) {
    std::string s;
    for (int i = 0; i < colours; ++i)
        for (const int c : {i * 91 + 7, 255 - i, i * 37}) s += static_cast<char>(c);
    return s;
}

// What the samples of a PNG file are, by its number for that.
enum class Samples : char { grey = 0, indices = 3 };

std::string png_of(int width, int height, int bits, bool is_interlaced, const std::string& data,
                   Samples samples = Samples::indices) {
    const int colours = 1 << bits;
    std::string colour_chunks;
    if (samples == Samples::indices)
        colour_chunks =
            chunk("PLTE", palette(colours)) + chunk("tRNS", std::string(static_cast<std::size_t>(colours), '\xff'));
    return "\x89PNG\r\n\x1a\n" +
           chunk("IHDR", big_endian(static_cast<std::uint32_t>(width)) +
                             big_endian(static_cast<std::uint32_t>(height)) +
                             std::string{static_cast<char>(bits), static_cast<char>(samples), 0, 0,
                                         is_interlaced ? '\1' : '\0'}) +
           chunk("tEXt", std::string("Title\0labels", 12)) + colour_chunks + data + chunk("IEND", "");
}

// A PNG file of these samples, not compressed, in several chunks.
std::string stored_png(int width, int height, int bits, bool is_interlaced, const Bytes& indices,
                       Samples samples = Samples::indices) {
    std::string rows;
    if (is_interlaced) {
        constexpr int passes[7][4]{{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                   {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
        for (const auto& [x0, y0, dx, dy] : passes) rows += packed_rows(width, height, bits, indices, x0, y0, dx, dy);
    } else {
        rows = packed_rows(width, height, bits, indices, 0, 0, 1, 1);
    }
    const auto count = static_cast<unsigned>(rows.size());
    std::string data = "\x78\x01\x01";
    for (const unsigned n : {count, ~count}) data += {static_cast<char>(n), static_cast<char>(n >> 8)};
    std::uint32_t low = 1, high = 0;
    for (const char c : rows) low = (low + static_cast<unsigned char>(c)) % 65521, high = (high + low) % 65521;
    data += rows + big_endian(high << 16 | low);
    std::string chunks;
    for (std::size_t at = 0; at < data.size(); at += 100) chunks += chunk("IDAT", data.substr(at, 100));
    return png_of(width, height, bits, is_interlaced, chunks, samples);
}

}  // namespace

TEST_CASE("the labels of a PNG file with a palette are its indices") {
    Stack stack;
    constexpr int width = 21, height = 13;
    for (const int bits : {1, 2, 4, 8})
        for (const bool is_interlaced : {false, true}) {
            CAPTURE(bits);
            CAPTURE(is_interlaced);
            Bytes indices;
            for (int i = 0; i < width * height; ++i) indices.push_back(static_cast<unsigned char>(i * 7 % (1 << bits)));
            indices[5] = static_cast<unsigned char>((1 << bits) - 1);
            support::write_text(stack.path("a.png"), stored_png(width, height, bits, is_interlaced, indices));
            const LabelGrid grid = tracer::read_label_grid(stack.path("a.png"), "");
            REQUIRE(grid.lattice.size == std::array{width, height, 1});
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    CHECK(grid.numbers[grid.voxels[static_cast<std::size_t>(x + width * (height - 1 - y))]] ==
                          indices[static_cast<std::size_t>(x + width * y)]);
            // As a picture the file shows the colours of its palette.
            const auto shown = OIIO::ImageInput::open(stack.path("a.png").string());
            REQUIRE(shown);
            Bytes colours(static_cast<std::size_t>(width * height * shown->spec().nchannels));
            REQUIRE(shown->read_image(0, 0, 0, -1, OIIO::TypeDesc::UINT8, colours.data()));
            CHECK(colours[static_cast<std::size_t>(5 * shown->spec().nchannels) + 1] == 255 - indices[5]);
        }
}

TEST_CASE("the labels of a grey PNG file are its numbers, of any bits") {
    Stack stack;
    constexpr int width = 21, height = 13;
    for (const int bits : {1, 2, 4, 8})
        for (const bool is_interlaced : {false, true}) {
            CAPTURE(bits);
            CAPTURE(is_interlaced);
            Bytes numbers;
            for (int i = 0; i < width * height; ++i) numbers.push_back(static_cast<unsigned char>(i * 7 % (1 << bits)));
            support::write_text(stack.path("a.png"),
                                stored_png(width, height, bits, is_interlaced, numbers, Samples::grey));
            const LabelGrid grid = tracer::read_label_grid(stack.path("a.png"), "");
            REQUIRE(grid.lattice.size == std::array{width, height, 1});
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    CHECK(grid.numbers[grid.voxels[static_cast<std::size_t>(x + width * (height - 1 - y))]] ==
                          numbers[static_cast<std::size_t>(x + width * y)]);
        }
}

TEST_CASE("labels with and without a palette stand in one stack, filtered and compressed as programs write them") {
    Stack stack;
    Bytes indices;
    for (int i = 0; i < 64 * 64; ++i) indices.push_back(static_cast<unsigned char>(i % 64 < 20 ? 255 : i / 300));
    stack.write("a_1.png", 64, 64, indices);
    // The same, with a palette.
    const std::string grey = support::bytes_of(stack.path("a_1.png"));
    const std::size_t begin = grey.find("IDAT") - 4, end = grey.find("IEND") - 4;
    REQUIRE(grey.find("IHDR") == 12);
    support::write_text(stack.path("a_2.png"), png_of(64, 64, 8, false, grey.substr(begin, end - begin)));
    const LabelGrid grid = tracer::read_label_grid(stack.path("a_#.png"), "");
    REQUIRE(grid.voxels.size() == 2 * 64 * 64);
    CHECK(std::equal(grid.voxels.begin(), grid.voxels.begin() + 64 * 64, grid.voxels.begin() + 64 * 64));
    CHECK(grid.numbers[grid.voxels[0]] == 255);
}

TEST_CASE("files with a palette that are damaged, or claim too much, are rejected") {
    Stack stack;
    const std::string whole = stored_png(9, 9, 4, false, Bytes(81, 3));
    for (std::size_t n = 26; n < whole.size(); ++n) {
        CAPTURE(n);
        support::write_text(stack.path("a.png"), whole.substr(0, n));
        CHECK(stack.said_of("a.png").find("cannot use the layer \"a.png\": ") != std::string::npos);
    }
    const auto said_of = [&](const std::string& bytes) {
        support::write_text(stack.path("b.png"), bytes);
        return stack.said_of("b.png");
    };
    const auto with_size = [&](std::uint32_t width, std::uint32_t height, char bits) {
        return "\x89PNG\r\n\x1a\n" +
               chunk("IHDR", big_endian(width) + big_endian(height) + std::string{bits, 3, 0, 0, 0}) + whole.substr(33);
    };
    CHECK(said_of(with_size(9000, 9, 4)).find("the limits are 8192 along an axis") != std::string::npos);
    CHECK(said_of(with_size(8000, 8000, 4)).find("it is too short for the image size in its header") !=
          std::string::npos);
    CHECK(said_of(with_size(9, 9, 3)).find("its palette has indices of 3 bits") != std::string::npos);
    CHECK(said_of(with_size(0, 9, 4)).find("its size is invalid") != std::string::npos);
    std::string many;
    for (int i = 0; i < 30; ++i) many += chunk("IDAT", std::string(50'000, '\0'));
    CHECK(said_of(png_of(9, 9, 4, false, many)).find("it has more data than its size needs") != std::string::npos);
}

}  // namespace test_image_stack
