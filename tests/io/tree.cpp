// The model of a scene: its maximum depth, and what may be abbreviated.
#include "phasetree/io/tree.hpp"

#include <doctest/doctest.h>
#include <pthread.h>

#include <string>

#include "support/sanitizers.hpp"
#include "tree/node.hpp"

namespace test_tree {

using namespace phasetree;
using tests::under_sanitizer;

namespace {

Phased read(const std::string& tree) {
    return read_tree(Document::from_text(R"({"phases": {"a": 0, "b": 0}, "tree": )" + tree + "}", "scene")).object;
}

std::string error_of(const std::string& tree) {
    try {
        (void)read(tree);
    } catch (const SceneError& e) {
        return e.message();
    }
    return "";
}

const std::string ball = R"({"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}})";  // two nodes

// This many nodes about a ball, each in the longest way of writing it.
std::string nested(const std::string& open, const std::string& close, std::size_t more) {
    std::string text;
    for (std::size_t i = 0; i < more; ++i) text += open;
    text += ball;
    for (std::size_t i = 0; i < more; ++i) text += close;
    return text;
}

// Runs f on a thread with a stack of this many bytes.
template <class F>
void with_stack(std::size_t bytes, F f) {
    pthread_attr_t attributes;
    REQUIRE(::pthread_attr_init(&attributes) == 0);
    REQUIRE(::pthread_attr_setstacksize(&attributes, bytes) == 0);
    pthread_t thread;
    const auto run = [](void* function) -> void* {
        (*static_cast<F*>(function))();
        return nullptr;
    };
    REQUIRE(::pthread_create(&thread, &attributes, run, &f) == 0);
    ::pthread_join(thread, nullptr);
    ::pthread_attr_destroy(&attributes);
}

// Sanitizers put guards around all that is on the stack.
constexpr std::size_t small_stack = under_sanitizer ? 8 << 20 : 1 << 20;  // a megabyte: of any thread of some systems

}  // namespace

TEST_CASE("the deepest tree that there may be can be written in any way, and be read on a small stack") {
    for (const auto& [open, close] : {std::pair(R"({"under": {"of": [)", "]}}"), std::pair(R"({"under": [)", "]}"),
                                      std::pair(R"({"translate": {"by": [0, 0, 0.001], "of": )", "}}"),
                                      std::pair(R"({"grid": {"count_x": 1, "spacing": [3, 3, 3], "of": )", "}}")}) {
        const char* const beginning = open;  // Clang 14 cannot capture a binding
        CAPTURE(beginning);
        std::size_t depth = 0;
        std::string told, told_far_more;
        with_stack(small_stack, [&, open = open, close = close] {
            depth = statistics(read(nested(open, close, max_tree_depth - 2))).depth;
            told = error_of(nested(open, close, max_tree_depth - 1));
            told_far_more = error_of(nested(open, close, 100'000));
        });
        CHECK(depth == max_tree_depth);
        CHECK(told == "the tree is deeper than 400 nodes");
        CHECK(told_far_more == "nested deeper than 1216 levels");
    }
}

TEST_CASE("one number stands for all where the reference says so, and nowhere else") {
    const auto same = [](const std::string& node) {
        CAPTURE(node);
        const auto with = [&](const std::string& number) {
            std::string text = node;
            for (std::size_t at; (at = text.find('#')) != std::string::npos;) text.replace(at, 1, number);
            return text;
        };
        const Phased one = read(with("0.7")), list = read(with("[0.7]"));
        for (const glm::vec3 p : {glm::vec3(0), glm::vec3(0.3f, 0.2f, 0.9f), glm::vec3(1.5f, -0.4f, 0.1f)})
            for (const Phase k : {vacuum, Phase{1}, Phase{2}}) {
                const auto a = distances(one, p), b = distances(list, p);
                CHECK(a.has(k.index) == b.has(k.index));
                if (a.has(k.index)) CHECK(a[k.index] == b[k.index]);
            }
    };
    same(R"({"layers": {"phases": ["a", "b"], "thicknesses": #}})");
    same(R"({"strata": {"phases": ["a", "b", "a"], "thicknesses": #}})");
    same(R"({"instances": {"positions": [[0, 0, 0], [3, 0, 0]], "turns": #, "scales": #, "of": )" + ball + "}}");
    same(R"({"set": {"phase": "a", "of": {"blob": {"points": [[0, 0, 0], [0.3, 0, 0]], "radii": #, "weights": #}}}})");

    CHECK(error_of(R"({"layers": {"phases": ["a", "b"], "thicknesses": "0.7"}})") ==
          "\"thicknesses\" must be a number or a list, but is a string");
    CHECK(error_of(R"({"layers": {"phases": ["a", "b"], "thicknesses": 0}})") ==
          "\"thicknesses\" must be positive, but is 0");
    CHECK(error_of(R"({"layered_sequence": {"phases": ["b"], "thicknesses": 0.7, "of": )" + ball + "}}") ==
          "\"thicknesses\" must be a list, but is a number");
}

TEST_CASE("the parameters of nodes may be spelt in British or American English") {
    const auto balls = [](const std::string& key) {
        return R"({"set": {"phase": "a", "of": {"balls": {")" + key + R"(": [[0.5, 0, 0]], "radii": 0.25}}}})";
    };
    CHECK(distances(read(balls("centers")), glm::vec3(0))[1] == distances(read(balls("centres")), glm::vec3(0))[1]);
    CHECK(error_of(balls("centeres")) == "unknown key \"centeres\" in \"balls\"");
}

TEST_CASE("the reference says what the program does") {
    // intersect_shape and subtract_shape leave a different vacuum if all phases are cut than if only some are.
    const auto vacuum_of = [](const std::string& cut) {
        return distances(read(R"({")" + cut + R"(, "shape": {"plane": {"offset": 5}}, "of": )" + ball + "}}"),
                         {0, 0, 0})[0];
    };
    CHECK(vacuum_of(R"(intersect_shape": {"phases": "a")") == 1);  // min(a₀, −f) = min(1, 5)
    CHECK(vacuum_of(R"(subtract_shape": {"phases": "a")") == -5);  // min(a₀, f)
    const std::string two =
        R"({"under": [)" + ball + R"(, {"set": {"phase": "b", "of": {"sphere": {"radius": 0.5}}}}]})";
    const auto of_two = [&](const std::string& phases) {
        return distances(read(R"({"subtract_shape": {"phases": )" + phases + R"(, "shape": {"plane": {"offset": 0.25}},
            "of": )" + two + "}}"),
                         {0, 0, 0});
    };
    CHECK(of_two(R"(["a", "b"])")[0] == -0.25f);  // f
    CHECK(of_two(R"("a")")[0] == 0.5f);           // max(a₁, f) = max(0.5, −0.25), below a₀ = 1

    // Copies of a grid: i counts fastest, so that of two that overlap the one of the larger k is the later, whatever i.
    const std::string halves =
        R"({"change": {"from": "a", "to": "b", "shape": {"plane": {"normal": [1, 0, 0]}}, "of": )" + ball + "}}";
    const Phased grid = read(R"({"grid": {"count_x": 2, "count_z": 2, "spacing": [1, 1, 0.5], "of": )" + halves + "}}");
    // In (i, k) = (0, 1) it is the half of larger x, "a"; in (1, 0) that of smaller x, "b"; and the former is later
    // unless (1, 1) has it, too.
    CHECK(label(distances(grid, {0.1f, 0, 1.2f})) == Phase{1});
    CHECK(label(distances(grid, {0.5f, 0, 0.2f})) == Phase{2});

    // Over of three: of phases that touch, and of those that overlap, the earliest.
    const auto at = [](const char* phase, const char* x) {
        return std::string(R"({"set": {"phase": ")") + phase + R"(", "of": {"translate": {"by": [)" + x +
               R"(, 0, 0], "of": {"sphere": {"radius": 1}}}}}})";
    };
    const Phased over = read(R"({"over": [)" + at("a", "0") + ", " + at("b", "0.5") + ", " + at("a", "1") + "]}");
    CHECK(label(distances(over, {0.6f, 0, 0})) == Phase{1});
    CHECK(label(distances(over, {1.2f, 0, 0})) == Phase{2});

    // Edges of the solids along the axes, and where coils of either hand are.
    const auto inside = [](const std::string& solid, const glm::vec3& p) {
        return label(distances(read(R"({"set": {"phase": "a", "of": )" + solid + "}}"), p)) == Phase{1};
    };
    const std::string dodecahedron = R"({"dodecahedron": {"radius": 1}})",
                      icosahedron = R"({"icosahedron": {"radius": 1}})";
    for (int x = 0; x < 3; ++x) {
        const int y = (x + 1) % 3, z = (x + 2) % 3;
        const auto beside = [&](float far, int along) {
            glm::vec3 p(0);
            p[x] = far;
            p[along] = 0.3f;
            return p;
        };
        // Half an edge is 0.357 and 0.526, at 0.934 and 0.851.
        CHECK(inside(dodecahedron, beside(0.93f, z)));
        CHECK_FALSE(inside(dodecahedron, beside(0.93f, y)));
        CHECK(inside(icosahedron, beside(0.845f, y)));
        CHECK_FALSE(inside(icosahedron, beside(0.845f, z)));
    }
    for (const auto& [pitch, y] : {std::pair("1", 1.f), std::pair("-1", -1.f)}) {
        const std::string helix =
            std::string(R"({"helix": {"radius": 1, "turns": 1, "wire_radius": 0.1, "pitch": )") + pitch + "}}";
        CHECK(inside(helix, {1, 0, -0.5f}));
        CHECK(inside(helix, {0, y, -0.25f}));
        CHECK_FALSE(inside(helix, {0, -y, -0.25f}));
        CHECK(inside(helix, {1, 0, 0.5f}));
    }
}

TEST_CASE("a text that is one of several words is checked where it is written, before files are read") {
    CHECK(error_of(R"({"set": {"phase": "a", "of": {"mesh": {"file": "none.obj", "rule": "even-odd"}}}})") ==
          "\"rule\" must be one of \"winding_number\", \"even_odd\", \"non_zero\", but is \"even-odd\"");
}

TEST_CASE("a document's files may have to lie in a folder") {
    const Document anywhere = Document::from_text(R"(["a.png", "../a.png", "/etc/passwd"])", "/tmp/scene.json");
    CHECK(anywhere.file(anywhere.root()[1]) == "/tmp/../a.png");
    CHECK(anywhere.file(anywhere.root()[2]) == "/etc/passwd");
    const Document confined = anywhere.with_files_within("/tmp");
    CHECK(confined.file(confined.root()[0]).filename() == "a.png");
    CHECK_THROWS_AS((void)confined.file(confined.root()[1]), SceneError);
    CHECK_THROWS_AS((void)confined.file(confined.root()[2]), SceneError);
    CHECK_THROWS_AS((void)anywhere.with_files_within("/nowhere/at/all"), SceneError);
}

}  // namespace test_tree
