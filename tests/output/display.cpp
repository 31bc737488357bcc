#include "output/display.hpp"
#include "source_directory.hpp"

#include <OpenColorIO/OpenColorIO.h>
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <glm/mat3x3.hpp>
#include <sstream>
#include <thread>
#include <vector>

#include "environment.hpp"
#include "output/default_config.hpp"
#include "output/error.hpp"
#include "phasetree_support/temporary_directory.hpp"

namespace test_display {

namespace ocio = OCIO_NAMESPACE;
using namespace phasetree::tracer;
using namespace phasetree::support;
using namespace phasetree::tracer::test;

namespace {

double srgb(double v) {
    return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
}

glm::vec3 shown(const DisplayTransform& transform, glm::vec3 color) {
    transform.apply({&color, 1});
    return color;
}

DisplayTransform view(const char* name) {
    return DisplayTransform(std::nullopt, name);
}

// A configuration of somebody else: colors, roles and a display whose view is one of the color spaces.
std::string foreign(const std::string& roles, const std::string& shown_space) {
    return "ocio_profile_version: 2\n"
           "environment: {}\n"
           "search_path: \"\"\n"
           "roles:\n" +
           roles +
           "file_rules:\n  - !<Rule> {name: Default, colorspace: default}\n"
           "displays:\n  Projector:\n    - !<View> {name: Film, colorspace: " +
           shown_space +
           "}\n"
           "colorspaces:\n"
           "  - !<ColorSpace> {name: AP0, isdata: false}\n"
           "  - !<ColorSpace>\n    name: AP1\n    isdata: false\n"
           "    to_scene_reference: !<BuiltinTransform> {style: ACEScg_to_ACES2065-1}\n";
}

}  // namespace

TEST_CASE("the built-in configuration is the file that is installed for other tools") {
    CHECK(default_color_config() == bytes_of(source_directory() + "/tracer/color/phasetree.ocio"));
}

TEST_CASE("the built-in configuration is valid, and names the working space as OpenImageIO does") {
    std::istringstream text{std::string(default_color_config())};
    const auto config = ocio::Config::CreateFromStream(text);
    CHECK_NOTHROW(config->validate());
    CHECK(std::string(config->getCanonicalName("Linear")) == "Linear Rec.709");
    for (const char* role : {"scene_linear", "rendering", "default", "compositing_linear", "color_timing"}) {
        CHECK(std::string(config->getColorSpace(role)->getName()) == "Linear Rec.709");
    }
    CHECK(std::string(config->getColorSpace("data")->getName()) == "Raw");
    CHECK(std::string(config->getColorSpace("color_picking")->getName()) == "sRGB Texture");
    CHECK(config->hasRole("aces_interchange"));
    CHECK(config->hasRole("cie_xyz_d65_interchange"));

    // A texture through the color space and a picture through the Standard view are the same curve.
    const auto texture = config->getProcessor("Linear", "sRGB Texture")->getDefaultCPUProcessor();
    std::array<float, 3> pixel{0.2f, 0.5f, 0.8f};
    texture->applyRGB(pixel.data());
    CHECK(pixel[0] == doctest::Approx(srgb(0.2)).epsilon(1e-4));
    CHECK(pixel[2] == doctest::Approx(srgb(0.8)).epsilon(1e-4));
}

TEST_CASE("the default is the photographic view") {
    const OcioVariable none;
    const DisplayTransform transform;
    CHECK(transform.display() == "sRGB");
    CHECK(transform.view() == "Photographic");
    CHECK(transform.is_srgb());
    const OcioVariable empty("");
    CHECK(DisplayTransform().view() == "Photographic");
}

TEST_CASE("Standard is the sRGB curve, Raw is nothing") {
    const OcioVariable none;
    const DisplayTransform standard = view("Standard");
    const DisplayTransform raw = view("Raw");
    for (int i = 0; i <= 1000; ++i) {
        const float v = static_cast<float>(i) / 1000.0f;
        const glm::vec3 color(v, 1.0f - v, 0.5f * v);
        const glm::vec3 result = shown(standard, color);
        for (int c = 0; c < 3; ++c) REQUIRE(std::abs(result[c] - srgb(color[c])) < 5e-5);
        REQUIRE(shown(raw, color) == color);
    }
    CHECK(std::lround(255.0f * shown(standard, glm::vec3(0.5f)).r) == 188);
}

TEST_CASE("the ACES views keep black, neutrals and order, and roll off highlights") {
    const OcioVariable none;
    for (const char* name : {"ACES 1.0 SDR", "Photographic"}) {
        CAPTURE(name);
        const DisplayTransform aces = view(name);
        CHECK(std::abs(shown(aces, glm::vec3(0.0f)).g) < 1e-6f);  // not 0 itself: the curve has a toe
        float previous = -1.0f;
        for (int i = -100; i <= 80; ++i) {
            const float grey = 0.18f * std::exp2(static_cast<float>(i) / 10.0f);
            const glm::vec3 result = shown(aces, glm::vec3(grey));
            REQUIRE(result.g >= previous);
            // A quarter of an 8-bit code.
            REQUIRE(std::abs(result.r - result.g) < 0.001f);
            REQUIRE(std::abs(result.b - result.g) < 0.001f);
            previous = result.g;
        }
        CHECK(shown(aces, glm::vec3(1.0f)).g < 0.9f);    // the shoulder leaves room above diffuse white
        CHECK(shown(aces, glm::vec3(32.0f)).g > 0.99f);  // and ends at the display's white
    }
    // ACES 1.0 puts 18 % grey at 10 nits of 100, close to sRGB(0.1): code 91.
    CHECK(255.0f * shown(view("ACES 1.0 SDR"), glm::vec3(0.18f)).g == doctest::Approx(90.8).epsilon(0.01));
    CHECK(255.0f * shown(view("Photographic"), glm::vec3(0.18f)).g ==
          doctest::Approx(255.0 * srgb(0.18)).epsilon(0.001));
}

TEST_CASE("exposure is a power of two on scene light") {
    const OcioVariable none;
    const glm::vec3 color(0.3f, 0.2f, 0.05f);
    for (const float ev : {-3.0f, 0.5f, 2.0f}) {
        const DisplayTransform exposed(std::nullopt, "Photographic", ev);
        CHECK(exposed.exposure_ev() == ev);
        CHECK(shown(exposed, color) == shown(view("Photographic"), color * std::exp2(ev)));
    }
    CHECK(shown(DisplayTransform(std::nullopt, "Raw", 500.0f), glm::vec3(0.0f)) == glm::vec3(0.0f));
    CHECK(contains(message_of<DisplayError>([] { DisplayTransform(std::nullopt, std::nullopt, std::nanf("")); }),
                   "must be a finite number of stops"));
}

TEST_CASE("each pixel is treated by itself, in any number of threads") {
    const OcioVariable none;
    const DisplayTransform transform;
    std::vector<glm::vec3> colors;
    for (int i = 0; i < 3001; ++i) {
        const auto t = static_cast<float>(i);
        colors.emplace_back(0.001f * t, 1.0f + std::sin(t), 0.1f * std::fmod(t, 17.0f));
    }
    std::vector<glm::vec3> at_once = colors;
    transform.apply(at_once);
    std::vector<std::vector<glm::vec3>> results(4, colors);
    {
        std::vector<std::jthread> threads;
        for (std::vector<glm::vec3>& result : results) {
            threads.emplace_back([&] {
                for (glm::vec3& color : result) transform.apply({&color, 1});
            });
        }
    }
    for (const std::vector<glm::vec3>& result : results) {
        CHECK(std::memcmp(result.data(), at_once.data(), result.size() * sizeof(glm::vec3)) == 0);
    }
    transform.apply({});
}

TEST_CASE("unknown names list the known ones") {
    const OcioVariable none;
    const std::string display = message_of<DisplayError>([] { DisplayTransform("sRBG"); });
    CHECK(contains(display, "unknown display \"sRBG\" (did you mean \"sRGB\"?); choose from \"sRGB\""));
    const std::string slip = message_of<DisplayError>([] { view("Standart"); });
    CHECK(contains(slip, "unknown view \"Standart\" of display \"sRGB\" (did you mean \"Standard\"?)"));
    CHECK(contains(slip, "choose from \"Photographic\", \"ACES 1.0 SDR\", \"Standard\", \"Raw\""));
    CHECK(contains(message_of<DisplayError>([] { view("aces"); }), "did you mean \"ACES 1.0 SDR\"?"));
    const std::string other = message_of<DisplayError>([] { view("Technicolor"); });
    CHECK(contains(other, "choose from"));
    CHECK_FALSE(contains(other, "did you mean"));
    CHECK(contains(message_of<DisplayError>([] { view(""); }), "choose from"));
    CHECK(DisplayTransform("SRGB", "standard").view() == "Standard");
}

TEST_CASE("$OCIO is honoured, and a bad one is an error") {
    const TemporaryDirectory folder;
    const auto failure = [&](const std::string& path) {
        const OcioVariable variable(path);
        return message_of<DisplayError>([] { DisplayTransform(); });
    };
    CHECK(contains(failure((folder / "missing.ocio").string()),
                   "cannot read the OpenColorIO configuration \"" + (folder / "missing.ocio").string()));
    CHECK(contains(failure(folder.path().string()), "it is a directory"));
    write_text(folder / "broken.ocio", "ocio_profile_version: [\n");
    CHECK(contains(failure((folder / "broken.ocio").string()), "cannot read the OpenColorIO configuration"));
    write_text(folder / "picture.ocio", std::string("\x89PNG\r\n\x1a\n\0\0\0", 11));
    const std::string picture = failure((folder / "picture.ocio").string());
    CHECK(contains(picture, "named by $OCIO"));
    CHECK_FALSE(contains(picture, "\n"));

    // Our own file by its name is what is built in.
    const OcioVariable ours(source_directory() + "/tracer/color/phasetree.ocio");
    const glm::vec3 color(0.4f, 0.9f, 3.0f);
    const glm::vec3 named = shown(DisplayTransform(), color);
    const OcioVariable none;
    CHECK(shown(DisplayTransform(), color) == named);
}

TEST_CASE("a foreign configuration gets linear Rec.709 in its own terms") {
    const TemporaryDirectory folder;
    const std::string path = (folder / "foreign.ocio").string();
    const OcioVariable variable(path);
    const std::string data = "  default: AP0\n";

    // Its scene_linear is another space than ours: over ACES2065-1, with the published matrix (Rec.709 D65 to AP0,
    // Bradford, four digits).
    write_text(path, foreign(data + "  scene_linear: AP1\n  aces_interchange: AP0\n", "AP0"));
    const DisplayTransform over_aces;
    CHECK(over_aces.display() == "Projector");
    CHECK(over_aces.view() == "Film");
    CHECK_FALSE(over_aces.is_srgb());
    const glm::mat3 expected(0.4396f, 0.0898f, 0.0175f, 0.3830f, 0.8134f, 0.1115f, 0.1774f, 0.0968f, 0.8710f);
    for (int i = 0; i < 3; ++i) {
        glm::vec3 primary(0.0f);
        primary[i] = 1.0f;
        const glm::vec3 result = shown(over_aces, primary);
        for (int c = 0; c < 3; ++c) CHECK(std::abs(result[c] - expected[i][c]) < 1e-4f);
    }

    // It has a space of the right name.
    write_text(path, foreign(data + "  scene_linear: AP1\n  aces_interchange: AP0\n", "Linear Rec.709 (sRGB)") +
                         "  - !<ColorSpace>\n    name: Linear Rec.709 (sRGB)\n    isdata: false\n"
                         "    to_scene_reference: !<MatrixTransform> {matrix: [2,0,0,0, 0,2,0,0, 0,0,2,0, 0,0,0,1]}\n");
    CHECK(shown(DisplayTransform(), glm::vec3(0.25f)).g == doctest::Approx(0.25));

    // Nothing but scene_linear, then nothing at all.
    write_text(path, foreign(data + "  scene_linear: AP1\n", "AP1"));
    CHECK(shown(DisplayTransform(), glm::vec3(0.25f, 0.5f, 0.75f)).b == doctest::Approx(0.75));
    write_text(path, foreign(data, "AP1"));
    CHECK(contains(message_of<DisplayError>([] { DisplayTransform(); }), "linear Rec.709"));

    // A view whose table is missing fails with the reason.
    write_text(path, foreign(data + "  scene_linear: AP1\n", "Print") +
                         "  - !<ColorSpace>\n    name: Print\n    isdata: false\n"
                         "    from_scene_reference: !<FileTransform> {src: missing.cube}\n");
    const std::string missing = message_of<DisplayError>([] { DisplayTransform(); });
    CHECK(contains(missing, path));
    CHECK(contains(missing, "missing.cube"));
}

}  // namespace test_display
