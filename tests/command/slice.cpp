// `phasetree slice`: outlines of circles and boxes have the areas and places of closed forms, phases in contact share
// them, labels are right pixel by pixel, and mistakes are reported in words.
#include <sched.h>

#include <array>
#include <cmath>
#include <csignal>
#include <map>
#include <optional>
#include <span>
#include <sstream>

#include "command.hpp"
#include "image/read_image.hpp"

namespace test_slice {

using namespace phasetree::tests;

namespace {

constexpr double pi = 3.141592653589793;

using Point = std::array<double, 2>;
using Polygon = std::vector<Point>;

double area_of(const Polygon& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        twice += a[0] * b[1] - a[1] * b[0];
    }
    return 0.5 * twice;
}

// What is in an SVG file: the polygons of each phase.
struct Drawing {
    std::map<std::string, std::vector<Polygon>> phases;

    double area(const std::string& phase) const {
        double sum = 0;
        for (const Polygon& polygon : phases.at(phase)) sum += area_of(polygon);
        return sum;
    }
};

std::string attribute(const std::string& tag, const std::string& name) {
    const std::size_t at = tag.find(" " + name + "=\"");
    REQUIRE(at != std::string::npos);
    const std::size_t begin = at + name.size() + 3;
    return tag.substr(begin, tag.find('"', begin) - begin);
}

Drawing drawing_of(const std::string& svg) {
    Drawing drawing;
    for (std::size_t at = svg.find("<path data-phase="); at != std::string::npos;
         at = svg.find("<path data-phase=", at + 1)) {
        const std::string tag = svg.substr(at, svg.find("/>", at) - at);
        std::vector<Polygon>& polygons = drawing.phases[attribute(tag, "data-phase")];
        std::istringstream data(attribute(tag, "d"));
        for (char command = 0; data >> command;) {
            if (command == 'M') polygons.emplace_back();
            if (command == 'Z') continue;
            REQUIRE((command == 'M' || command == 'L'));
            Point p{};
            REQUIRE((data >> p[0] >> p[1]));
            polygons.back().push_back(p);
        }
    }
    return drawing;
}

// Whether each tag is closed by its own, and nothing is left open.
bool is_well_formed(const std::string& xml) {
    std::vector<std::string> open;
    for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
        const std::size_t end = xml.find('>', at);
        if (end == std::string::npos) return false;
        const std::string tag = xml.substr(at + 1, end - at - 1);
        if (tag.find('<') != std::string::npos) return false;
        const std::string name = tag.substr(tag[0] == '/' ? 1 : 0, tag.find(' ') - (tag[0] == '/' ? 1 : 0));
        if (tag[0] == '?' || tag.ends_with('/')) continue;
        if (tag[0] != '/') {
            open.push_back(name);
        } else {
            if (open.empty() || open.back() != name) return false;
            open.pop_back();
        }
    }
    return open.empty() && xml.find("&#") == std::string::npos;
}

struct SliceShell : Shell {
    explicit SliceShell(const std::string& tree, const std::string& phases = R"("glass": null)") { set(tree, phases); }
    void set(const std::string& tree, const std::string& phases = R"("glass": null)") const {
        write_text(directory / "scene.json", R"({"version": 1, "phases": {)" + phases + R"(}, "tree": )" + tree + "}");
    }
    Outcome slice(const std::vector<std::string>& more) const {
        std::vector<std::string> words{"slice", "scene.json"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
    Drawing drawing(const std::vector<std::string>& more) const {
        const Outcome o = slice(more);
        CAPTURE(o.err);
        REQUIRE(o.code == 0);
        CHECK(o.err == "");
        CHECK(o.out == "");
        const std::string svg = bytes_of(directory / "slice.svg");
        CHECK(is_well_formed(svg));
        return drawing_of(svg);
    }
};

const std::string ball = R"({"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}})";
const std::string box = R"({"set": {"phase": "glass", "of": {"box": {"size": [1, 2, 3]}}}})";

}  // namespace

TEST_CASE("the outline of a ball is a circle, within the tolerance") {
    const SliceShell shell(ball);
    struct Cut {
        std::vector<std::string> words;
        double height, tolerance;
    };
    for (const Cut& cut : {Cut{{"--z", "0.6"}, 0.6, 2e-3}, Cut{{"--x", "-0.3", "--tolerance", "0.02"}, 0.3, 0.02},
                           Cut{{"--y", "0", "--tolerance", "0.0005"}, 0, 5e-4}}) {
        CAPTURE(cut.words);
        const Drawing drawing = shell.drawing(cut.words);
        REQUIRE(drawing.phases.size() == 1);
        const std::vector<Polygon>& polygons = drawing.phases.at("glass");
        REQUIRE(polygons.size() == 1);
        const double r = std::sqrt(1 - cut.height * cut.height);
        // Corners are on the circle, and the middles of sides are within the tolerance.
        for (std::size_t i = 0; i < polygons[0].size(); ++i) {
            const Point &a = polygons[0][i], &b = polygons[0][(i + 1) % polygons[0].size()];
            CHECK(std::abs(std::hypot(a[0], a[1]) - r) < 0.02 * cut.tolerance + 1e-6);
            CHECK(std::abs(std::hypot(0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])) - r) < 0.2 * cut.tolerance);
        }
        CHECK(std::abs(drawing.area("glass") - pi * r * r) < 2 * pi * r * 0.1 * cut.tolerance);
        // Few corners are needed.
        CHECK(static_cast<double>(polygons[0].size()) < 30 / std::sqrt(cut.tolerance));
    }
}

TEST_CASE("the outlines of a box have its sides, and coordinates are those of the scene") {
    const SliceShell shell(R"({"translate": {"by": [10, 20, 30], "of": )" + box + "}}");
    struct Cut {
        std::vector<std::string> words;
        Point low, high;
    };
    for (const Cut& cut : {Cut{{"--z", "30.3"}, {9.5, 19}, {10.5, 21}}, Cut{{"--y", "20.1"}, {9.5, 28.5}, {10.5, 31.5}},
                           Cut{{"--x", "9.9"}, {19, 28.5}, {21, 31.5}}}) {
        const Drawing drawing = shell.drawing(cut.words);
        const std::vector<Polygon>& polygons = drawing.phases.at("glass");
        REQUIRE(polygons.size() == 1);
        CHECK(polygons[0].size() <= 12);
        Point low = polygons[0][0], high = low;
        for (const Point& p : polygons[0])
            for (std::size_t k = 0; k < 2; ++k) {
                low[k] = std::min(low[k], p[k]);
                high[k] = std::max(high[k], p[k]);
            }
        for (std::size_t k = 0; k < 2; ++k) {
            CHECK(std::abs(low[k] - cut.low[k]) < 1e-4);
            CHECK(std::abs(high[k] - cut.high[k]) < 1e-4);
        }
        const double area = (cut.high[0] - cut.low[0]) * (cut.high[1] - cut.low[1]);
        CHECK(std::abs(drawing.area("glass") - area) < 1e-4 * area);
    }
}

TEST_CASE("phases in contact share their outlines: areas add up to that of the whole") {
    // A box that is divided into three phases by a ball and a slanted plane, with a bubble in it.
    const SliceShell shell(R"({"subtract_shape": {"shape": {"sphere": {"radius": 0.2}}, "of": {"over": [
        {"set": {"phase": "a", "of": {"intersection": [{"sphere": {"radius": 0.8}}, {"box": {"size": [2, 2, 2]}}]}}},
        {"set": {"phase": "b", "of": {"intersection": [{"plane": {"normal": [1, 2, 0.5], "offset": 0.1}},
                                                       {"box": {"size": [2, 2, 2]}}]}}},
        {"set": {"phase": "c", "of": {"box": {"size": [2, 2, 2]}}}}]}}})",
                           R"("a": null, "b": null, "c": null)");
    const Outcome o = shell.slice({"--z", "0.05", "--tolerance", "0.01"});
    CAPTURE(o.err);
    REQUIRE(o.code == 0);
    const Drawing drawing = drawing_of(bytes_of(shell.directory / "slice.svg"));
    REQUIRE(drawing.phases.size() == 3);
    const double hole = pi * (0.04 - 0.0025);
    CHECK(std::abs(drawing.area("a") - (pi * (0.64 - 0.0025) - hole)) < 5e-3);
    CHECK(std::abs(drawing.area("a") + drawing.area("b") + drawing.area("c") - (4 - hole)) < 2e-3);
    // Each side belongs to a phase on its left, and in the other direction to the phase on its right, or to the vacuum.
    std::map<std::pair<Point, Point>, int> sides;
    for (const auto& [phase, polygons] : drawing.phases)
        for (const Polygon& polygon : polygons)
            for (std::size_t i = 0; i < polygon.size(); ++i) ++sides[{polygon[i], polygon[(i + 1) % polygon.size()]}];
    std::map<Point, int> ends;  // of sides beside the vacuum
    std::size_t shared = 0;
    for (const auto& [side, count] : sides) {
        CHECK(count == 1);
        if (sides.contains({side.second, side.first})) {
            ++shared;
            continue;
        }
        ++ends[side.first];
        --ends[side.second];
        // On the faces of the box, or around the bubble.
        const Point middle{0.5 * (side.first[0] + side.second[0]), 0.5 * (side.first[1] + side.second[1])};
        const double from_box = 1 - std::max(std::abs(middle[0]), std::abs(middle[1]));
        const double from_hole = std::hypot(middle[0], middle[1]) - std::sqrt(0.04 - 0.0025);
        CHECK(std::min(std::abs(from_box), std::abs(from_hole)) < 0.01);
    }
    CHECK(shared > 20);
    for (const auto& [point, balance] : ends) CHECK(balance == 0);
}

TEST_CASE("names of phases are escaped, and the legend has areas and a scale bar") {
    const SliceShell shell(R"({"set": {"phase": "<a> & \"b\"\u0001", "of": {"sphere": {"radius": 0.05}}}})",
                           R"("<a> & \"b\"\u0001": null)");
    REQUIRE(shell.slice({"--z", "0"}).code == 0);
    const std::string svg = bytes_of(shell.directory / "slice.svg");
    CHECK(is_well_formed(svg));
    CHECK(svg.find("&lt;a&gt; &amp; &quot;b&quot;?, 0.00785") != std::string::npos);
    CHECK(svg.find(">2 cm, z = 0</text>") != std::string::npos);
    REQUIRE(shell.slice({"--z", "0", "--unit", "in"}).code == 0);
    CHECK(bytes_of(shell.directory / "slice.svg").find(">0.02 in, z = 0</text>") != std::string::npos);
}

TEST_CASE("outlines are thin on the page, however large the object") {
    for (const char* const radius : {"0.001", "1", "1000"}) {
        const SliceShell shell(R"({"set": {"phase": "glass", "of": {"sphere": {"radius": )" + std::string(radius) +
                               "}}}}");
        REQUIRE(shell.slice({"--z", "0"}).code == 0);
        const std::string svg = bytes_of(shell.directory / "slice.svg");
        const std::size_t at = svg.find("<g ");
        REQUIRE(at != std::string::npos);
        const std::string group = svg.substr(at, svg.find('>', at) - at);
        const std::string matrix = attribute(group, "transform");
        const double scale = std::stod(matrix.substr(matrix.find('(') + 1));
        CHECK(scale * std::stod(attribute(group, "stroke-width")) == doctest::Approx(0.6).epsilon(1e-4));
        // Some programs ignore it.
        CHECK(svg.find("vector-effect") == std::string::npos);
    }
}

TEST_CASE("a picture does not depend on threads") {
    SliceShell shell(
        R"({"under": [)" + ball + R"(, {"set": {"phase": "gold", "of": {"torus": {"major": 1, "minor": 0.4}}}}]})",
        R"("glass": null, "gold": null)");
    const std::vector<std::string> words{"--y", "0.1", "-o"};
    const auto slice_to = [&](const std::string& file) {
        std::vector<std::string> all = words;
        all.push_back(file);
        CHECK(shell.slice(all).code == 0);
        return bytes_of(shell.directory / file);
    };
    const std::string svg = slice_to("a.svg"), png = slice_to("a.png");
    shell.in_child = [] {
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(::sched_getcpu(), &one);
        ::sched_setaffinity(0, sizeof one, &one);
    };
    CHECK(slice_to("b.svg") == svg);
    CHECK(slice_to("b.png") == png);
}

TEST_CASE("the pixels of a PNG are the labels at their centres") {
    const SliceShell shell(R"({"over": [{"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}},
        {"set": {"phase": "gold", "of": {"translate": {"by": [0, 0, 1], "of": {"box": {"size": [4, 2, 1]}}}}}}]})",
                           R"("glass": null, "gold": null)");
    REQUIRE(shell.slice({"--y", "0.1", "-o", "a.png", "--size", "80"}).code == 0);
    const std::filesystem::path file = shell.directory / "a.png";
    std::vector<float> values;
    phasetree::tracer::read_labels(
        file, "labels",
        [](const phasetree::tracer::ImageHeader& header) {
            CHECK(header.width == 80);
            CHECK(header.height == 50);
            return phasetree::tracer::ChannelRange(0, 1);
        },
        [&](std::span<const float> rows) { values.insert(values.end(), rows.begin(), rows.end()); });
    REQUIRE(values.size() == 4000);
    std::size_t differing = 0;
    for (int row = 0; row < 50; ++row)
        for (int column = 0; column < 80; ++column) {
            const double x = -2 + (column + 0.5) * 0.05, z = 1.5 - (row + 0.5) * 0.05;
            const int expected = x * x + z * z + 0.01 < 1 ? 1 : std::abs(z - 1) < 0.5 ? 2 : 0;
            differing += std::lround(255 * values[static_cast<std::size_t>(80 * row + column)]) != expected;
        }
    CHECK(differing <= 8);  // centres on an outline
}

TEST_CASE("stacks are numbered, and reach from the first position to the last") {
    const SliceShell shell(ball);
    REQUIRE(shell.slice({"--count", "4", "-o", "a.##.svg"}).code == 0);
    REQUIRE(shell.slice({"--axis", "x", "--count", "3", "--from", "-0.5", "--to", "0.5", "-o", "b.#.svg"}).code == 0);
    CHECK(shell.directory.size() == 8);
    for (int i = 0; i < 4; ++i) {
        const double z = -0.75 + 0.5 * i;
        CHECK(std::abs(drawing_of(bytes_of(shell.directory / ("a.0" + std::to_string(i) + ".svg"))).area("glass") -
                       pi * (1 - z * z)) < 5e-3);
    }
    CHECK(bytes_of(shell.directory / "b.0.svg").find("x = -0.5") != std::string::npos);
    CHECK(bytes_of(shell.directory / "b.1.svg").find("x = 0") != std::string::npos);
    CHECK(bytes_of(shell.directory / "b.2.svg").find("x = 0.5") != std::string::npos);
    // Part of a stack may be outside of the object.
    CHECK(shell.slice({"--count", "3", "--from", "-2", "--to", "0", "-o", "c.#.svg"}).code == 0);
}

TEST_CASE("stacks fit an object that fills only a part of its tree's box, and their pages have one size") {
    // A box whose upper half is cut away, over a smaller one.
    const SliceShell shell(R"({"over": [
        {"set": {"phase": "glass", "of": {"difference": {"from": {"box": {"size": [2, 2, 2]}},
            "subtract": [{"translate": {"by": [0, 0, 1], "of": {"box": {"size": [4, 4, 2]}}}}]}}}},
        {"set": {"phase": "water", "of": {"translate": {"by": [0, 0, -1.25], "of": {"box": {"size": [1, 1, 0.5]}}}}}}]})",
                           R"("glass": null, "water": null)");
    REQUIRE(shell.slice({"--count", "6", "-o", "a.#.svg"}).code == 0);
    std::string height;
    for (int i = 0; i < 6; ++i) {
        const std::string svg = bytes_of(shell.directory / ("a." + std::to_string(i) + ".svg"));
        CHECK_FALSE(drawing_of(svg).phases.empty());
        const std::string of_page = attribute(svg.substr(svg.find("<svg")), "height");
        CHECK((height.empty() || height == of_page));
        height = of_page;
    }
    const Outcome beyond = shell.slice({"--z", "0.5"});
    CHECK(beyond.code == 2);
    CHECK(beyond.err.find("does not meet the object, which extends from -1.5") != std::string::npos);
    CHECK(beyond.err.find(" to 1") == std::string::npos);
}

TEST_CASE("Ctrl-C keeps the slices that are finished") {
    const SliceShell shell(ball);
    std::optional<double> ready;
    bool is_sent = false;
    const auto interrupt = [&](pid_t process) {
        if (!ready && catches(process, SIGINT)) ready = processor_seconds(process);
        if (is_sent || !ready || shell.directory.size() < 3) return;
        is_sent = true;
        ::kill(process, SIGINT);
    };
    const Outcome o = shell.run({"slice", "scene.json", "--count", "50000", "-o", "a.#####.svg"}, "", interrupt);
    CAPTURE(o.err);
    CHECK(is_sent);
    CHECK(o.code == 130);
    CHECK(o.err.find(" of 50000 files written\n") != std::string::npos);
    for (const auto& entry : std::filesystem::directory_iterator(shell.directory.path()))
        if (entry.path().extension() == ".svg") CHECK(is_well_formed(bytes_of(entry.path())));
}

TEST_CASE("mistakes are reported in words: one error, exit code 2, or 1 if output cannot be written") {
    const SliceShell shell(box);
    struct Mistake {
        std::vector<std::string> words;
        std::string message;
        int code = 2;
    };
    const std::vector<Mistake> mistakes{
        {{}, "slice: give the plane, as in --z 0.3, or a stack, as in --count 100"},
        {{"--x", "0", "--z", "0"}, "slice: choose one of --x, --y and --z"},
        {{"--z", "0", "--count", "3", "-o", "a.#.svg"}, "choose one of --x, --y, --z, or --count"},
        {{"--z", "0", "--from", "1"}, "--from and --to need --count"},
        {{"--count", "2", "--from", "1", "-o", "a.#.svg"}, "give both --from and --to"},
        {{"--count", "2", "--from", "1", "--to", "1", "-o", "a.#.svg"}, "--from must be less than --to"},
        {{"--count", "2"}, "--output slice.svg: each slice needs its own file; put #### in the name"},
        {{"--z", "0", "--size", "500"}, "slice: --size is for .png; an .svg scales to any size"},
        {{"--count", "0"}, "--count"},
        {{"--count", "-1"}, "--count"},
        {{"--count", "99999999999"}, "--count"},
        {{"--count", "1e3"}, "--count"},
        {{"--count", "2", "--axis", "w"}, "--axis"},
        {{"--z", "nan"}, "--z"},
        {{"--z", "inf"}, "--z"},
        {{"--z", "1e30"}, "--z"},
        {{"--z", "up"}, "--z"},
        {{"--z", "4"}, "slice: z = 4 does not meet the object, which extends from -1.5"},
        {{"--count", "2", "--from", "4", "--to", "5", "-o", "a.#.svg"},
         "slice: z = 4 and the other planes do not meet"},
        {{"--z", "0", "--tolerance", "0"}, "--tolerance"},
        {{"--z", "0", "--tolerance", "nan"}, "--tolerance"},
        {{"--z", "0", "--tolerance", "100"}, "--tolerance: must be less than the object's longest side, 3.0"},
        {{"--z", "0", "--tolerance", "1e-9"}, "a tolerance of 1e-09 is too fine for a slice that is 2"},
        {{"--z", "0", "--size", "0", "-o", "a.png"}, "--size"},
        {{"--z", "0", "--size", "1000000", "-o", "a.png"}, "--size"},
        {{"--z", "0", "--unit", "ell"}, "--unit: unknown unit \"ell\""},
        {{"--z", "0", "--object", "bottle"}, "--object: the scene has a single \"tree\""},
        {{"--z", "0", "-o", "a.pdf"}, "cannot write \"a.pdf\": unknown format \".pdf\"; use .svg or .png"},
        {{"--z", "0", "-o", "a"}, "cannot write \"a\": its name has no extension; use .svg or .png"},
        {{"--z", "0", "-o", ""}, "its name has no extension"},
        {{"--z", "0", "-o", "nowhere/a.svg"}, "nowhere/a.svg", 1}};
    for (const Mistake& m : mistakes) {
        CAPTURE(m.words);
        const Outcome o = shell.slice(m.words);
        CAPTURE(o.err);
        CHECK(o.code == m.code);
        CHECK(o.out == "");
        CHECK(o.err.find(m.message) != std::string::npos);
        CHECK(o.err.size() < 500);
        CHECK(o.processor_seconds < at_once);
        CHECK(shell.directory.size() == 1);
    }
    shell.set(R"({"set": {"phase": "glass", "of": {"plane": {}}}})");
    const Outcome unbounded = shell.slice({"--z", "-1"});
    CHECK(unbounded.code == 2);
    CHECK(unbounded.err.find("unbounded") != std::string::npos);
}

TEST_CASE("a plane in a face, or noise finer than the tolerance, neither hangs nor exhausts memory") {
    const SliceShell shell(
        R"({"set": {"phase": "glass", "of": {"displace": {"amplitude": 0.01, "scale": 0.001, "octaves": 6,
        "of": {"box": {"size": [2, 2, 0.01]}}}}}})");
    const Outcome noise = shell.slice({"--z", "0.005"});
    CAPTURE(noise.err);
    CHECK((noise.code == 0 || noise.code == 2));
    CHECK(noise.peak_megabytes < 1500);
    shell.set(box);
    const Outcome face = shell.slice({"--z", "1.5"});
    CAPTURE(face.err);
    CHECK((face.code == 0 || face.code == 2));
}

}  // namespace test_slice
