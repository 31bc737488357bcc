// Measures of random objects, and what is known about the boxes in them, against the labels of random points.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "measuring/divide.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/math/float_mode.hpp"
#include "phasetree/measuring/measure.hpp"
#include "phasetree/nodes/fields/cylinder.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "phasetree/trace/tracer.hpp"
#include "rewriting/rewrite.hpp"
#include "support/random_tree.hpp"

namespace test_measure_random {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

// The sums over the points in one phase.
struct Sampled {
    double count = 0;
    glm::dvec3 sum{0}, squares{0}, low{1e30}, high{-1e30};
};

// The distance of a number from an interval; 0 inside.
double outside(const Measured& m, double v) {
    return std::max({0.0, m.low - v, v - m.high});
}

}  // namespace

TEST_CASE("intervals agree with the labels of random points in random objects") {
    const FlushSubnormals flush;
    const double deviations = 5.5;
    int measured = 0;
    for (const NodeKind& kind : node_kinds()) {
        Random rng = random_for(4711, kind);
        for (int tree = 0; tree < (long_tests() ? 20 : 1); ++tree) {
            const Phased object = kind.object(rng, 3);
            MeasureOptions options{.tolerance = 1e-2};
            options.max_boxes = long_tests() ? 200'000 : 20'000;
            MeasureResult r;
            try {
                r = measure(object, options);
            } catch (const ModelError&) {
                continue;  // unbounded or empty
            }
            INFO(kind.name << " " << tree);
            ++measured;
            const Evaluator evaluator(record(object));
            Evaluator::Workspace workspace;
            const int points = long_tests() ? 100'000 : 2000;
            std::array<Sampled, Phase::capacity> samples{};
            for (int i = 0; i < points; ++i) {
                const glm::vec3 p = rng.in(r.bounds);
                Sampled& s = samples[evaluator.label(p, workspace).index];
                const glm::dvec3 q(p);
                s.count += 1;
                s.sum += q;
                s.squares += q * q;
                s.low = glm::min(s.low, q);
                s.high = glm::max(s.high, q);
            }
            const glm::dvec3 size = glm::dvec3(r.bounds.high) - glm::dvec3(r.bounds.low);
            const double all = size.x * size.y * size.z;
            const double resolution = prepare_to_trace(object).resolution;
            const auto check_volume = [&](const Measured& volume, const Sampled& s) {
                CHECK(volume.low <= volume.estimate);
                CHECK(volume.estimate <= volume.high);
                const double share = s.count / points;
                const double variance = std::max(share * (1 - share), 1.0 / points) / points;
                CHECK(outside(volume, share * all) <= deviations * std::sqrt(variance) * all);
            };
            check_volume(r.vacuum, samples[0]);
            for (const MeasuredPhase& p : r.phases) {
                const Sampled& s = samples[p.phase.index];
                check_volume(p.body.volume, s);
                for (std::size_t i = 0; i < 3 && s.count > 0; ++i) {
                    const int k = static_cast<int>(i);
                    CHECK(p.box_low[i].low <= s.low[k] + resolution);
                    CHECK(s.high[k] - resolution <= p.box_high[i].high);
                    if (s.count < 100) continue;
                    const double mean = s.sum[k] / s.count;
                    const double variance = std::max(0.0, s.squares[k] / s.count - mean * mean) / (s.count - 1);
                    CHECK(outside(p.body.centre[i], mean) <= deviations * std::sqrt(variance) + resolution);
                }
            }
        }
    }
    CHECK(measured > 40);
}

TEST_CASE("intervals contain volumes and centres of mass of the phases of random stacks in closed form") {
    constexpr double pi = 3.141592653589793;
    constexpr double rounding = 2e-6;  // the fraction by which rounding of parameters to 32 bits may change a volume
    Random rng(2025);
    for (int i = 0; i < (long_tests() ? 300 : 4); ++i) {
        // Cylinders that end at the same height; each begins higher and is at most as wide as the one before, which it
        // replaces. So what is left of each is the difference of two cylinders.
        const int count = 2 + rng.below(3);
        const float top = 1;
        std::vector<Phased> layers;
        std::vector<double> volumes, moments;  // of whole cylinders; moments are about z = 0
        float radius = 0.8f, bottom = -1;
        const glm::vec3 axis = rng.direction(), by = 2.f * rng.direction();
        const float angle = i % 2 == 0 ? 0 : rng.uniform(0, 360);
        for (int k = 0; k < count; ++k) {
            const float height = top - bottom, middle = 0.5f * (top + bottom);
            const Field cylinder =
                warped(Translate{.by = {0, 0, middle}}, Cylinder{.radius = radius, .height = height});
            const Field turned = warped(Rotate{.axis = axis, .angle = angle}, cylinder);
            layers.push_back(
                Set{.phase = Phase{static_cast<std::uint8_t>(k + 1)}, .of = warped(Translate{.by = by}, turned)});
            volumes.push_back(pi * double{radius} * double{radius} * double{height});
            moments.push_back(volumes.back() * double{middle});
            bottom += rng.uniform(0.2f, 0.5f);
            radius *= rng.chance(0.3) ? 1 : rng.uniform(0.6f, 0.95f);
        }
        volumes.push_back(0);
        moments.push_back(0);
        const double tolerance = angle == 0 ? 1e-2 : 0.2;
        const MeasureResult r = measure(Under{.of = layers}, MeasureOptions{.tolerance = tolerance});
        INFO("stack ", i);
        REQUIRE(r.phases.size() == static_cast<std::size_t>(count));
        CHECK(r.end == MeasureEnd::tolerance);
        const double s = std::sin(double{angle} * pi / 180), c = std::cos(double{angle} * pi / 180);
        const glm::dvec3 n = glm::normalize(glm::dvec3(axis)), z(0, 0, 1);
        const glm::dvec3 up = z * c + glm::cross(n, z) * s + n * (glm::dot(n, z) * (1 - c));
        for (std::size_t k = 0; k < r.phases.size(); ++k) {
            const double v = volumes[k] - volumes[k + 1], height = (moments[k] - moments[k + 1]) / v;
            const Body& body = r.phases[k].body;
            CHECK(outside(body.volume, v) <= rounding * volumes[0]);
            CHECK(body.volume.width() <= tolerance * v);
            if (angle == 0)
                CHECK(outside(body.volume, 1.012 * v) > rounding * v);  // an error of about a percent is found
            for (int j = 0; j < 3; ++j)
                CHECK(outside(body.centre[static_cast<std::size_t>(j)], double{by[j]} + height * up[j]) <=
                      8 * rounding * volumes[0] / v);
        }
    }
}

TEST_CASE("boxes say only what is true of the points in them") {
    const FlushSubnormals flush;
    std::size_t decided = 0, cut = 0;
    for (const NodeKind& kind : node_kinds()) {
        Random rng = random_for(77, kind);
        for (int tree = 0; tree < (long_tests() ? 40 : 1); ++tree) {
            const Phased object = kind.object(rng, 2);
            std::optional<TraceableObject> traceable;
            try {
                traceable = prepare_to_trace(object);
            } catch (const ModelError&) {
                continue;  // unbounded or empty
            }
            INFO(kind.name << " " << tree);
            Program program = record(object);
            const Evaluator evaluator(program);
            Evaluator::Workspace workspace;
            rewriting::Arena arena;
            const rewriting::WorkingProgram whole = rewriting::rewrite(program, arena);
            const measuring::MeasureContext context{
                {whole, program.constants, PhaseSet(), 0.5f * traceable->resolution}, {}, traceable->resolution};
            building::CellBudget budget(std::size_t{1} << 40);
            building::WorkerPool pool(budget, program.constants);
            building::Worker worker{pool};
            const auto check_points = [&](const measuring::ExaminedBox& box) {
                for (int i = 0; i < 8; ++i) {
                    const glm::vec3 p = rng.in(box.node.box);
                    const Phase label = evaluator.label(p, workspace);
                    if (box.only) {
                        ++decided;
                        CHECK(*box.only == label);
                        continue;
                    }
                    bool is_listed = false;
                    for (const measuring::PhaseInBox& q : box.phases) {
                        is_listed = is_listed || q.phase == label;
                        if (!std::isfinite(q.slack)) continue;
                        // Half of it covers rounding errors of labels, the other half those of the linear function.
                        CHECK(q.slack >= double{traceable->resolution});
                        double f = q.component.at_low;
                        for (int j = 0; j < 3; ++j)
                            f += q.component.change[static_cast<std::size_t>(j)] *
                                 double{(p[j] - box.node.box.low[j]) / box.node.box.extent()[j]};
                        const double error = 1e-6 * (1 + std::abs(f)) * double{box.node.box.diagonal()};
                        if (f + q.slack < -error) {
                            ++cut;
                            CHECK(label == q.phase);
                        }
                        if (f - q.slack > error) {
                            ++cut;
                            CHECK(label != q.phase);
                        }
                    }
                    CHECK(is_listed);
                }
            };
            const auto descend = [&](auto&& self, const measuring::Node& node, int depth) -> void {
                const rewriting::ArenaScope programs(worker.programs), scratch(worker.scratch);
                const measuring::Division division(node, context, worker);
                for (std::size_t i = 0; i < division.count(); ++i) {
                    const measuring::ExaminedBox box = division.examine(i);
                    check_points(box);
                    // Deep boxes matter as much as large ones, and one child in four is enough to get there.
                    if (!box.only && box.can_be_divided && depth < 8 && (depth < 1 || rng.chance(0.25)))
                        self(self, box.node, depth + 1);
                }
            };
            descend(descend, {traceable->bounds, whole}, 0);
        }
    }
    CHECK(decided > 10'000);
    CHECK(cut > 10'000);
}

}  // namespace test_measure_random
