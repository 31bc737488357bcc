// Files that scenes name: their cost before they are rejected, reading each of them once, what an error may say about
// them, and the folder that they must be in.
#include <fmt/format.h>

#include <cstdint>

#include "command.hpp"

namespace test_assets {

using namespace phasetree::tests;
namespace fs = std::filesystem;

namespace {

std::string big_endian(std::uint32_t v) {
    return {static_cast<char>(v >> 24), static_cast<char>(v >> 16), static_cast<char>(v >> 8), static_cast<char>(v)};
}

std::string png_chunk(const std::string& type, const std::string& data) {
    std::uint32_t crc = 0xffffffffu;
    for (const char c : type + data) {
        crc ^= static_cast<unsigned char>(c);
        for (int k = 0; k < 8; ++k) crc = crc & 1 ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
    }
    return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(~crc);
}

// A PNG file that claims a size and holds next to nothing.
std::string empty_png(std::uint32_t width, std::uint32_t height, bool interlaced) {
    const std::string header =
        big_endian(width) + big_endian(height) + std::string{8, 2, 0, 0, interlaced ? '\1' : '\0'};
    const std::string nothing("\x78\x9c\x03\x00\x00\x00\x00\x01", 8);
    return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + png_chunk("IDAT", nothing) + png_chunk("IEND", "");
}

// A Radiance picture of one colour, not compressed.
std::string hdr(int width, int height) {
    std::string text = fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", height, width);
    for (int i = 0; i < width * height; ++i) text += std::string("\x20\x40\x60\x80", 4);
    return text;
}

// The run-length form, from 8 columns on: `rows` of those that the header claims.
std::string short_hdr(int width, int height, int rows) {
    std::string text = fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", height, width);
    for (int row = 0; row < rows; ++row) {
        text += {2, 2, static_cast<char>(width >> 8), static_cast<char>(width)};
        for (int channel = 0; channel < 4; ++channel)
            for (int left = width; left > 0; left -= 127)
                text += {static_cast<char>(128 + std::min(left, 127)), '\x60'};
    }
    return text;
}

SceneText with_images(const std::string& name, int times) {
    SceneText scene;
    scene.lights = "[";
    for (int i = 0; i < times; ++i)
        scene.lights +=
            fmt::format("{}{{\"image\": {{\"file\": \"{}\", \"rotation\": {}}}}}", i ? ", " : "", name, 10 * i);
    scene.lights += "]";
    return scene;
}

SceneText with_weights(const std::string& name) {
    SceneText scene;
    scene.shapes = R"({"ball": {"siren": {"file": ")" + name + R"("}}})";
    return scene;
}

const std::string weights =
    R"({"radius": 1, "layers": [{"weights": [[1, 0, 0], [0, 1, 0]], "bias": [0, 0]}, {"weights": [[1, 1]], "bias": [0]}]})";

}  // namespace

TEST_CASE("an image that claims more than it holds is rejected before it costs memory") {
    Shell shell;
    shell.executes_program = true;
    write_text(shell.directory / "good.hdr", hdr(16, 8));
    write_text(shell.directory / "scene.json", with_images("good.hdr", 1).text());
    const Outcome good = shell.run({"check", "scene.json"});
    REQUIRE(good.code == 0);
    for (const bool interlaced : {false, true}) {
        write_text(shell.directory / "bad.png", empty_png(16384, 8192, interlaced));
        CHECK(fs::file_size(shell.directory / "bad.png") < 80);
        write_text(shell.directory / "scene.json", with_images("bad.png", 1).text());
        const Outcome o = shell.run({"check", "scene.json"});
        CAPTURE(o.err);
        CHECK(o.code == 2);
        CHECK(o.err.find("scene.json:5:31: cannot use the environment image \"bad.png\": it is too short") == 0);
        if (!under_sanitizer) CHECK(o.peak_megabytes < good.peak_megabytes + 50);
    }
    // Another format, decoded as far as it goes.
    write_text(shell.directory / "bad.hdr", short_hdr(16384, 8192, 100));
    write_text(shell.directory / "scene.json", with_images("bad.hdr", 1).text());
    const Outcome o = shell.run({"check", "scene.json"});
    CAPTURE(o.err);
    CHECK(o.code == 2);
    if (!under_sanitizer) CHECK(o.peak_megabytes < good.peak_megabytes + 100);
}

TEST_CASE("an image of a kind that opening decodes is rejected, whatever it is called") {
    Shell shell;
    shell.executes_program = true;
    // A WebP image without loss of 16383×16383 pixels, of one colour; and the beginnings of the others.
    const std::string webp(
        "RIFF\x1e\0\0\0WEBPVP8L\x11\0\0\0\x2f\xfe\xbf\xff\x0f\x07\x10\x11\xff\xff\xff\xff\x0f\0\0\0\0\0", 38);
    const std::string heif(
        "\0\0\0\x18"
        "ftypheic\0\0\0\0mif1heic",
        24);
    const std::string jpeg_2000("\0\0\0\x0cjP  \r\n\x87\n", 12), codestream("\xff\x4f\xff\x51\0\x29", 6);
    for (const std::string& bytes : {webp, heif, jpeg_2000, codestream})
        for (const std::string name : {"sky.webp", "sky.png", "sky.exr"}) {
            write_text(shell.directory / name, bytes);
            write_text(shell.directory / "scene.json", with_images(name, 1).text());
            const Outcome o = shell.run({"check", "scene.json"});
            CAPTURE(o.err);
            CHECK(o.code == 2);
            CHECK(o.err.find("scene.json:5:31: cannot use the environment image \"" + name + "\": it is a") == 0);
            CHECK(o.err.find("save it as OpenEXR, PNG or TIFF") != std::string::npos);
            if (!under_sanitizer) CHECK(o.peak_megabytes < 200);
        }
}

TEST_CASE("an image is in memory once, however many lights it makes" * doctest::skip(under_sanitizer)) {
    Shell shell;
    shell.executes_program = true;
    write_text(shell.directory / "sky.hdr", short_hdr(2048, 1024, 1024));
    fs::create_directory(shell.directory / "folder");
    // 24 MB of texels, and what is built to sample them.
    write_text(shell.directory / "scene.json", with_images("sky.hdr", 1).text());
    const Outcome once = shell.run({"check", "scene.json"});
    REQUIRE(once.code == 0);
    write_text(shell.directory / "scene.json", with_images("folder/../sky.hdr", 8).text());
    const Outcome often = shell.run({"check", "scene.json"});
    REQUIRE(often.code == 0);
    CHECK(often.peak_megabytes < once.peak_megabytes + 20);
}

TEST_CASE("an error of a file of weights has its place in the scene, and quotes nothing of the file") {
    const Shell shell;
    const auto told = [&](const std::string& name) {
        write_text(shell.directory / "scene.json", with_weights(name).text());
        const Outcome o = shell.run({"check", "scene.json"});
        CHECK(o.code == 2);
        CHECK(o.err.find("scene.json:3:") == 0);
        return o.err.substr(0, o.err.find('\n'));
    };
    write_text(shell.directory / "weights.json", weights);
    write_text(shell.directory / "scene.json", with_weights("weights.json").text());
    CHECK(shell.run({"info", "scene.json"}).code == 0);

    CHECK(told("wieghts.json") == "scene.json:3:39: wieghts.json: no such file (did you mean \"weights.json\"?)");
    write_text(shell.directory / "secret", "PASSWORD=hunter2\0USER=me");
    CHECK(told("secret") == "scene.json:3:39: secret: is not JSON (line 1, column 1)");
    const std::string form =
        "is not a network {\"radius\": R, \"layers\": [{\"weights\": [[…], …], \"bias\": […]}, …]} with one row of "
        "weights per number in bias ";
    write_text(shell.directory / "secret", "{\"radius\": 1,\n  \"hunter2\": \"PASSWORD\", \"layers\": []}");
    CHECK(told("secret") == "scene.json:3:39: secret: " + form + "(line 2, column 3)");
    write_text(shell.directory / "secret", "{\"radius\": -31415, \"layers\": []}");
    CHECK(told("secret") == "scene.json:3:39: secret: " + form + "(line 1, column 12)");
    write_text(shell.directory / "secret", R"({"radius": 1, "layers": []})");
    CHECK(told("secret") == "scene.json:3:39: secret: the network has no layers");

    Shell with_secret;
    with_secret.environment = {{"PASSWORD", "hunter2"}};
    write_text(with_secret.directory / "scene.json", with_weights("/proc/self/environ").text());
    for (const char* const command : {"check", "info", "eval"}) {
        const Outcome o = with_secret.run({command, "scene.json"});
        CHECK(o.code == 2);
        CHECK(o.err.find("/proc/self/environ: is not JSON") != std::string::npos);
        CHECK(o.err.find("hunter2") == std::string::npos);
        CHECK(o.err.find("PASSWORD") == std::string::npos);
    }
}

TEST_CASE("--assets-within: what leaves the folder is rejected, whatever it is") {
    const Shell shell;
    const auto at = [&](const std::string& name) { return shell.directory / name; };
    for (const char* const folder : {"assets", "assets/deep", "assets2"}) fs::create_directory(at(folder));
    for (const char* const place : {"outside.json", "assets/inside.json", "assets/deep/inside.json", "assets2/a.json"})
        write_text(at(place), weights);
    write_text(at("sky.hdr"), hdr(16, 8));
    write_text(at("ball.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    fs::create_symlink("../outside.json", at("assets/link.json"));
    fs::create_symlink("deep/inside.json", at("assets/good_link.json"));
    fs::create_symlink("..", at("assets/up"));
    fs::create_symlink("/etc/nowhere", at("assets/dangling.json"));
    const std::string here = fs::canonical(at("assets")).string();

    const auto check = [&](const SceneText& scene, const std::vector<std::string>& more) {
        // The scene itself may be anywhere; names are relative to its folder.
        write_text(at("assets/scene.json"), scene.text());
        std::vector<std::string> words{"check", "assets/scene.json"};
        words.insert(words.end(), more.begin(), more.end());
        return shell.run(words);
    };
    const std::vector<std::string> confined{"--assets-within", "assets"};
    for (const std::string& name :
         {std::string("inside.json"), std::string("deep/../inside.json"), std::string("./deep/inside.json"),
          std::string("good_link.json"), here + "/inside.json"}) {
        CAPTURE(name);
        CHECK(check(with_weights(name), confined).err == "");
    }
    for (const std::string& name :
         {std::string("../outside.json"), std::string("deep/../../outside.json"), std::string("link.json"),
          std::string("up/outside.json"), std::string("../assets2/a.json"), at("outside.json").string(),
          std::string("/proc/self/environ"), std::string("/nowhere/at/all"), std::string("../nowhere.json")}) {
        CAPTURE(name);
        const Outcome o = check(with_weights(name), confined);
        CAPTURE(o.err);
        CHECK(o.code == 2);
        // The same whether there is such a file or not.
        CHECK(o.err.find(fmt::format("assets/scene.json:3:39: \"{}\" is outside {}, the folder that files must be in",
                                     name, here)) == 0);
    }
    CHECK(check(with_weights("dangling.json"), confined).code == 2);
    // By default any file may be read.
    for (const char* const name : {"../outside.json", "link.json", "up/outside.json"})
        CHECK(check(with_weights(name), {}).err == "");

    // Every kind of file that a scene can name.
    SceneText mesh;
    mesh.rest = R"("meshes": [{"obj": {"file": "../ball.obj", "material": {"diffuse": {"color": [1, 1, 1]}}}}])";
    SceneText heights;
    heights.shapes =
        R"({"ball": {"intersection": [{"sphere": {"radius": 1}}, {"height_map": {"file": "../sky.hdr", "size_x": 2, "size_y": 2, "height": 1}}]}})";
    for (const SceneText& scene : {with_images("../sky.hdr", 1), mesh, heights}) {
        CHECK(check(scene, {}).err == "");
        const Outcome o = check(scene, confined);
        CHECK(o.code == 2);
        CHECK(o.err.find("is outside") != std::string::npos);
    }
    // A stack of images, one of which is a link that leads out of the folder.
    SceneText stack;
    stack.tree = R"({"under": [{"set": {"phase": "glass", "of": "ball"}},
                      {"labels": {"file": "layer_##.pgm", "phases": ["glass"], "spacing": [1, 1, 1]}}]})";
    const std::string layer = std::string("P5 2 2 255\n") + std::string(4, '\1');
    write_text(at("layer_02.pgm"), layer);
    write_text(at("assets/layer_01.pgm"), layer);
    fs::create_symlink("../layer_02.pgm", at("assets/layer_02.pgm"));
    CHECK(check(stack, {}).err == "");
    CHECK(check(stack, confined).err.find("\"layer_##.pgm\" is outside") != std::string::npos);
    fs::remove(at("assets/layer_02.pgm"));
    write_text(at("assets/deep/layer_02.pgm"), layer);
    fs::create_symlink("deep/layer_02.pgm", at("assets/layer_02.pgm"));
    CHECK(check(stack, confined).err == "");

    for (const char* const command : {"render", "info", "eval", "trace"}) {
        CAPTURE(command);
        write_text(at("assets/scene.json"), with_weights("../outside.json").text());
        const Outcome o = shell.run({command, "assets/scene.json", "--assets-within", "assets"});
        CHECK(o.code == 2);
        CHECK(o.err.find("is outside") != std::string::npos);
    }
    for (const char* const folder : {"nowhere", "outside.json"}) {
        const Outcome o = check(SceneText(), {"--assets-within", folder});
        CHECK(o.code == 2);
        CHECK(o.err == fmt::format("{}: is not a folder\n", folder));
    }
}

}  // namespace test_assets
