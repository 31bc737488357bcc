// Cauchy's formula: random lines through a body have a mean chord length of 4 V/S, whatever its shape. Lost, repeated
// or misplaced crossings of the tracer in double precision would change it.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/math/portable.hpp"
#include "phasetree/measuring/areas.hpp"
#include "phasetree/measuring/measure.hpp"
#include "phasetree/nodes/fields/torus.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/trace/precise_tracer.hpp"
#include "support/long_tests.hpp"
#include "support/precise_walks.hpp"
#include "support/random_tree.hpp"
#include "support/traced_scenes.hpp"

namespace test_precise_chords {

using namespace phasetree;
using namespace phasetree::tests;
using glm::dvec3;
using std::numbers::pi;
using traced::filled, traced::moved, traced::phase;

namespace {

// The ratio of the length of all chords of a phase to their number, and its standard error over lines.
struct MeanChord {
    double mean = 0, standard_error = 0;
    std::size_t crossings = 0;
};

// Uniform isotropic lines through the sphere around the object's bounds.
std::vector<PreciseRay> random_lines(Random& rng, const Bounds& bounds, std::size_t count) {
    const dvec3 centre(bounds.centre());
    const double radius = 0.5 * double{bounds.diagonal()};
    std::vector<PreciseRay> lines(count);
    for (PreciseRay& line : lines) {
        line.direction = glm::normalize(dvec3(rng.direction()));
        const dvec3 helper = std::abs(line.direction.z) < 0.7 ? dvec3(0, 0, 1) : dvec3(1, 0, 0);
        const dvec3 u = glm::normalize(glm::cross(line.direction, helper)), v = glm::cross(line.direction, u);
        const double r = radius * std::sqrt(rng.unit()), a = 2 * pi * rng.unit();
        line.origin = centre + r * (std::cos(a) * u + std::sin(a) * v) - 1.5 * radius * line.direction;
    }
    return lines;
}

MeanChord mean_chord(const PreciseTracer& tracer, Phase of, Random& rng, std::size_t lines) {
    double length = 0, number = 0, squares = 0, products = 0, number_squares = 0;
    MeanChord result;
    for (std::size_t done = 0; done < lines;) {
        const std::size_t block = std::min<std::size_t>(lines - done, 100'000);
        const auto found = tracer.crossings(random_lines(rng, tracer.bounds(), block));
        result.crossings += found->crossings.size();
        for (std::size_t i = 0; i < block; ++i) {
            double l = 0, n = 0, entered = 0;
            for (std::size_t k = found->offsets[i]; k < found->offsets[i + 1]; ++k) {
                const PreciseCrossing& c = found->crossings[k];
                if (c.to == of) entered = c.t_to;
                if (c.from == of) {
                    l += c.t_from - entered;
                    ++n;
                }
            }
            length += l;
            number += n;
            squares += l * l;
            products += l * n;
            number_squares += n * n;
        }
        done += block;
    }
    const double mean = length / number;
    // The variance of a ratio, by linearisation.
    const double residual = squares - 2 * mean * products + mean * mean * number_squares;
    result.mean = mean;
    result.standard_error = std::sqrt(std::max(residual, 0.0)) / number;
    return result;
}

struct Body {
    const char* name;
    Field field;
    double volume, surface;
};

std::vector<Body> bodies() {
    const Field two_boxes =
        Union{.of = {moved({1, 0.5f, 0}, Box{.size = {2, 1, 1}}), moved({0.5f, 1.5f, 0}, Box{.size = {1, 1, 1}})}};
    return {
        {"ball", Sphere{.radius = 1}, 4 * pi / 3, 4 * pi},
        {"box", Box{.size = {1, 2, 3}}, 6, 22},
        {"cylinder", Cylinder{.radius = 0.5f, .height = 2}, pi / 2, 2.5 * pi},
        {"hollow ball", Difference{.from = Sphere{.radius = 1}, .subtract = {Sphere{.radius = 0.5f}}},
         4 * pi / 3 * (1 - 0.125), 4 * pi * 1.25},
        {"torus", Torus{.major = 1, .minor = 0.25f}, 2 * pi * pi * 0.0625, pi * pi},
        {"two boxes in an L", two_boxes, 3, 14},
        {"turned L", warped(Rotate{.axis = {1, 2, 3}, .angle = 40}, two_boxes), 3, 14},
    };
}

// Lines in floats through the whole program, to estimate areas independently.
LineTracer lines_in_floats(const InterfaceTracer& tracer) {
    return [&](const glm::vec3& origin, const glm::vec3& direction, float length, std::vector<CrossingOnLine>& found) {
        Evaluator::Workspace& w = Evaluator::thread_workspace();
        glm::vec3 from = origin;
        Phase carried = vacuum;
        float behind = 0;
        while (const auto c = tracer.first_crossing(from, direction, 0, length - behind, carried, w)) {
            found.push_back({behind + c->t_from, c->from, c->to});
            from = c->p_to;
            behind += c->t_to;
            carried = c->to;
        }
    };
}

}  // namespace

TEST_CASE("mean chords of convex and other bodies are 4 V/S") {
    Random rng(411);
    for (const Body& body : bodies()) {
        const PreciseTracer tracer(filled(1, body.field));
        const MeanChord found = mean_chord(tracer, phase(1), rng, long_tests() ? 8'000'000 : 40'000);
        const double expected = 4 * body.volume / body.surface;
        INFO(body.name, ": ", found.mean, " instead of ", expected, ", standard error ", found.standard_error, ", ",
             found.crossings, " crossings");
        CHECK(std::abs(found.mean - expected) < 3 * found.standard_error);
        CHECK(found.standard_error < 0.01 * expected);
    }
}

TEST_CASE("mean chords agree with measured volumes and estimated areas") {
    Random rng(412);
    int compared = 0;
    for (int n = 0; n < (long_tests() ? 40 : 3); ++n) {
        const Phased object = walks::exact_scene(rng).object;
        std::optional<InterfaceTracer> floats;
        try {
            floats.emplace(object);
        } catch (const ModelError&) {
            continue;  // cut to nothing
        }
        const PreciseTracer tracer(object);
        const MeasureResult measured = measure(object, {.tolerance = 2e-3, .max_boxes = 1 << 18});
        const AreaResult areas =
            estimate_areas(floats->bounds(), lines_in_floats(*floats), {.tolerance = 5e-3, .max_lines = 1 << 16});
        for (const MeasuredPhase& m : measured.phases) {
            const auto area = std::find_if(areas.phases.begin(), areas.phases.end(),
                                           [&](const AreaResult::OfPhase& a) { return a.phase == m.phase; });
            const Measured& v = m.body.volume;
            if (area == areas.phases.end() || !(v.width() < 0.01 * v.estimate)) continue;
            const MeanChord found = mean_chord(tracer, m.phase, rng, long_tests() ? 1'000'000 : 20'000);
            const double expected = 4 * v.estimate / area->area;
            const double relative_area = area->standard_error / area->area, certain = v.width() / v.estimate;
            const double error = portable::hypot(found.standard_error, expected * relative_area);
            INFO("scene ", n, ", phase ", int(m.phase.index), ": ", found.mean, " instead of ", expected, " ± ", error);
            CHECK(std::abs(found.mean - expected) < 3 * error + certain * expected);
            ++compared;
        }
    }
    CHECK(compared >= 3);
}

}  // namespace test_precise_chords
