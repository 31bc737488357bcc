// Checker, layers and strata at points whose phase and distance are known; lists of numbers, phases and positions in
// scene files.
#include <doctest/doctest.h>

#include <tuple>

#include "phasetree/io/tree.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/phased/checker.hpp"

namespace test_space_filling {

using namespace phasetree;

namespace {

Phased read(std::string text) {
    return read_tree(Document::from_text(std::move(text))).object;
}
std::string scene(const std::string& tree) {
    return R"({"phases": {"a": {}, "b": {}, "c": {}}, "tree": )" + tree + "}";
}
int phase_at(const Phased& object, const glm::vec3& p) {
    return label(distances(object, p)).index;
}

}  // namespace

TEST_CASE("cubes of a checker alternate on both sides of the origin") {
    const Phased checker = Checker{.even = Phase{1}, .odd = Phase{2}, .size = 0.5f, .origin = {0, 0, 0}};
    CHECK(!phases(checker).contains(vacuum));
    for (int i = -3; i < 3; ++i)
        for (int j = -3; j < 3; ++j)
            for (int k = -3; k < 3; ++k) {
                const glm::vec3 p = (glm::vec3(glm::ivec3(i, j, k)) + glm::vec3(0.5f, 0.75f, 0.5f)) * 0.5f;
                const Phases<float> phi = distances(checker, p);
                const bool even = (i + j + k + 30) % 2 == 0;
                CHECK(label(phi) == Phase{static_cast<std::uint8_t>(even ? 1 : 2)});
                CHECK(phi[even ? 1 : 2] == doctest::Approx(-0.125));  // a quarter of the edge from a face
                CHECK(phi[1] == -phi[2]);
            }
}

TEST_CASE("layers repeat, strata end") {
    const std::string lists = R"("phases": ["a", "b", "c"], "direction": [0, 0, 2], "offset": 1, )";
    const Phased layers = read(scene(R"({"layers": {)" + lists + R"("thicknesses": [1, 2, 3]}})"));
    const Phased strata = read(scene(R"({"strata": {)" + lists + R"("thicknesses": [1, 2]}})"));
    for (const auto& [z, repeated, once] : std::vector<std::tuple<float, int, int>>{
             {-4.5f, 1, 1}, {-3, 2, 1}, {0, 3, 1}, {1.5f, 1, 1}, {3, 2, 2}, {5, 3, 3}, {7.5f, 1, 3}, {9, 2, 3}}) {
        const float height = z;  // Clang 14 cannot capture a binding
        CAPTURE(height);
        CHECK(phase_at(layers, {5, -7, z}) == repeated);
        CHECK(phase_at(strata, {5, -7, z}) == once);
    }
    CHECK(distances(layers, {0, 0, 3})[2] == doctest::Approx(-1));
    CHECK(distances(layers, {0, 0, 3})[1] == doctest::Approx(1));
    CHECK(distances(strata, {0, 0, 3})[3] == doctest::Approx(1));
    CHECK(distances(strata, {0, 0, -8})[1] == doctest::Approx(-10));
}

TEST_CASE("what is cut out of a checker has a vacuum") {
    const Phased cube = read(scene(
        R"({"intersect_shape": {"of": {"checker": {"even": "a", "odd": "b", "size": 1}}, "shape": {"box": {"size": [2, 2, 2]}}}})"));
    CHECK(bounds(cube).finite());
    CHECK(phase_at(cube, {0.5f, 0.5f, 0.5f}) == 1);
    CHECK(phase_at(cube, {-0.5f, 0.5f, 0.5f}) == 2);
    CHECK(phase_at(cube, {-1.5f, 0.5f, 0.5f}) == 0);
}

TEST_CASE("copies stand where a scene file lists them") {
    const Phased balls = read(scene(
        R"({"set": {"phase": "a", "of": {"instances": {"of": {"box": {"size": [2, 0.2, 0.2]}}, "positions": [[0, 0, 0], [5, 0, 0]], "turns": [0, 90], "scales": [1, 2]}}}})"));
    CHECK(phase_at(balls, {0.9f, 0, 0}) == 1);
    CHECK(phase_at(balls, {0, 0.9f, 0}) == 0);
    CHECK(phase_at(balls, {5, 1.9f, 0}) == 1);
    CHECK(phase_at(balls, {5.9f, 0, 0}) == 0);
    const Phased ring = read(scene(
        R"({"polar_array": {"count": 4, "of": {"translate": {"by": [3, 0, 0], "of": {"set": {"phase": "b", "of": {"sphere": {"radius": 1}}}}}}}})"));
    for (const glm::vec3 p : {glm::vec3(3, 0, 0), glm::vec3(0, 3, 0), glm::vec3(-3, 0, 0), glm::vec3(0, -3, 0)})
        CHECK(phase_at(ring, p) == 2);
    CHECK(phase_at(ring, {0, 0, 0}) == 0);
    const Phased rows = read(scene(
        R"({"grid": {"spacing": [3, 4, 1], "count_x": 3, "count_y": 2, "of": {"set": {"phase": "c", "of": {"sphere": {"radius": 1}}}}}})"));
    CHECK(bounds(rows).low == glm::vec3(-1));
    CHECK(bounds(rows).high == glm::vec3(7, 5, 1));
    CHECK(phase_at(rows, {6, 4, 0}) == 3);
    CHECK(phase_at(rows, {9, 4, 0}) == 0);
}

TEST_CASE("lists that do not fit are rejected in words") {
    const auto refused = [](const std::string& tree) -> std::string {
        try {
            (void)read(scene(tree));
        } catch (const std::exception& e) {
            return e.what();
        }
        return "accepted";
    };
    const auto says = [&](const std::string& tree, const char* what) {
        CAPTURE(refused(tree));
        CHECK(refused(tree).find(what) != std::string::npos);
    };
    says(R"({"layers": {"phases": ["a"], "thicknesses": [1]}})", "at least two phases are required");
    says(R"({"layers": {"phases": ["a", "b", "c"], "thicknesses": [1, 2]}})", "one entry per phase, or one for all");
    says(R"({"strata": {"phases": ["a", "b", "c"], "thicknesses": [1, 2, 3]}})", "one entry per phase but the last");
    says(R"({"strata": {"phases": ["a", "b"], "thicknesses": [-1]}})", "\"thicknesses\"");
    says(R"({"strata": {"phases": ["a", "d"], "thicknesses": [1]}})",
         "unknown phase \"d\"; the phases are \"a\", \"b\", \"c\"");
    says(R"({"strata": {"phases": ["a", "b"], "thicknesses": "thin"}})", "\"thicknesses\" must be a number or a list");
    CHECK(refused(R"({"strata": {"phases": ["a", "b"], "thicknesses": 1}})") == "accepted");  // one stands for all
    says(R"({"checker": {"even": "a", "odd": "a", "size": 1}})", "both phases are the same");
    says(R"({"polar_array": {"count": 0, "of": {"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}}}})",
         "\"count\"");
    says(
        R"({"instances": {"of": {"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}}, "positions": [[0, 0, 0], [1, 0, 0]], "turns": [1, 2, 3]}})",
        "need an entry for each position");
}

}  // namespace test_space_filling
