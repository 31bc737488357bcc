// `phasetree check`, `info`, `eval` and `trace`: what other programs read must stay as it is, to the last digit.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "command.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/model/handle.hpp"

namespace test_queries {

using namespace phasetree::tests;

namespace {

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
    std::vector<std::vector<std::string>> rows;
    for (std::size_t from = 0; from < csv.size();) {
        const std::size_t to = std::min(csv.find('\n', from), csv.size());
        std::vector<std::string> cells(1);
        for (const char c : csv.substr(from, to - from)) {
            if (c == ',')
                cells.emplace_back();
            else
                cells.back() += c;
        }
        rows.push_back(cells);
        from = to + 1;
    }
    return rows;
}

// The number, which must be written so that it reads back as itself, and no longer than that.
float number(const std::string& text) {
    float value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    CHECK(error == std::errc());
    CHECK(end == text.data() + text.size());
    CHECK(fmt::format("{}", value) == text);
    return value;
}

SceneText half_full(const char* half_thickness = "0.1") {
    SceneText scene;
    scene.tree = fmt::format(R"({{"change": {{"from": "water", "to": "wood", "shape": {{"plane": {{}}}},
        "of": {{"thin_shell": {{"of": "ball", "shell": "glass", "inside": "water", "half_thickness": {}}}}}}}}})",
                             half_thickness);
    return scene;
}

}  // namespace

TEST_CASE("check says nothing of a good scene") {
    const Shell shell;
    write_text(shell.directory / "scene.json", half_full().text());
    const Outcome o = shell.run({"check", "scene.json"});
    CHECK(o.code == 0);
    CHECK(o.out == "");
    CHECK(o.err == "");
    CHECK(shell.directory.size() == 1);
}

TEST_CASE("an object so far from the origin that few digits are left is warned of, and refused where none are") {
    const Shell shell;
    const auto ball_at = [&](const char* x) {
        SceneText scene;
        scene.shapes = "{}";
        scene.tree = fmt::format(
            R"({{"translate": {{"by": [{}, 0, 0], "of": {{"set": {{"phase": "glass", "of": {{"sphere": {{"radius": 1}}}}}}}}}}}})",
            x);
        return scene.text();
    };
    write_text(shell.directory / "near.json", ball_at("100"));
    write_text(shell.directory / "far.json", ball_at("1e6"));
    write_text(shell.directory / "lost.json", ball_at("1e8"));
    const std::vector<std::vector<std::string>> calls{
        {"check", "SCENE"}, {"info", "SCENE"}, {"trace", "SCENE"}, {"render", "SCENE", "--size", "2x2", "--spp", "1"}};
    for (std::vector<std::string> call : calls) {
        CAPTURE(call[0]);
        const auto run = [&](const char* scene) {
            call[1] = scene;
            return shell.run(call);
        };
        const Outcome near = run("near.json"), far = run("far.json"), lost = run("lost.json");
        CHECK(near.code == 0);
        CHECK(near.err.find("warning") == std::string::npos);
        CHECK(far.code == 0);
        CHECK(far.err.find("far.json: warning: the object has size 3.46 and extends up to 1e+06 from the origin") !=
              std::string::npos);
        CHECK(lost.code == (call[0] == "info" ? 0 : 2));
        CHECK(lost.err.find("move it to the origin") != std::string::npos);
    }
    const Outcome quiet = shell.run({"render", "far.json", "--size", "2x2", "--spp", "1", "--quiet"});
    CHECK(quiet.code == 0);
    CHECK(quiet.err == "");
    // And it is hit, as finely as may be.
    const Outcome traced = shell.run({"trace", "far.json"}, "1000000 0 5 0 0 -1\n");
    const auto rows = rows_of(traced.out);
    REQUIRE(rows.size() == 4);  // the names, the start, in and out
    CHECK(std::abs(std::stof(rows[2][1]) - 4) < 0.5f);
    CHECK(std::abs(std::stof(rows[3][1]) - 6) < 0.5f);
}

TEST_CASE("info, for people and as JSON") {
    const Shell shell;
    write_text(shell.directory / "scene.json", half_full().text());
    const Outcome text = shell.run({"info", "scene.json"});
    CHECK(text.code == 0);
    CHECK(text.out.find("glass, water, wood") != std::string::npos);
    const Outcome o = shell.run({"info", "scene.json", "--json"});
    REQUIRE(o.code == 0);
    const nlohmann::json info = nlohmann::json::parse(o.out);
    CHECK(info.at("nodes") == 4);  // the change, the shell, the ball, the plane
    CHECK(info.at("depth") == 3);
    CHECK(info.at("phases") == nlohmann::json({"glass", "water", "wood"}));
    CHECK(info.at("bounds")[0][2].get<float>() == doctest::Approx(-1.1));
    CHECK(info.at("bounds")[1][0].get<float>() == doctest::Approx(1.1));
    CHECK(info.at("instructions").get<int>() > 2);
    CHECK(info.at("tree_bytes").get<int>() > 0);
    CHECK(!info.contains("cells"));

    const Outcome with_cells = shell.run({"info", "scene.json", "--json", "--cells"});
    REQUIRE(with_cells.code == 0);
    const nlohmann::json cells = nlohmann::json::parse(with_cells.out);
    CHECK(cells.at("cells").get<int>() > 0);
    CHECK(cells.at("routines").get<int>() > 0);
    CHECK(cells.at("cell_bytes").get<int>() > 0);
    CHECK(cells.at("instructions_per_cell").at("median").get<int>() > 0);
    // As a render would make them: between the opaque wood and another opaque phase there are none.
    const std::string tree =
        R"("tree": {"over": [{"set": {"phase": "in", "of": {"sphere": {"radius": 1}}}}, {"set": {"phase": "out", "of": {"sphere": {"radius": 2}}}}]})";
    const auto cells_of = [&](const char* in, const char* out) {
        write_text(shell.directory / "balls.json",
                   fmt::format(R"({{"phases": {{"in": {}, "out": {}}}, {}}})", in, out, tree));
        const Outcome balls = shell.run({"info", "balls.json", "--json", "--cells"});
        REQUIRE(balls.code == 0);
        return nlohmann::json::parse(balls.out).at("cells").get<int>();
    };
    const char *const clear = R"({"clear": {"ior": 1.5}})", *const opaque =
                                                                R"({"diffuse": {"color": [0.5, 0.5, 0.5]}})";
    CHECK(cells_of("0", "0") == cells_of(clear, clear));
    CHECK(cells_of(clear, opaque) == cells_of(clear, clear));
    CHECK(cells_of(opaque, opaque) < 0.9 * cells_of(clear, clear));

    // Where two interfaces are near each other cells of medium quality are finer.
    write_text(shell.directory / "thin.json", half_full("0.01").text());
    std::vector<int> by_quality;
    for (const char* const quality : {"low", "medium"}) {
        const Outcome built = shell.run({"info", "thin.json", "--json", "--cells", "--build-quality", quality});
        REQUIRE(built.code == 0);
        by_quality.push_back(nlohmann::json::parse(built.out).at("cells").get<int>());
    }
    CHECK(by_quality[0] < by_quality[1]);
    const Outcome by_default = shell.run({"info", "thin.json", "--json", "--cells"});
    REQUIRE(by_default.code == 0);
    CHECK(by_quality[1] == nlohmann::json::parse(by_default.out).at("cells").get<int>());
    CHECK(shell.run({"info", "scene.json", "--build-quality", "low"}).code != 0);

    const Outcome in_words = shell.run({"info", "scene.json", "--cells"});
    CHECK(in_words.out.find("different programs") != std::string::npos);
    // Labels and values are in two columns.
    std::istringstream lines(in_words.out);
    for (std::string line; std::getline(lines, line);) {
        CAPTURE(line);
        REQUIRE(line.size() > 14);
        CHECK(line[13] == ' ');
        CHECK(line[14] != ' ');
    }
}

TEST_CASE("eval: phases and distances, in full precision") {
    const Shell shell;
    const std::string text = half_full().text();
    write_text(shell.directory / "scene.json", text);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> coordinate(-1.5f, 1.5f);
    std::string input = "# points\n\n";
    std::vector<glm::vec3> points{{0, 0, 0}, {1, 0, 0}, {3e-7f, -0.1f, 1e5f}};
    while (points.size() < 500) points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    for (std::size_t i = 0; i < points.size(); ++i) {
        const char* const separator = i % 3 == 0 ? " " : i % 3 == 1 ? "," : "\t ";
        input += fmt::format("{}{}{}{}{}{}", points[i].x, separator, points[i].y, separator, points[i].z,
                             i % 2 ? "\n" : "\r\n");
    }
    const Outcome o = shell.run({"eval", "scene.json"}, input);
    REQUIRE(o.code == 0);
    CHECK(o.err == "");
    CHECK(o.out.substr(0, o.out.find('\n')) == "x,y,z,phase,phi.vacuum,phi.glass,phi.water,phi.wood");
    const auto rows = rows_of(o.out);
    REQUIRE(rows.size() == points.size() + 1);
    const auto tree = phasetree::read_tree(phasetree::Document::from_text(text));
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto& row = rows[i + 1];
        REQUIRE(row.size() == 8);
        for (int k = 0; k < 3; ++k) CHECK(number(row[static_cast<std::size_t>(k)]) == points[i][k]);
        const auto phi = phasetree::distances(tree.object, points[i]);
        const float r = glm::length(points[i]);
        for (int k = 0; k < 4; ++k) {
            const float printed = number(row[static_cast<std::size_t>(4 + k)]);
            CHECK(printed == doctest::Approx(phi[k]).epsilon(1e-5));
        }
        CHECK(number(row[4]) == doctest::Approx(1.1f - r).epsilon(1e-5));
        const char* const phase = r > 1.1f ? "vacuum" : r > 0.9f ? "glass" : points[i].z < 0 ? "wood" : "water";
        if (std::abs(r - 1.1f) > 1e-4f && std::abs(r - 0.9f) > 1e-4f && std::abs(points[i].z) > 1e-4f)
            CHECK(row[3] == phase);
    }
}

TEST_CASE("eval leaves phases that are nowhere empty") {
    const Shell shell;
    SceneText scene;
    scene.phases =
        R"({"glass": {"clear": {"ior": 1.5}}, "water": {"clear": {"ior": 1.33}}, "wood": {"diffuse": {"color": [1, 1, 1]}}})";
    write_text(shell.directory / "scene.json", scene.text());
    const Outcome o = shell.run({"eval", "scene.json"}, "0 0 0.5\n");
    CHECK(o.code == 0);
    CHECK(o.out == "x,y,z,phase,phi.vacuum,phi.glass,phi.water,phi.wood\n0,0,0.5,glass,0.5,-0.5,,\n");
}

TEST_CASE("trace: behind a face that a ray leaves at a low angle there is nothing") {
    // A box that is turned by 45° and stands aside, so that its coordinates are rounded.
    const Shell shell;
    write_text(
        shell.directory / "scene.json",
        R"({"version": 1, "phases": {"m": {"clear": {"ior": 1.5}}}, "tree": {"set": {"phase": "m", "of": {"translate":
               {"by": [3, -2, 0], "of": {"rotate": {"angle": 45, "of": {"box": {"size": [1, 0.8, 1]}}}}}}}}})");
    // In the box's own axes, from u = -0.7 on; each goes out of v = 0.4 where u is `out`.
    std::string rays;
    std::vector<double> outs, slopes;
    for (int i = 0; i < 60; ++i) {
        const double out = -0.4 + 0.8 * i / 60, slope = std::pow(10.0, -4 + i % 11 * 0.1);
        const double u = -0.7, v = 0.4 + slope * (u - out), c = std::sqrt(0.5);
        outs.push_back(out);
        slopes.push_back(slope);
        rays += fmt::format("{} {} 0 {} {} 0.2\n", 3 + c * (u - v), -2 + c * (u + v), c * (1 - slope), c * (1 + slope));
    }
    const Outcome o = shell.run({"trace", "scene.json"}, rays);
    REQUIRE(o.code == 0);
    int exits = 0;
    for (const auto& row : rows_of(o.out)) {
        if (row[0] == "ray" || row[2].empty()) continue;
        const auto ray = static_cast<std::size_t>(number(row[0]));
        const double u = -0.7 + static_cast<double>(number(row[1]));
        // Near the face the label is a matter of rounding: values are right to 1e-6 or so.
        CAPTURE(slopes[ray]);
        CAPTURE(outs[ray]);
        if (row[3] == "m" && u < -0.49) continue;
        CHECK(std::abs(u - outs[ray]) < 1e-5 + 1.5e-6 / slopes[ray]);
        exits += row[3] == "vacuum";
    }
    CHECK(exits >= 60);
}

TEST_CASE("trace: every interface along each ray, in order") {
    const Shell shell;
    write_text(shell.directory / "scene.json", half_full().text());
    // Straight down through the middle; the same twice as fast; from inside; past it; within the surface of the wood.
    const Outcome o = shell.run({"trace", "scene.json"},
                                "0.1 0.2 3 0 0 -1\n0.1,0.2,3,0,0,-2\n0 0 0.5 1 0 0\n5 5 5 0 0 1\n0.1 0.2 30 0 0 -1\n");
    REQUIRE(o.code == 0);
    CHECK(o.err == "");
    CHECK(o.out.substr(0, o.out.find('\n')) == "ray,t,from,to,nx,ny,nz");
    struct Row {
        int ray;
        double t;
        const char *from, *to;
        double nx, nz;
    };
    const double outer = std::sqrt(1.1 * 1.1 - 0.05), inner = std::sqrt(0.9 * 0.9 - 0.05);
    std::vector<Row> expected;
    const auto begin = [&](int ray, const char* phase) { expected.push_back({ray, 0, "", phase, 0, 0}); };
    for (const auto& [ray, height, speed] : {std::tuple(0, 3, 1), std::tuple(1, 3, 2), std::tuple(4, 30, 1)}) {
        if (ray == 4) {
            begin(2, "water");
            const double x = std::sqrt(0.9 * 0.9 - 0.25), y = std::sqrt(1.1 * 1.1 - 0.25);
            expected.push_back({2, x, "water", "glass", x / 0.9, 0.5 / 0.9});
            expected.push_back({2, y, "glass", "vacuum", y / 1.1, 0.5 / 1.1});
            begin(3, "vacuum");
        }
        begin(ray, "vacuum");
        const auto add = [&, ray = ray, height = height, speed = speed](double z, const char* from, const char* to,
                                                                        double nx, double nz) {
            expected.push_back({ray, (height - z) / speed, from, to, nx, nz});
        };
        add(outer, "vacuum", "glass", -0.1 / 1.1, -outer / 1.1);
        add(inner, "glass", "water", -0.1 / 0.9, -inner / 0.9);
        add(0, "water", "wood", 0, -1);
        add(-inner, "wood", "glass", 0.1 / 0.9, -inner / 0.9);
        add(-outer, "glass", "vacuum", 0.1 / 1.1, -outer / 1.1);
    }
    const auto rows = rows_of(o.out);
    REQUIRE(rows.size() == expected.size() + 1);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        CAPTURE(i);
        const auto& row = rows[i + 1];
        REQUIRE(row.size() == 7);
        CHECK(row[0] == std::to_string(expected[i].ray));
        CHECK(number(row[1]) == doctest::Approx(expected[i].t).epsilon(1e-5));
        CHECK(row[2] == expected[i].from);
        CHECK(row[3] == expected[i].to);
        if (row[2].empty()) {
            CHECK(row[4] + row[5] + row[6] == "");
            continue;
        }
        CHECK(std::abs(number(row[4]) - expected[i].nx) < 1e-4);
        (void)number(row[5]);
        CHECK(std::abs(number(row[6]) - expected[i].nz) < 1e-4);
    }
}

TEST_CASE("nodes prints the parts of the reference that are named") {
    const Shell shell;
    const std::string all = shell.run({"nodes"}).out;
    const Outcome sphere = shell.run({"nodes", "sphere"});
    CHECK(sphere.code == 0);
    // The shape and the light.
    CHECK(sphere.out.find("Shapes") == 0);
    CHECK(sphere.out.find("\nLights") != std::string::npos);
    CHECK(sphere.out.find("radius") != std::string::npos);
    CHECK(sphere.out.find("  box") == std::string::npos);
    // A chapter is as in the whole reference.
    const std::string cameras = shell.run({"nodes", "cameras"}).out;
    CHECK(cameras.find("Cameras") == 0);
    CHECK(all.find(cameras) != std::string::npos);
    // Members of a scene file stand for the chapters of their kinds.
    CHECK(shell.run({"nodes", "camera"}).out == cameras);
    CHECK(shell.run({"nodes", "phases"}).out == shell.run({"nodes", "materials"}).out);
    CHECK(shell.run({"nodes", "tree"}).out == shell.run({"nodes", "objects"}).out);
    const Outcome cube = shell.run({"nodes", "sphere", "cube"});
    CHECK(cube.code == 2);
    CHECK(cube.out == "");
    CHECK(cube.err == "phasetree: nodes: the reference has no entry \"cube\" (did you mean \"box\"?)\n");
    CHECK(shell.run({"nodes", "qwertyuiop"}).err.find("\"phasetree nodes\" prints all of it") != std::string::npos);
    CHECK(shell.run({"nodes", "sphere", "--json-schema"}).code == 2);
}

}  // namespace test_queries
