// Rays that a shader traces from phase to phase are in the phases that the CPU finds there.
#include <doctest/doctest.h>

#include <algorithm>

#include "gl_context.hpp"
#include "objects.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/glsl/shader.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/long_tests.hpp"
#include "support/random_tree.hpp"

namespace test_rays {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

constexpr int ray_count = 128, most_crossings = 24;

// Row k has the k-th crossing of each ray: where it begins and ends, and its phases; then its normal.
const char* const tracing_main = R"(
uniform highp sampler2D points;
out vec4 result;
void main() {
    int ray = int(gl_FragCoord.x), row = int(gl_FragCoord.y);
    vec3 origin = texelFetch(points, ivec2(2 * ray, 0), 0).xyz;
    vec3 direction = texelFetch(points, ivec2(2 * ray + 1, 0), 0).xyz;
    float t = 0.0;
    int carried = -1;
    result = vec4(-1.0);
    for (int k = 0; k <= row / 2; ++k) {
        PhasetreeCrossing c = phasetree_trace(origin, direction, t, 1e9, carried);
        if (!c.found) {
            result = vec4(-1.0, -1.0, float(c.from), -1.0);
            break;
        }
        t = c.t_to;
        carried = c.to;
        result = (row & 1) == 0 ? vec4(c.t_from, c.t_to, float(c.from), float(c.to)) : vec4(c.normal, 0.0);
    }
}
)";

struct Outcome {
    int samples = 0, wrong_labels = 0, crossings = 0, wrong_normals = 0, compared_normals = 0;
};

// A label between two crossings must be the CPU's, unless the CPU's changes within `margin` of that place.
Outcome traced(const GlContext& gl, const Phased& object, Random& rng, const GlslOptions& options,
               const std::function<std::string(std::string)>& change = {}) {
    const Evaluator evaluator(record(object));
    const TraceableObject traceable = prepare_to_trace(object);
    const float size = traceable.bounds.diagonal(), resolution = std::max(traceable.resolution, 1e-5f * size);
    const GlslShader shader = make_glsl(evaluator.program(), traceable.bounds, resolution, options);
    std::vector<glm::vec4> points;
    for (int i = 0; i < ray_count; ++i) {
        const glm::vec3 direction = rng.direction();
        const glm::vec3 through = rng.in(traceable.bounds);
        points.emplace_back(rng.chance(0.3) ? through : through - size * direction, 0);
        points.emplace_back(direction, 0);
    }
    const std::string text = change ? change(shader.text) : shader.text;
    const auto got = gl.run(text + tracing_main, points, shader.numbers, ray_count, 2 * most_crossings);
    Outcome outcome;
    Evaluator::Workspace w;
    const float margin = 4 * resolution;
    for (int i = 0; i < ray_count; ++i) {
        const glm::vec3 origin(points[static_cast<std::size_t>(2 * i)]), d(points[static_cast<std::size_t>(2 * i + 1)]);
        const auto at = [&](int row) { return got[static_cast<std::size_t>(row * ray_count + i)]; };
        float t = 0;
        for (int k = 0; k < most_crossings; ++k) {
            const glm::vec4 c = at(2 * k);
            const bool is_found = c.x >= 0;
            const float end = is_found ? c.x : t + size;
            for (const float part : {0.01f, 0.23f, 0.5f, 0.81f, 0.99f}) {
                const glm::vec3 p = origin + (t + part * (end - t)) * d;
                const Phases<float> phi = evaluator.distances(p, w);
                std::vector<float> sorted;
                for (const Output& o : evaluator.program().outputs) sorted.push_back(phi[o.phase.index]);
                std::ranges::sort(sorted);
                ++outcome.samples;
                if (label(phi).index != static_cast<int>(c.z) && (sorted.size() < 2 || sorted[1] > margin))
                    ++outcome.wrong_labels;
            }
            if (!is_found) break;
            ++outcome.crossings;
            const glm::vec3 place = origin + c.x * d, normal(at(2 * k + 1));
            const Phase from{static_cast<std::uint8_t>(c.z)};
            const glm::vec3 g = evaluator.gradient(place, from);
            const float h = 1e-4f * size;
            bool is_smooth = glm::length(g) > 0.01f;
            for (int corner = 0; corner < 8 && is_smooth; ++corner) {
                const glm::vec3 q =
                    place + h * glm::vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
                is_smooth = glm::length(evaluator.gradient(q, from) - g) < 2e-2f * glm::length(g);
            }
            if (is_smooth) {
                ++outcome.compared_normals;
                outcome.wrong_normals += !(glm::length(normal - glm::normalize(g)) < 5e-2f);
            }
            t = c.y;
        }
    }
    return outcome;
}

void check(const std::string& what, const Outcome& o) {
    CAPTURE(what);
    CHECK(o.wrong_labels == 0);
    CHECK(o.wrong_normals == 0);
    CHECK(o.crossings >= ray_count / 2);
    CHECK(o.compared_normals >= o.crossings / 3);
}

std::vector<std::string> scenes() {
    if (!tests::long_tests()) return {"hourglass", "two_pears", "jelly_contact"};
    std::vector<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(source_directory() + "/scenes"))
        if (entry.path().extension() == ".json" && !entry.path().stem().string().starts_with("scene."))
            all.push_back(entry.path().stem());
    std::ranges::sort(all);
    return all;
}

}  // namespace

TEST_CASE("labels and normals along rays through scenes agree with the CPU") {
    const auto gl = GlContext::make(GlDialect::es_300);
    if (!gl) {
        MESSAGE("skipped: EGL gives no context of OpenGL ES 3 (Debian: libegl1, libgl1-mesa-dri)");
        return;
    }
    Random rng(73);
    for (const std::string& name : scenes()) {
        const Phased object = read_scene(name);
        check(name + ", whole", traced(*gl, object, rng, {}));
        check(name + ", grid", traced(*gl, object, rng, {.max_numbers_in_text = 0, .grid = 12}));
    }
}

TEST_CASE("rays trace alike in GLSL 3.30") {
    const auto gl = GlContext::make(GlDialect::desktop_330);
    if (!gl) return;
    Random rng(74);
    check("two_pears", traced(*gl, read_scene("two_pears"), rng, {}));
}

TEST_CASE("a tracer that steps too far is found out") {
    const auto gl = GlContext::make(GlDialect::es_300);
    if (!gl) return;
    Random rng(75);
    const Outcome o = traced(*gl, read_scene("two_pears"), rng, {}, [](std::string text) {
        const std::string step = "t = before + max(s, PHASETREE_RESOLUTION)";
        return text.replace(text.find(step), step.size(), "t = before + max(4.0 * s, PHASETREE_RESOLUTION)");
    });
    CHECK(o.wrong_labels > 0);
}

}  // namespace test_rays
