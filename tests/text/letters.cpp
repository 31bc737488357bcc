// Fonts, by two that have the same letters of known shapes (make_fonts.py): outlines, places, and what is rejected.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>

#include "phasetree/io/error.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/io/write.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/profiles/text.hpp"
#include "phasetree_support/temporary_directory.hpp"
#include "scene/read_parts.hpp"
#include "source_directory.hpp"
#include "text/pen.hpp"
#include "text/read_text.hpp"

namespace test_letters {

using namespace phasetree;

namespace {

namespace fs = std::filesystem;

fs::path font(const std::string& ending) {
    return fs::path(source_directory()) / "tests/text" / ("letters." + ending);
}

Field letters(const std::string& ending, const std::string& text, float spacing = 0, float align = 0) {
    Text node{.text = text, .align = align, .spacing = spacing};
    node.file.content = std::make_shared<const TextOutlines>(tracer::read_text(font(ending), text));
    return node;
}

float at(const Field& f, float x, float y) {
    return distance(f, {x, y, 0.3f});
}

std::string said_of(const fs::path& path, const std::string& text) {
    try {
        (void)tracer::read_text(path, text);
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

std::string refusal(const fs::path& path, const std::string& why) {
    return "cannot use the font \"" + path.string() + "\": " + why;
}

}  // namespace

TEST_CASE("letters have the shapes that the font gives them, by quadratic and by cubic curves") {
    for (const std::string ending : {"ttf", "otf"}) {
        CAPTURE(ending);
        const Field bar = letters(ending, "I");
        CHECK(at(bar, 0.1f, 0.35f) == doctest::Approx(-0.05));
        CHECK(at(bar, 0.02f, 0.35f) == doctest::Approx(0.03));
        CHECK(at(bar, 0.1f, 0.75f) == doctest::Approx(0.05));
        CHECK(at(bar, 0.18f, -0.04f) == doctest::Approx(0.05));

        const Field ring = letters(ending, "O");
        for (int i = 0; i < 200; ++i) {
            const double angle = 0.1 * i, r = 0.4 * i / 200;
            const auto x = static_cast<float>(0.3 + r * std::cos(angle)),
                       y = static_cast<float>(0.35 + r * std::sin(angle));
            // Coordinates are thousandths of the em.
            CHECK(std::abs(static_cast<double>(at(ring, x, y)) - (std::abs(r - 0.25) - 0.05)) < 0.001);
        }
    }
}

TEST_CASE("strokes that cross are one solid, and what is in a hole is solid again") {
    for (const std::string ending : {"ttf", "otf"}) {
        CAPTURE(ending);
        const Field cross = letters(ending, "X");
        CHECK(at(cross, 0.35f, 0.35f) == doctest::Approx(-0.05));
        CHECK(at(cross, 0.35f, 0.65f) == doctest::Approx(-0.05));
        CHECK(at(cross, 0.05f, 0.35f) == doctest::Approx(-0.05));
        CHECK(at(cross, 0.2f, 0.2f) == doctest::Approx(0.1));

        const Field framed = letters(ending, "B");
        CHECK(at(framed, 0.1f, 0.2f) == doctest::Approx(-0.05));
        CHECK(at(framed, 0.175f, 0.2f) == doctest::Approx(0.025));
        CHECK(at(framed, 0.25f, 0.2f) == doctest::Approx(-0.05));
    }
}

TEST_CASE("letters stand where the font, the spacing and the alignment put them") {
    for (const std::string ending : {"ttf", "otf"}) {
        CAPTURE(ending);
        // Between I and O the font takes a tenth of the em away, and nothing between O and I.
        CHECK(tracer::read_text(font(ending), "IO").lines[0].width == doctest::Approx(0.7));
        CHECK(tracer::read_text(font(ending), "OI").lines[0].width == doctest::Approx(0.8));
        CHECK(at(letters(ending, "IO"), 0.4f, 0.35f) == doctest::Approx(0.2).epsilon(0.001));
        // A space is a place of its own.
        CHECK(at(letters(ending, "I I"), 0.6f, 0.35f) == doctest::Approx(-0.05));
        CHECK(at(letters(ending, "I I", 0.1f), 0.8f, 0.35f) == doctest::Approx(-0.05));
        // Lines are as wide as they are without room behind the last letter.
        CHECK(at(letters(ending, "I", 0.1f, 1), -0.1f, 0.35f) == doctest::Approx(-0.05));
        CHECK(at(letters(ending, "II", 0.1f, 0.5f), 0.15f, 0.35f) == doctest::Approx(-0.05));
        CHECK(at(letters(ending, "II", 0.1f, 0.5f), -0.15f, 0.35f) == doctest::Approx(-0.05));
        for (const char* const text : {"B\n\nI", "B\r\n\r\nI"}) {
            const Field lines = letters(ending, text);
            CHECK(at(lines, 0.1f, -2.4f + 0.35f) == doctest::Approx(-0.05));
            CHECK(at(lines, 0.1f, -1.2f + 0.35f) > 0.3f);
            CHECK(at(lines, 0.1f, 0.2f) == doctest::Approx(-0.05));
        }
    }
}

TEST_CASE("a cubic curve is followed within its tolerance, with hardly a kink") {
    const glm::dvec2 p0(0, 0), p1(0.1, 0.9), p2(1.1, -0.4), p3(1, 0.6);
    tracer::Pen pen(1, {0, 0});
    pen.move_to(p0);
    pen.cubic_to(p1, p2, p3);
    pen.line_to({0, 1});
    pen.close();
    REQUIRE(pen.contours.size() == 1);
    double farthest = 0, sharpest = 1;
    glm::dvec2 before(0.0);
    int curves = 0;
    glm::dvec2 last(0.0);
    for_each_curve(pen.contours[0], [&](const QuadraticCurve& curve) {
        // The last two are the straight lines.
        if (static_cast<std::size_t>(++curves) > pen.contours[0].size() / 2 - 2) return;
        if (curves > 1) CHECK(curve.start == last);
        last = curve.end;
        if (curves > 1) sharpest = std::min(sharpest, glm::dot(before, glm::normalize(curve.b())));
        before = glm::normalize(curve.end - curve.control);
        for (int i = 0; i <= 20; ++i) {
            const glm::dvec2 q = curve.at(i / 20.0);
            double nearest = 1;
            for (int k = 0; k <= 40'000; ++k) {
                const double t = k / 40000.0, s = 1 - t;
                const glm::dvec2 c = s * s * s * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t * t * t * p3;
                nearest = std::min(nearest, glm::length(c - q));
            }
            farthest = std::max(farthest, nearest);
        }
    });
    MESSAGE((curves - 2), " curves, at most ", farthest, " away, cosine of the sharpest kink ", sharpest);
    CHECK(farthest < 2e-4);
    CHECK(glm::length(last - p3) < 1e-6);
    // Half a degree, where the curve turns from left to right.
    CHECK(sharpest > 1 - 4e-5);
    CHECK(curves < 20);
}

TEST_CASE("what no text can be made of is rejected in a sentence") {
    const support::TemporaryDirectory directory;
    const fs::path no_font = directory.path() / "a.ttf", folder = directory.path();
    std::ofstream(no_font) << "root:x:0:0";
    CHECK(said_of(font("ttf"), "I Ö") == refusal(font("ttf"), "it has no glyph for \"Ö\""));
    CHECK(said_of(font("otf"), "I\ti") == refusal(font("otf"), "it has no glyph for \"\t\""));
    CHECK(said_of(no_font, "I") == refusal(no_font, "it is not a TrueType or OpenType font (.ttf, .otf)"));
    CHECK(said_of(folder, "I") == refusal(folder, "it is not a regular file"));
    CHECK(said_of(folder / "b", "I") == refusal(folder / "b", "no such file"));
    CHECK(said_of("/dev/zero", "I") == refusal("/dev/zero", "it is not a regular file"));
    CHECK(said_of(font("ttf"), std::string(20'000, 'I')) ==
          refusal(font("ttf"), "the text is longer than 10,000 bytes"));
    CHECK_THROWS_WITH_AS(letters("ttf", " \n "), "text: none of its letters has an outline", ModelError);
    CHECK_THROWS_WITH_AS(letters("ttf", std::string(5000, 'I')),
                         "text: its letters have more than 4096 outlines, or 65536 curves", ModelError);
}

TEST_CASE("a scene's text is read from the font it names, written and read again") {
    const std::string scene =
        R"({"phases": {"a": {}}, "tree": {"set": {"phase": "a", "of": {"text": {"text": "I\nO", "file": ")" +
        font("ttf").string() + R"(", "size": 2}}}}})";
    const FileReaders readers = tracer::file_readers();
    const SceneTree tree = read_tree(Document::from_text(scene), readers);
    CHECK(distances(tree.object, {0.2f, 0.7f, 0})[1] == doctest::Approx(-0.1));
    CHECK(distances(tree.object, {0.6f, -1.7f, 0})[1] == doctest::Approx(0.4).epsilon(0.002));
    const SceneTree again = read_tree(Document::from_text(write_tree(tree)), readers);
    CHECK(write_tree(again) == write_tree(tree));
    CHECK_THROWS_WITH_AS(read_tree(Document::from_text(scene)), doctest::Contains("this program cannot read fonts"),
                         SceneError);
}

}  // namespace test_letters
