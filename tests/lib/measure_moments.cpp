// Moments: parts of boxes agree with quadrature; sums and what follows from them include their rounding errors; bodies
// of boxes agree with closed forms at every scale, position and density.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "measuring/body.hpp"
#include "measuring/cut_box.hpp"
#include "measuring/phase_sums.hpp"
#include "phasetree/measuring/measure.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "support/random_tree.hpp"

namespace test_measure_moments {

using namespace phasetree;
using namespace phasetree::tests;
using measuring::body_of, measuring::LinearInBox, measuring::MeasuredBox, measuring::MomentBounds, measuring::Moments,
    measuring::PartOfBox, measuring::part_below, measuring::PhaseSums, measuring::product_index;

namespace {

constexpr Phase first{1}, third{3};

// The moments of what is below a plane, by the midpoint rule in two coordinates and exact integrals in the third, the
// one along which the linear function changes most.
Moments by_quadrature(const LinearInBox& f, const MeasuredBox& box) {
    constexpr int steps = 128;
    std::size_t k = 0;
    for (const std::size_t i : {std::size_t{1}, std::size_t{2}})
        if (std::abs(f.change[i]) > std::abs(f.change[k])) k = i;
    const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
    const double column = box.size[a] * box.size[b] / (steps * steps);
    Moments m{};
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double u = (i + 0.5) / steps, v = (j + 0.5) / steps;
            const double zero = std::clamp(-(f.at_low + u * f.change[a] + v * f.change[b]) / f.change[k], 0.0, 1.0);
            const double from = f.change[k] > 0 ? 0 : zero, to = f.change[k] > 0 ? zero : 1;
            const double low = box.low[k] + from * box.size[k], high = box.low[k] + to * box.size[k];
            const double x = box.low[a] + u * box.size[a], y = box.low[b] + v * box.size[b];
            const double one = column * (high - low), z = column * (high * high - low * low) / 2;
            m[0] += one;
            m[1 + a] += one * x;
            m[1 + b] += one * y;
            m[1 + k] += z;
            m[product_index(a, a)] += one * x * x;
            m[product_index(b, b)] += one * y * y;
            m[product_index(k, k)] += column * (high * high * high - low * low * low) / 3;
            m[product_index(a, b)] += one * x * y;
            m[product_index(a, k)] += z * x;
            m[product_index(b, k)] += z * y;
        }
    return m;
}

// Three boxes without a plane of symmetry. The third is in another phase.
struct ThreeBoxes {
    struct One {
        glm::dvec3 centre, size;
    };
    std::array<One, 3> boxes{{{{0, 0, 0}, {2, 1, 0.5}}, {{2, 1, 1}, {1, 2, 1.5}}, {{-1, 2, -1}, {0.5, 1, 1}}}};
    glm::dvec3 at{0};
    double scale = 1;

    Field field(const One& b) const {
        return warped(Translate{.by = glm::vec3(at + scale * b.centre)}, Box{.size = glm::vec3(scale * b.size)});
    }
    Phased object() const {
        return Under{.of = {Set{.phase = first, .of = Union{.of = {field(boxes[0]), field(boxes[1])}}},
                            Set{.phase = third, .of = field(boxes[2])}}};
    }
};

struct Exact {
    double mass = 0;
    glm::dvec3 centre{0};
    std::array<std::array<double, 3>, 3> inertia{};
};

// Boxes with one density each, by Steiner's theorem.
Exact exact(std::span<const ThreeBoxes::One> boxes, std::span<const double> density, const glm::dvec3& at,
            double scale) {
    Exact e;
    const auto mass = [&](std::size_t i) {
        const glm::dvec3 s = scale * boxes[i].size;
        return density[i] * s.x * s.y * s.z;
    };
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        e.mass += mass(i);
        e.centre += mass(i) * scale * boxes[i].centre;
    }
    e.centre /= e.mass;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const glm::dvec3 d = scale * boxes[i].centre - e.centre, s = scale * boxes[i].size;
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k)
                e.inertia[static_cast<std::size_t>(j)][static_cast<std::size_t>(k)] +=
                    mass(i) *
                    (j == k ? (glm::dot(s, s) - s[j] * s[j]) / 12 + glm::dot(d, d) - d[j] * d[j] : -d[j] * d[k]);
    }
    e.centre += at;
    return e;
}

void check_body(const Body& body, const Exact& e, double size, double error) {
    const auto is_right = [](const Measured& m, double v, double unit, double off) {
        CHECK(m.low <= m.high);
        CHECK(m.low <= v + off * unit);
        CHECK(v - off * unit <= m.high);
        CHECK(std::abs(m.estimate - v) <= (off + 1e-3) * unit);
        CHECK(m.width() <= 0.2 * unit);
    };
    is_right(body.mass, e.mass, e.mass, error);
    for (std::size_t i = 0; i < 3; ++i) {
        is_right(body.centre[i], e.centre[static_cast<int>(i)], size, error);
        for (std::size_t j = 0; j < 3; ++j) is_right(body.inertia[i][j], e.inertia[i][j], e.mass * size * size, error);
    }
}

}  // namespace

TEST_CASE("the moments of what is below a plane in a box agree with quadrature") {
    Random rng(31);
    int empty = 0, whole = 0;
    for (int i = 0; i < (long_tests() ? 2000 : 100); ++i) {
        MeasuredBox box(Bounds::centred(glm::vec3(1)), {});
        LinearInBox f;
        for (std::size_t k = 0; k < 3; ++k) {
            box.low[k] = rng.uniform(-2, 2);
            box.size[k] = rng.uniform(0.2f, 1.5f);
            f.change[k] = rng.chance(0.1) ? 0 : rng.uniform(-1, 1);
        }
        const double middle = 0.5 * (f.change[0] + f.change[1] + f.change[2]);
        f.at_low = -middle + rng.uniform(-0.8f, 0.8f);
        if (f.change == std::array<double, 3>{}) continue;
        const PartOfBox part = part_below(f, box);
        const Moments expected = by_quadrature(f, box), all = box.moments();
        for (std::size_t k = 0; k < expected.size(); ++k)
            CHECK(std::abs(part.moments[k] - expected[k]) < 1e-3 * (all[0] + all[4] + all[5] + all[6]));
        if (!(part.moments[0] > 0)) ++empty;
        if (part.moments[0] == all[0]) ++whole;
        // The extent is that of the points below the plane, found on a grid up to its spacing.
        constexpr int steps = 32;
        for (std::size_t k = 0; k < 3 && part.moments[0] > 0; ++k) {
            const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
            // In the plane across axis k at u, the function is smallest at a corner.
            const double least = std::min(f.change[a], 0.0) + std::min(f.change[b], 0.0);
            double low = 1, high = 0;
            for (int s = 0; s <= steps; ++s) {
                const double u = static_cast<double>(s) / steps;
                if (!(f.at_low + u * f.change[k] + least < 0)) continue;
                low = std::min(low, u);
                high = std::max(high, u);
            }
            CHECK(part.low[k] <= box.low[k] + low * box.size[k] + 1e-12);
            CHECK(part.low[k] >= box.low[k] + (low - 1.0 / steps) * box.size[k] - 1e-12);
            CHECK(part.low[k] >= box.low[k] - 1e-12);
            CHECK(part.high[k] >= box.low[k] + high * box.size[k] - 1e-12);
            CHECK(part.high[k] <= box.low[k] + (high + 1.0 / steps) * box.size[k] + 1e-12);
            CHECK(part.high[k] <= box.high(k) + 1e-12);
        }
    }
    CHECK(empty > 0);
    CHECK(whole > 0);
}

TEST_CASE("sums include their rounding errors") {
    // The volume of the box has few bits to spare, so nearly every addition rounds, and always in the same direction
    // while the exponent of the sum stays the same.
    const float side = 1.0000001f;
    const MeasuredBox box({{1, 2, -3}, {1 + side, 2 + side, -3 + side}}, {});
    PhaseSums sums;
    const std::size_t count = 1'000'000;
    for (std::size_t i = 0; i < count; ++i) sums.add(box);
    const MomentBounds bounds(sums, count);
    const auto exact = [&](std::size_t k) {
        const long double n = count;
        const std::array<long double, 3> s{box.size[0], box.size[1], box.size[2]};
        std::array<long double, 3> mean{}, square{};
        for (std::size_t i = 0; i < 3; ++i) {
            const long double low = box.low[i];
            mean[i] = low + s[i] / 2;
            square[i] = low * low + low * s[i] + s[i] * s[i] / 3;
        }
        const long double v = n * s[0] * s[1] * s[2];
        if (k == 0) return v;
        if (k < 4) return v * mean[k - 1];
        if (k < 7) return v * square[k - 4];
        return v * mean[(k - 6) % 3] * mean[(k - 5) % 3];
    };
    double farthest = 0;
    for (std::size_t k = 0; k < 10; ++k) {
        INFO("moment " << k);
        CHECK(static_cast<long double>(bounds.low[k]) <= exact(k));
        CHECK(exact(k) <= static_cast<long double>(bounds.high[k]));
        CHECK(bounds.high[k] - bounds.low[k] < 1e-9 * std::abs(bounds.estimate[k]));
        const auto off = static_cast<double>(std::abs(static_cast<long double>(sums.low[k]) - exact(k)));
        farthest = std::max(farthest, off / sums.magnitude[k]);
    }
    // The errors are too large for the allowance for a single term.
    CHECK(farthest > 0x1p15 * 0x1p-53);
}

TEST_CASE("the rest of a box adds to a sum what lies between nothing and all of it") {
    const MeasuredBox box({{-1, 2, -3}, {3, 4, 5}}, {});
    const LinearInBox f{-1, {0.5, 0.25, 1.5}};
    const PartOfBox certain = part_below(f.plus(0.25), box), possible = part_below(f.plus(-0.25), box);
    PhaseSums sums;
    sums.add(box, certain, possible, {});
    const double doubt = possible.moments[0] - certain.moments[0];
    REQUIRE(doubt > 0.1);
    CHECK(sums.low[0] == certain.moments[0]);
    CHECK(sums.high[0] == doctest::Approx(possible.moments[0]));
    // The largest and the smallest integrand where the phase is possible, at the corners of its extent.
    const auto check = [&](std::size_t k, double least, double most) {
        INFO("moment " << k);
        CHECK(sums.low[k] == doctest::Approx(certain.moments[k] + doubt * std::min(0.0, least)));
        CHECK(sums.high[k] == doctest::Approx(certain.moments[k] + doubt * std::max(0.0, most)));
    };
    const std::array<double, 3>&low = possible.low, &high = possible.high;
    check(1, -1, high[0]);
    check(2, 2, 4);
    check(3, -3, high[2]);
    check(product_index(0, 0), 0, std::max(1.0, high[0] * high[0]));
    check(product_index(1, 1), 4, 16);
    check(product_index(2, 2), 0, std::max(9.0, high[2] * high[2]));
    check(product_index(1, 2), -12, std::max(4 * high[2], 2 * high[2]));
    check(product_index(0, 2), std::min(-3 * high[0], -high[2]), std::max(3.0, high[0] * high[2]));
    check(product_index(0, 1), -4, 4 * high[0]);
    CHECK(low == std::array<double, 3>{-1, 2, -3});
    const Moments largest{1, 3, 4, 5, 9, 16, 25, 20, 15, 12};
    for (std::size_t k = 0; k < 10; ++k) CHECK(sums.magnitude[k] == 64 * largest[k]);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(sums.inner_low[i] == certain.low[i]);
        CHECK(sums.inner_high[i] == certain.high[i]);
        CHECK(sums.outer_low[i] == possible.low[i]);
        CHECK(sums.outer_high[i] == possible.high[i]);
    }
}

TEST_CASE("sums of objects count in how many additions a term takes part") {
    const measuring::MeasureContext context{{rewriting::WorkingProgram(), {}, PhaseSet(), 1e-6f}, {}, 1e-6f};
    measuring::ExaminedBox box;
    box.node.box = Bounds::centred(glm::vec3(1));
    box.only = third;
    measuring::ObjectSums part(PhaseSet::of(third)), all(PhaseSet::of(third));
    for (int i = 0; i < 5; ++i) part.add(box, context);
    CHECK(part.additions() == 5);
    all.add(part);
    all.add(part);
    all.add(measuring::ObjectSums(PhaseSet::of(third)));
    CHECK(all.additions() == 8);
    CHECK(all[third].low[0] == 80);
    CHECK(all[third].final_doubt == 0);

    // A box that cannot be divided, half of which is in doubt.
    measuring::PhaseInBox half;
    half.phase = third;
    half.possible = PartOfBox(MeasuredBox(box.node.box, {}));
    half.certain.moments[0] = 4;
    half.slack = std::numeric_limits<double>::infinity();
    double mean = 0;
    int votes = 6;
    box.only.reset();
    box.phases = {&half, 1};
    box.mean_component = {&mean, 1};
    box.votes = {&votes, 1};
    part.add(box, context);
    box.can_be_divided = false;
    part.add(box, context);
    all.add(part);
    CHECK(all[third].final_doubt == 4);
    CHECK(all[third].doubt() == 8);
    CHECK(all[third].estimate[0] == 80 + 40 + 2 * 6);
}

TEST_CASE("quotients and products of moments include their rounding errors") {
    Random rng(5);
    for (int i = 0; i < 200; ++i) {
        // Two points with masses, as intervals of no width.
        const long double mass[] = {rng.unit() + 0.1, rng.unit() + 0.1};
        std::array<std::array<long double, 3>, 2> p{};
        for (auto& point : p)
            for (long double& c : point) c = rng.uniform(-1, 1);
        MomentBounds m;
        const auto integral = [&](auto&& of) { return static_cast<double>(mass[0] * of(p[0]) + mass[1] * of(p[1])); };
        using Point = std::array<long double, 3>;
        m.low[0] = integral([](const Point&) { return 1.0L; });
        for (std::size_t a = 0; a < 3; ++a) {
            m.low[1 + a] = integral([&](const Point& q) { return q[a]; });
            for (std::size_t b = a; b < 3; ++b)
                m.low[product_index(a, b)] = integral([&](const Point& q) { return q[a] * q[b]; });
        }
        m.high = m.estimate = m.low;
        const auto at = [&](std::size_t k) { return static_cast<long double>(m.low[k]); };
        const std::array<double, 3> origin{rng.unit(), 10 * rng.unit(), 0};
        const auto contains = [](const Measured& interval, long double v) {
            return static_cast<long double>(interval.low) < v && v < static_cast<long double>(interval.high);
        };
        MomentBounds scaled;
        scaled.add(m, 1.0 / 3);
        scaled.add(m, 1.0 / 7);
        const long double factor = static_cast<long double>(1.0 / 3) + static_cast<long double>(1.0 / 7);
        const Body body = body_of({}, m, origin);
        for (std::size_t k = 0; k < 10; ++k) CHECK(contains({scaled.low[k], scaled.high[k]}, factor * at(k)));
        for (std::size_t a = 0; a < 3; ++a) {
            CHECK(contains(body.centre[a], at(1 + a) / at(0) + static_cast<long double>(origin[a])));
            CHECK(body.centre[a].width() < 1e-13);
            for (std::size_t b = 0; b < 3; ++b) {
                const auto about = [&](std::size_t c, std::size_t d) {
                    return at(product_index(std::min(c, d), std::max(c, d))) - at(1 + c) * at(1 + d) / at(0);
                };
                const std::size_t c = (a + 1) % 3, d = (a + 2) % 3;
                CHECK(contains(body.inertia[a][b], a == b ? about(c, c) + about(d, d) : -about(a, b)));
                CHECK(body.inertia[a][b].width() < 1e-13);
            }
        }
    }
}

TEST_CASE("what follows from wide intervals holds wherever in them the moments are") {
    Random rng(6);
    for (int i = 0; i < 100; ++i) {
        MomentBounds m;
        for (std::size_t k = 0; k < 10; ++k) {
            m.low[k] = k == 0 ? rng.unit() + 0.1 : 2 * rng.unit() - 1;
            m.high[k] = m.low[k] + rng.unit();
        }
        const Body body = body_of({}, m, {});
        MomentBounds heavier = m;
        heavier.add(m, 3);
        for (int j = 0; j < 64; ++j) {
            Moments v{};
            for (std::size_t k = 0; k < 10; ++k) v[k] = rng.chance(0.5) ? m.low[k] : m.high[k];
            for (std::size_t k = 0; k < 10; ++k) CHECK(Measured{heavier.low[k], heavier.high[k]}.contains(4 * v[k]));
            const auto about = [&](std::size_t a, std::size_t b) {
                return v[product_index(a, b)] - v[1 + a] * v[1 + b] / v[0];
            };
            for (std::size_t a = 0; a < 3; ++a) {
                const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
                CHECK(body.centre[a].contains(v[1 + a] / v[0]));
                const double moment = about(b, b) + about(c, c);
                if (moment >= 0) CHECK(body.inertia[a][a].contains(moment));
                CHECK(body.inertia[a][b].contains(-about(a, b)));
                CHECK(body.inertia[b][a].contains(-about(a, b)));
            }
        }
    }
}

TEST_CASE("bodies of boxes have the moments of closed forms at every scale and position") {
    const glm::dvec3 positions[] = {{0, 0, 0}, {3, -2, 5}, {-1000, 500, 0}};
    for (const double scale : {1e-12, 1e-6, 1.0, 1e6, 1e13}) {
        for (const glm::dvec3& position : positions) {
            if (scale * glm::length(position) > 1e14) continue;  // beyond what 32-bit floats can trace
            INFO("scale " << scale << ", position " << position.x);
            ThreeBoxes three;
            three.scale = static_cast<double>(static_cast<float>(scale));
            three.at = three.scale * position;
            MeasureOptions options{.tolerance = glm::length(position) > 100 ? 5e-2 : 5e-3};
            options.densities = {{first, 2}, {third, 5}};
            const MeasureResult r = measure(three.object(), options);
            const double error = 1e-6 + 2e-7 * glm::length(position), size = 3 * three.scale;
            const double densities[] = {2, 2, 5};
            REQUIRE(r.phases.size() == 2);
            check_body(r.phases[0].body, exact(std::span(three.boxes).first(2), densities, three.at, three.scale), size,
                       error);
            REQUIRE(r.all);
            check_body(*r.all, exact(three.boxes, densities, three.at, three.scale), size, error);
        }
    }
}

TEST_CASE("the body of several phases leaves out phases without a density") {
    const ThreeBoxes three;
    MeasureOptions options{.tolerance = 5e-3};
    options.densities = {{third, 7}};
    const MeasureResult r = measure(three.object(), options);
    REQUIRE(r.all);
    const double densities[] = {7};
    check_body(*r.all, exact(std::span(three.boxes).last(1), densities, {}, 1), 3, 1e-6);
    CHECK(r.all->volume.contains(0.5));
    CHECK(r.all->volume.low < r.all->volume.high);
    CHECK_FALSE(r.phases.at(0).has_density);
}

TEST_CASE("extreme densities give true intervals or none") {
    const ThreeBoxes three;
    MeasureOptions options{.tolerance = 5e-2};
    for (const double density : {1e-300, 1e-100, 1e60, 1e99, 1e120, 1e200, 1e308}) {
        INFO("density " << density);
        options.densities = {{first, density}};
        const Body body = measure(three.object(), options).phases.at(0).body;
        const double unit[] = {1, 1};
        const Exact e = exact(std::span(three.boxes).first(2), unit, {}, 1);
        CHECK(body.mass.contains(e.mass * density));
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(body.centre[i].contains(e.centre[static_cast<int>(i)]));
            for (std::size_t j = 0; j < 3; ++j) CHECK(body.inertia[i][j].contains(e.inertia[i][j] * density));
        }
    }
}

TEST_CASE("the interval of a centre of mass is not wider than the box around the body") {
    // Far from the middle of the bounds, the moments of a coarse division say little about a small body.
    const Phased object =
        Under{.of = {Set{.phase = first, .of = warped(Translate{.by = {40, 0, 0}}, Field(Box{.size = {2, 1, 1}}))},
                     Set{.phase = third, .of = warped(Translate{.by = {-40, 3, 0}}, Field(Box{.size = {1, 1, 1}}))}}};
    for (const std::size_t boxes : {200, 2000, 20'000}) {
        CAPTURE(boxes);
        MeasureOptions options;
        options.max_boxes = boxes;
        options.densities = {{first, 3.0}};
        const MeasureResult r = measure(object, options);
        const auto check = [&](const Body& body, const MeasuredPhase& phase, double x) {
            for (std::size_t i = 0; i < 3; ++i) {
                if (!(body.mass.low > 0)) continue;
                CHECK(body.centre[i].low >= phase.box_low[i].low);
                CHECK(body.centre[i].high <= phase.box_high[i].high);
            }
            CHECK(body.centre[0].contains(x));
        };
        check(r.phases[0].body, r.phases[0], 40);
        check(r.phases[1].body, r.phases[1], -40);
        check(*r.all, r.phases[0], 40);
    }
}

}  // namespace test_measure_moments
