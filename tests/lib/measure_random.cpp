// Measures of random objects against the labels of random points.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/math/float_mode.hpp"
#include "phasetree/measuring/measure.hpp"
#include "phasetree/trace/tracer.hpp"
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

}  // namespace test_measure_random
