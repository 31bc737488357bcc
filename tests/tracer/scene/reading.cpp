// Progress of reading files: each reader reports every byte once, while it reads.
#include "phasetree_support/reading.hpp"

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <random>
#include <thread>
#include <vector>

#include "image/read_image.hpp"
#include "phasetree/io/mesh.hpp"
#include "phasetree_support/temporary_directory.hpp"
#include "scene/fingerprint.hpp"
#include "scene/mesh_kinds.hpp"
#include "scene/named_files.hpp"
#include "scene/read_transform.hpp"

namespace test_reading {

using namespace phasetree;
using namespace phasetree::tracer;
using support::TemporaryDirectory;
using support::write_text;

namespace {

constexpr std::uint64_t megabyte = std::uint64_t{1} << 20;

// The reports that a listener receives while f runs.
template <class F>
std::vector<std::uint64_t> heard(F&& f) {
    std::vector<std::uint64_t> all;
    const support::ReadingListener listener([&](std::uint64_t bytes) { all.push_back(bytes); });
    f();
    return all;
}

// All bytes are reported, in several steps of little more than a megabyte each.
void check(const std::vector<std::uint64_t>& told, std::uint64_t bytes) {
    CHECK(std::accumulate(told.begin(), told.end(), std::uint64_t{0}) == bytes);
    CHECK(std::count_if(told.begin(), told.end(), [](std::uint64_t n) { return n > 0; }) >=
          static_cast<std::ptrdiff_t>(bytes / (2 * megabyte)));
    CHECK(std::all_of(told.begin(), told.end(), [](std::uint64_t n) { return n < 2 * megabyte; }));
}

}  // namespace

TEST_CASE("a scene's text") {
    std::string text = "{\"list\": [";
    while (text.size() < 5 * megabyte) text += "[0.25, 12, \"a\"], ";
    text += "0]}";
    check(heard([&] { (void)Document::from_text(text); }), text.size());
}

TEST_CASE("a mesh that is a field") {
    const TemporaryDirectory folder;
    const auto check_file = [&](const std::string& name, const std::string& content) {
        write_text(folder / name, content);
        check(heard([&] { (void)read_mesh(folder / name); }), content.size());
    };
    const auto filled = [](std::string text, const std::string& row) {
        while (text.size() < 3 * megabyte) text += row;
        return text;
    };
    check_file("a.obj", filled("v 0 0 0\nv 1 0 0\nv 0 1 0\n", "f 1 2 3\n"));
    check_file("a.stl", filled("solid\n", "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\n"));
    const std::uint32_t count = 60'000;
    std::string binary(84 + 50 * std::size_t{count}, '\0');
    std::memcpy(binary.data() + 80, &count, sizeof count);
    check_file("b.stl", binary);
    const auto ply = [](const std::string& format) {
        return "ply\nformat " + format + " 1.0\nelement vertex 300000\nproperty float x\nproperty float y\n" +
               "property float z\nend_header\n";
    };
    check_file("a.ply", ply("binary_little_endian") + std::string(300'000 * 12, '\0'));
    std::string rows;
    while (rows.size() < 300'000 * 12) rows += "0.5 1 0.125\n";
    check_file("b.ply", ply("ascii") + rows);
}

TEST_CASE("a mesh") {
    const TemporaryDirectory folder;
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    while (text.size() < 3 * megabyte) text += "f 1 2 3\n";
    write_text(folder / "a.obj", text);
    ObjParameters obj;
    obj.file = folder / "a.obj";
    Mesh mesh;
    check(heard([&] { mesh = obj.made(); }), text.size());
    CHECK(mesh.triangles.size() == (text.size() - 24) / 8);
}

TEST_CASE("an image") {
    const TemporaryDirectory folder;
    const std::string path = folder / "a.exr";
    const OIIO::ImageSpec spec(1024, 1024, 1, OIIO::TypeDesc::FLOAT);
    std::vector<float> values(1024 * 1024);
    std::mt19937 random(1);
    for (float& value : values) value = static_cast<float>(random());  // incompressible
    const auto out = OIIO::ImageOutput::create(path);
    REQUIRE(out->open(path, spec));
    REQUIRE(out->write_image(OIIO::TypeDesc::FLOAT, values.data()));
    REQUIRE(out->close());
    const std::uint64_t bytes = std::filesystem::file_size(path);
    REQUIRE(bytes > 2 * megabyte);
    check(heard([&] {
              read_image(
                  path, "image", [](const ImageHeader&) { return 1; }, [](std::span<const float>) {});
          }),
          bytes);
}

TEST_CASE("a list of instances") {
    const TemporaryDirectory folder;
    constexpr std::uint64_t count = 50'000;
    std::string bytes = "PTPLACES" + std::string(8, '\0');
    std::memcpy(bytes.data() + 8, &count, 8);
    const std::array<float, 12> place{1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (std::uint64_t i = 0; i < count; ++i) bytes.append(reinterpret_cast<const char*>(place.data()), 48);
    write_text(folder / "a.places", bytes);
    write_text(folder / "scene.json", R"({"file": "a.places"})");
    const Document document = Document::from_file(folder / "scene.json");
    check(heard([&] { (void)read_transforms_file(document, *document.root().find("file")); }), bytes.size());
}

TEST_CASE("who listens last hears, and then who listened before; another thread is not heard") {
    std::uint64_t outer = 0, inner = 0;
    const support::ReadingListener before([&](std::uint64_t n) { outer += n; });
    {
        const support::ReadingListener listener([&](std::uint64_t n) { inner += n; });
        support::ReadingListener::tell(1);
    }
    support::ReadingListener::tell(10);
    std::thread([] { support::ReadingListener::tell(100); }).join();
    CHECK(inner == 1);
    CHECK(outer == 10);
}

TEST_CASE("the files that a scene names are counted as often as it names them, those of objects' files too") {
    const TemporaryDirectory folder;
    write_text(folder / "a.obj", std::string(1000, ' '));
    write_text(folder / "vase.json", R"({"shapes": {"x": {"siren": {"file": "a.obj"}}}})");
    const auto bytes = [&](const std::string& text) {
        write_text(folder / "scene.json", text);
        return bytes_of_named_files(Document::from_file(folder / "scene.json"));
    };
    CHECK(bytes("{}") == 0);
    CHECK(bytes(R"({"meshes": [{"obj": {"file": "a.obj"}}, {"obj": {"file": "a.obj"}}, {"x": "none.obj"}]})") == 2000);
    const std::uintmax_t vase = std::filesystem::file_size(folder / "vase.json");
    CHECK(bytes(R"({"objects": [{"name": "v", "file": "vase.json"}]})") == vase + 1000);
    CHECK(bytes(R"({"objects": [{"name": "v", "file": "a.obj"}]})") == 1000);  // not a scene; its reader reports that
    // A stack of images counts all its layers; a colour counts nothing.
    write_text(folder / "layer_01.pgm", std::string(100, ' '));
    write_text(folder / "layer_02.pgm", std::string(20, ' '));
    CHECK(bytes(R"({"x": "layer_##.pgm", "y": "#808080", "z": "none_##.pgm"})") == 120);
    // Other files may have a # in their names, too.
    write_text(folder / "part#1.obj", std::string(7, ' '));
    std::filesystem::create_directory(folder / "a#b");
    write_text(folder / "a#b/part.obj", std::string(3, ' '));
    CHECK(bytes(R"({"x": "part#1.obj", "y": "a#b/part.obj"})") == 10);
    CHECK(bytes(R"({"x": "layer_##.pgm"})") == 120);
    const auto identity = [&] { return fingerprint(Document::from_file(folder / "scene.json")); };
    const std::uint64_t before = identity();
    write_text(folder / "layer_02.pgm", std::string(20, '!'));
    CHECK(identity() != before);
    const Document strict = Document::from_file(folder / "scene.json").with_files_within(folder / "..");
    CHECK(bytes_of_named_files(strict) > 0);
}

TEST_CASE("units, densities and statements change no fingerprint") {
    const auto identity = [](const std::string& rest, const std::string& phase) {
        return fingerprint(Document::from_text("{" + rest + R"("objects": [{"phases": {"ice": )" + phase +
                                               R"(}}], "phases": {"glass": )" + phase + "}}"));
    };
    const std::uint64_t plain = identity("", R"({"clear": {"ior": 1.5, "density": "ball"}})");
    CHECK(identity(R"("unit": "mm", "expect": [{"present": {"phase": "glass"}}], )",
                   R"({"density": 2500, "clear": {"ior": 1.5, "density": "ball"}})") == plain);
    CHECK(identity("", R"({"clear": {"ior": 1.4, "density": "ball"}})") != plain);
    CHECK(identity("", R"({"clear": {"ior": 1.5, "density": "box"}})") != plain);
}

}  // namespace test_reading
