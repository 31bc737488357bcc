// The bounds of a neural field in a box are compared with the field itself, along lines and in doubles.
#include "bounding/network_in_box.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/siren.hpp"
#include "phasetree/nodes/fields/siren_network.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "support/compared_crossings.hpp"

namespace test_network_in_box {

using namespace phasetree;
using namespace phasetree::tests;

using bounding::network_in_box;
using enclosure::FieldInBox, enclosure::Interval;

namespace {

SirenNetwork random_network(Random& rng, int width, float frequency) {
    SirenNetwork network;
    const int widths[] = {3, width, width, 1};
    for (int n = 0; n < 3; ++n) {
        SirenNetwork::Layer layer{widths[n], widths[n + 1], {}, {}};
        const float scale = (n == 0 ? frequency : 1.5f) / std::sqrt(static_cast<float>(widths[n]));
        for (int i = 0; i < layer.inputs * layer.outputs; ++i) layer.weights.push_back(scale * rng.uniform(-1, 1));
        for (int o = 0; o < layer.outputs; ++o) layer.bias.push_back(rng.uniform(-3, 3));
        network.layers.push_back(std::move(layer));
    }
    return network;
}

/// A number along a line, with its first and second derivative.
struct OnLine {
    double value = 0, slope = 0, bend = 0;
};

OnLine along(const SirenNetwork& network, const glm::dvec3& p, const glm::dvec3& d) {
    std::vector<OnLine> now;
    for (int i = 0; i < 3; ++i) now.push_back({p[i], d[i], 0});
    for (const SirenNetwork::Layer& layer : network.layers) {
        std::vector<OnLine> next;
        for (std::size_t o = 0; o < layer.bias.size(); ++o) {
            OnLine z{static_cast<double>(layer.bias[o]), 0, 0};
            for (std::size_t i = 0; i < now.size(); ++i) {
                const auto w = static_cast<double>(layer.weights[o * now.size() + i]);
                z = {z.value + w * now[i].value, z.slope + w * now[i].slope, z.bend + w * now[i].bend};
            }
            if (&layer != &network.layers.back()) {
                const double s = std::sin(z.value), c = std::cos(z.value);
                z = {s, c * z.slope, c * z.bend - s * z.slope * z.slope};
            }
            next.push_back(z);
        }
        now = std::move(next);
    }
    return now[0];
}

/// The range of the second derivative along lines of all directions: the eigenvalues of the matrix that follows from
/// its values along six.
Interval bends(const SirenNetwork& network, const glm::dvec3& p) {
    const auto on = [&](const glm::dvec3& d) { return along(network, p, d).bend; };
    glm::dmat3 h(0);
    for (int i = 0; i < 3; ++i) h[i][i] = on(glm::dvec3(i == 0, i == 1, i == 2));
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        glm::dvec3 d(1);
        d[3 - i - j] = 0;
        h[i][j] = h[j][i] = 0.5 * (on(d) - h[i][i] - h[j][j]);
    }
    // The power method, with a shift that makes all eigenvalues of one sign.
    const double shift = std::sqrt(glm::dot(h[0], h[0]) + glm::dot(h[1], h[1]) + glm::dot(h[2], h[2]));
    const auto farthest = [&](const glm::dmat3& m) {
        glm::dvec3 d(0.6, 0.48, 0.64);
        for (int i = 0; i < 100; ++i) d = glm::normalize(m * d);
        return on(d);
    };
    return shift > 0 ? Interval{farthest(h - glm::dmat3(shift)), farthest(h + glm::dmat3(shift))} : Interval{};
}

struct CellBuffer {
    std::size_t points = 0, outside = 0, steep = 0, bent = 0;
};

/// Compares points of a box that is `larger` times as large as the one for which the bounds hold.
CellBuffer look(double larger, double& slack) {
    Random rng(211);
    CellBuffer found;
    double known = 0, met = 0;
    for (int n = 0; n < (long_tests() ? 2000 : 60); ++n) {
        const SirenNetwork network = random_network(rng, 2 + rng.below(31), rng.uniform(1, 12));
        const std::vector<float> data = network.table(1);
        for (int box = 0; box < 10; ++box) {
            const glm::dvec3 centre(0.5f * rng.direction());
            const glm::dvec3 half = static_cast<double>(std::exp2(rng.uniform(-12, -2))) *
                                    glm::dvec3(rng.uniform(0.1f, 1), rng.uniform(0.1f, 1), rng.uniform(0.1f, 1));
            const FieldInBox f = network_in_box(data.data(), {centre.x, centre.y, centre.z}, {half.x, half.y, half.z});
            const OnLine middle = along(network, centre, {1, 0, 0});
            REQUIRE(std::abs(f.value - middle.value) < 1e-12 * (1 + std::abs(f.value)));
            double most = 0;
            for (std::size_t i = 0; i < 3; ++i) most += f.gradients[i].magnitude() * half[static_cast<int>(i)] * larger;
            double highest = -Interval::most, lowest = Interval::most;
            for (int point = 0; point < 24; ++point) {
                // Half of the coordinates are those of corners, where the field departs most from the centre's.
                const auto one = [&] { return rng.chance(0.5) ? (rng.chance(0.5) ? 1 : -1) : rng.uniform(-1, 1); };
                const glm::dvec3 p = centre + larger * half * glm::dvec3(one(), one(), one());
                const double rounding = 1e-9 * (1 + f.curvature.magnitude());
                ++found.points;
                found.outside += std::abs(along(network, p, {1, 0, 0}).value - f.value) > most + rounding;
                for (int axis = 0; axis < 3; ++axis) {
                    glm::dvec3 d(0);
                    d[axis] = 1;
                    const double slope = along(network, p, d).slope;
                    const Interval& range = f.gradients[static_cast<std::size_t>(axis)];
                    found.steep += slope < range.low - rounding || slope > range.high + rounding;
                    if (point == 0) {
                        const double at_centre = along(network, centre, d).slope;
                        const double error = f.gradient[static_cast<std::size_t>(axis)] - at_centre;
                        REQUIRE(std::abs(error) < 1e-10 * (1 + std::abs(at_centre)));
                    }
                }
                const Interval bend = bends(network, p);
                found.bent += bend.low < f.curvature.low - rounding || bend.high > f.curvature.high + rounding;
                highest = std::max(highest, bend.high);
                lowest = std::min(lowest, bend.low);
            }
            if (glm::length(half) < 0.004) {
                known += f.curvature.high - f.curvature.low;
                met += highest - lowest;
            }
        }
    }
    slack = known / met;
    return found;
}

}  // namespace

TEST_CASE("a neural field's values, gradients and curvatures in a box are within their bounds") {
    double slack = 0;
    const CellBuffer found = look(1, slack);
    CHECK(found.outside == 0);
    CHECK(found.steep == 0);
    CHECK(found.bent == 0);
    // In small boxes hardly anything is given away.
    MESSAGE(found.points, " points; in small boxes the curvature's range is ", slack, " times what was met");
    CHECK(slack < 2);
    // And it is no more than so small: of boxes that are larger it would be wrong.
    const CellBuffer beyond = look(1.5, slack), far = look(4, slack);
    MESSAGE("half as large again, ", beyond.steep, " slopes would be outside; four times, ", far.bent, " curvatures");
    CHECK(beyond.steep > found.points / 100);
    CHECK(far.bent > found.points / 100);
}

TEST_CASE("of chains of neurons every term of the fourth derivative's bound is needed") {
    // f(x) = sin(a·sin(w·x + b) + c): along x all bounds of a box without height and depth are equalities at its
    // centre, so that where the other terms vanish each is all there is. With the same of y and z added the field bends
    // alike in all directions: then less bending is outside of the range, too.
    Random rng(216);
    std::size_t points = 0, bent = 0, steep = 0;
    double least = Interval::most;
    for (int n = 0; n < (long_tests() ? 1000000 : 40000); ++n) {
        const float w = rng.uniform(0.5f, 4), b = rng.uniform(-4, 4), a = std::exp2(rng.uniform(-4, 3)),
                    c = rng.uniform(-4, 4);
        SirenNetwork network;
        if (n % 2 == 0)
            network.layers = {{3, 1, {w, 0, 0}, {b}}, {1, 1, {a}, {c}}, {1, 1, {1}, {0}}};
        else
            network.layers = {{3, 3, {w, 0, 0, 0, w, 0, 0, 0, w}, {b, b, b}},
                              {3, 3, {a, 0, 0, 0, a, 0, 0, 0, a}, {c, c, c}},
                              {3, 1, {1, 1, 1}, {0}}};
        const std::vector<float> data = network.table(1);
        const double half = 0.01;
        const FieldInBox f = network_in_box(data.data(), {0, 0, 0}, {half, 0, 0});
        for (const double x : {-half, half}) {
            const OnLine there = along(network, {x, 0, 0}, {1, 0, 0});
            const double rounding = 1e-10 * (1 + f.curvature.magnitude());
            ++points;
            bent += there.bend < f.curvature.low - rounding || there.bend > f.curvature.high + rounding;
            steep += there.slope < f.gradients[0].low - rounding || there.slope > f.gradients[0].high + rounding;
            least = std::min({least, (there.bend - f.curvature.low) / (1 + f.curvature.magnitude()),
                              (f.curvature.high - there.bend) / (1 + f.curvature.magnitude())});
        }
    }
    CHECK(bent == 0);
    CHECK(steep == 0);
    MESSAGE(points, " points; the curvature comes as near to its range's end as ", least, " of it");
    CHECK(least < 1e-6);
}

TEST_CASE("rays through a neural field's cells find what marching through the whole finds") {
    Random rng(212);
    Compared all;
    for (int n = 0; n < (long_tests() ? 20 : 2); ++n) {
        SirenNetwork network = random_network(rng, 48, 6);
        // Its surface passes near the ball's middle: else it may have none, and what is traced is the ball.
        network.layers.back().bias[0] -=
            static_cast<float>(along(network, rng.in(Bounds::centred(glm::vec3(0.3f))), {1, 0, 0}).value);
        const Siren field{.file = {.content = std::make_shared<const SirenNetwork>(std::move(network))},
                          .samples = 2000};
        compare_crossings(Set{.phase = Phase{1}, .of = field}, {}, long_tests() ? 5000 : 300, rng, all);
    }
    const double each = static_cast<double>(all.counters.batches) / static_cast<double>(all.rays + all.crossings);
    MESSAGE(all.rays, " rays, ", all.crossings, " crossings, ", each, " batches for each");
    CHECK(all.crossings > all.rays / 2);
    CHECK(all.different == 0);
    CHECK(each < 2.05);  // 13 if nothing were known of networks in boxes
}

}  // namespace test_network_in_box
