// Shaders compute what the CPU computes: tests every node on a real OpenGL.
#include <doctest/doctest.h>

#include <algorithm>
#include <functional>

#include "evaluation/assemble.hpp"
#include "evaluation/interpret.hpp"
#include "gl_context.hpp"
#include "objects.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/glsl/shader.hpp"
#include "rounded.hpp"
#include "support/random_tree.hpp"

namespace test_nodes {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

constexpr int point_count = 256;

// A tenth of the points are where ties are; their fourth coordinate is 1.
std::vector<glm::vec4> random_points(Random& rng, const Bounds& region) {
    std::vector<glm::vec4> points;
    for (int i = 0; i < point_count; ++i) {
        const glm::vec3 p = rng.in(region);
        if (rng.chance(0.1))
            points.emplace_back(glm::round(p * 4.f) / 4.f, 1);
        else
            points.emplace_back(p, 0);
    }
    return points;
}

// Φ of a program with bounds of the rounding error.
std::vector<Rounded> rounded_distances(const Program& program, const glm::vec3& p) {
    std::vector<program::ProgramOutput> outputs;
    for (const Output& o : program.outputs) outputs.push_back({o.phase, o.value, false});
    const evaluation::Assembly assembly = evaluation::assemble(program.instructions, outputs);
    std::vector<Rounded> registers(assembly.slots);
    for (int i = 0; i < 3; ++i) registers[static_cast<std::size_t>(i)] = Rounded(p[i]);
    evaluation::interpret(
        evaluation::RoutineSteps(assembly.routine(program.constants.data())), registers.data(),
        []<class P>(std::size_t, const float* floats, const Vec3<Rounded>& q, Rounded& to) {
            to = program::distance_of<P>(floats, q);
        },
        [](const Rounded&) {});
    std::vector<Rounded> result;
    for (const auto& o : assembly.outputs) result.push_back(registers[o.slot]);
    return result;
}

// What is compared of an object, and how many of it.
struct Comparison {
    int values = 0, wrong_values = 0;  // components of Φ
    int labels = 0, wrong_labels = 0;  // where the label is not a matter of rounding
    int gradients = 0, wrong_gradients = 0;
    int in_doubt = 0;  // values of which error analysis says too little to compare them
    double largest_tolerance = 0, worst = 0;

    void add(const Comparison& o) {
        values += o.values, wrong_values += o.wrong_values;
        labels += o.labels, wrong_labels += o.wrong_labels;
        gradients += o.gradients, wrong_gradients += o.wrong_gradients;
        in_doubt += o.in_doubt;
        largest_tolerance = std::max(largest_tolerance, o.largest_tolerance);
        worst = std::max(worst, o.worst);
    }
};

const char* const comparing_main = R"(
uniform highp sampler2D points;
out vec4 result;
void main() {
    vec3 p = texelFetch(points, ivec2(int(gl_FragCoord.x), 0), 0).xyz;
    int row = int(gl_FragCoord.y);
    float phi[PHASETREE_COMPONENTS];
    phasetree_distances(p, phi);
    if (row == 0) {
        float s;
        int label = phasetree_sample(p, s);
        result = vec4(float(label), s, 0.0, 0.0);
    } else if (row <= PHASETREE_COMPONENTS) {
        result = vec4(phi[row - 1], 0.0, 0.0, 0.0);
    } else {
        vec4 slopes[PHASETREE_COMPONENTS];
        phasetree_gradients(p, slopes);
        result = slopes[row - 1 - PHASETREE_COMPONENTS];
    }
}
)";

// Where gradients are compared. On the axis of a helix, for example, 0/0 stands in a derivative, and what becomes of it
// in 32 bits depends on the compiler; the examples do not meet such places.
enum class Gradients { everywhere, except_at_ties };

// `change` may plant a defect in the text.
Comparison compared(const GlContext& gl, const Phased& object, Random& rng, const GlslOptions& options,
                    Gradients gradients = Gradients::everywhere,
                    const std::function<std::string(std::string)>& change = {}) {
    const Evaluator evaluator(record(object));
    const Program& program = evaluator.program();
    const Bounds region = region_of_interest(bounds(object));
    const std::vector<glm::vec4> points = random_points(rng, region);
    const GlslShader shader = make_glsl(program, region, 1e-5f, options);
    const int components = static_cast<int>(program.outputs.size());
    const std::vector<glm::vec4> got = gl.run((change ? change(shader.text) : shader.text) + comparing_main, points,
                                              shader.numbers, point_count, 1 + 2 * components);
    Comparison c;
    Evaluator::Workspace w;
    // Beyond this part of the region's size an error bound says nothing.
    const double size = static_cast<double>(region.diagonal()), most = 1e-2 * size;
    for (int i = 0; i < point_count; ++i) {
        const glm::vec3 p(points[static_cast<std::size_t>(i)]);
        const Phases<float> expected = evaluator.distances(p, w);
        const std::vector<Rounded> bound = rounded_distances(program, p);
        const auto at = [&](int row) { return got[static_cast<std::size_t>(row * point_count + i)]; };
        double largest = 0;
        for (int k = 0; k < components; ++k) {
            const Phase phase = program.outputs[static_cast<std::size_t>(k)].phase;
            const double value = expected[phase.index], tolerance = 2 * bound[static_cast<std::size_t>(k)].error;
            largest = std::max(largest, tolerance);
            if (!(tolerance < most)) {
                ++c.in_doubt;
                continue;
            }
            c.largest_tolerance = std::max(c.largest_tolerance, tolerance);
            for (const double v : {static_cast<double>(at(1 + k).x), static_cast<double>(at(1 + components + k).w)}) {
                ++c.values;
                c.wrong_values += !(std::abs(v - value) <= tolerance);
                c.worst = std::max(c.worst, std::abs(v - value));
            }
            if (gradients == Gradients::except_at_ties && points[static_cast<std::size_t>(i)].w > 0) continue;
            // Near an edge either side's gradient is right. So it is compared where it is that of all points about.
            const glm::vec3 g = evaluator.gradient(p, phase);
            const float h = 1e-4f * static_cast<float>(size);
            bool is_smooth = true;
            for (int corner = 0; corner < 8 && is_smooth; ++corner) {
                const glm::vec3 q = p + h * glm::vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
                is_smooth = glm::length(evaluator.gradient(q, phase) - g) < 2e-2f;
            }
            if (!is_smooth) continue;
            ++c.gradients;
            c.wrong_gradients += !(glm::length(glm::vec3(at(1 + components + k)) - g) < 3e-2f);
        }
        float s = 0;
        {
            std::vector<float> sorted;
            for (const Output& o : program.outputs) sorted.push_back(expected[o.phase.index]);
            std::ranges::sort(sorted);
            s = sorted.size() > 1 ? sorted[1] - sorted[0] : 1e9f;
        }
        if (static_cast<double>(s) <= 2 * largest) continue;
        ++c.labels;
        c.wrong_labels += at(0).x != static_cast<float>(phasetree::label(expected).index);
    }
    return c;
}

void check(const Comparison& c) {
    CHECK(c.wrong_values == 0);
    CHECK(c.wrong_labels == 0);
    CHECK(c.wrong_gradients == 0);
}

void tell(const std::string& what, const Comparison& c) {
    MESSAGE(what << ": " << c.values << " values, " << c.labels << " labels, " << c.gradients << " gradients; "
                 << c.in_doubt << " values in doubt; largest tolerance " << c.largest_tolerance
                 << ", largest difference " << c.worst);
}

// Compares the examples of nodes, every `stride`-th of them.
void compare_examples(GlDialect dialect, const GlslOptions& options, std::size_t stride) {
    const auto gl = GlContext::make(dialect);
    if (!gl) {
        MESSAGE("skipped: EGL gives no such context (Debian: libegl1, libgl1-mesa-dri)");
        return;
    }
    Random rng(71);
    Comparison all;
    auto files = examples();
    // Mesa takes 40 seconds to compile the shader of a mesh.
    if (!long_tests()) std::erase_if(files, [](const auto& file) { return file.filename() == "mesh.json"; });
    for (std::size_t i = 0; i < files.size(); i += stride) {
        CAPTURE(files[i].filename());
        const Comparison c = compared(*gl, read_example(files[i]), rng, options);
        check(c);
        CHECK(c.in_doubt <= c.values / 10);
        CHECK(c.labels >= point_count / 2);
        all.add(c);
    }
    tell(gl->renderer(), all);
}

const bool is_long = long_tests();
const std::size_t some = is_long ? 1 : 40;

}  // namespace

TEST_CASE("nodes' examples have the same values, labels and gradients in GLSL ES 3.00") {
    compare_examples(GlDialect::es_300, {}, is_long ? 1 : 5);
}

TEST_CASE("examples are the same by a table of instructions, and by programs of boxes") {
    compare_examples(GlDialect::es_300, {.max_calls = 0}, some);
    compare_examples(GlDialect::es_300, {.max_numbers_in_text = 0, .grid = 6}, some);
}

TEST_CASE("examples are the same in GLSL 3.30") {
    compare_examples(GlDialect::desktop_330, {}, some);
    compare_examples(GlDialect::desktop_330, {.max_calls = 0}, 2 * some);
}

// Nodes under others, with other numbers than their examples have.
TEST_CASE("random trees have the same values, labels and gradients in GLSL ES 3.00") {
    const auto gl = GlContext::make(GlDialect::es_300);
    if (!gl) return;
    const GlslOptions ways[] = {{}, {.max_calls = 0}, {.max_numbers_in_text = 0, .grid = 6}};
    Comparison all;
    int trees = 0;
    const auto kinds = node_kinds();
    for (std::size_t k = 0; k < kinds.size(); k += is_long ? 1 : 10) {
        Random rng = random_for(76, kinds[k]);
        for (int i = 0; i < (is_long ? 6 : 1); ++i) {
            CAPTURE(kinds[k].name);
            CAPTURE(i);
            const Phased object = kinds[k].object(rng, 2 + i % 3);
            const Comparison c = compared(*gl, object, rng, ways[trees++ % 3], Gradients::except_at_ties);
            check(c);
            all.add(c);
        }
    }
    // Deep trees of large numbers say little about one of them, and enough together.
    CHECK(all.in_doubt <= all.values / 4);
    CHECK(all.labels >= trees * point_count / 2);
    tell("random trees", all);
}

TEST_CASE("a comparison finds a number that is wrong by a thousandth") {
    const auto gl = GlContext::make(GlDialect::es_300);
    if (!gl) return;
    Random rng(72);
    const Phased object = read_example(source_directory() + "/scenes/nodes/fields/torus.json");
    const Comparison right = compared(*gl, object, rng, {});
    CHECK(right.wrong_values == 0);
    const Comparison wrong = compared(*gl, object, rng, {}, Gradients::everywhere, [](std::string text) {
        const std::size_t at = text.find("    return ", text.find("float pt_torus"));
        return text.insert(at + 11, "0.001 + ");
    });
    CHECK(wrong.wrong_values > wrong.values / 8);
}

}  // namespace test_nodes
