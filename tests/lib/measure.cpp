// Measuring: intervals contain what is known in closed form, whatever the object's place and orientation; results do
// not depend on threads; bad input is rejected in words.
#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <bit>
#include <cmath>
#include <string>

#include "phasetree/measuring/measure.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/capped_cone.hpp"
#include "phasetree/nodes/fields/cylinder.hpp"
#include "phasetree/nodes/fields/difference.hpp"
#include "phasetree/nodes/fields/intersection.hpp"
#include "phasetree/nodes/fields/plane.hpp"
#include "phasetree/nodes/fields/shell.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/torus.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "support/random_tree.hpp"

namespace test_measure {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

constexpr double pi = 3.141592653589793;
constexpr Phase first{1}, second{2}, third{3};

double cubed(double r) {
    return r * r * r;
}

// A solid whose volume is known, symmetric about a line along z through its centre of mass. For some, the moments of
// inertia about that line and across it are known too, for a density of 1; otherwise they are 0.
struct Known {
    std::string name;
    Field field;
    double volume = 0;
    double centre_z = 0;
    double inertia_along = 0, inertia_across = 0;
};

Known random_solid(Random& rng, int kind) {
    const float a = rng.uniform(0.3f, 1.2f), b = rng.uniform(0.3f, 1.2f), c = rng.uniform(0.05f, 0.25f);
    const double r = static_cast<double>(a), h = static_cast<double>(b), t = static_cast<double>(c);
    switch (kind) {
        case 0: {
            const double m = 4 * pi / 3 * cubed(r), i = 0.4 * m * r * r;
            return {"ball", Sphere{.radius = a}, m, 0, i, i};
        }
        case 1: {
            const double outer = r + t, inner = r - t, m = 4 * pi / 3 * (cubed(outer) - cubed(inner));
            const double i = 8 * pi / 15 * (std::pow(outer, 5) - std::pow(inner, 5));
            return {"shell", Shell{.of = Sphere{.radius = a}, .half_thickness = c}, m, 0, i, i};
        }
        case 2: {
            const double m = 2 * pi * pi * r * t * t;
            return {"torus", Torus{.major = a, .minor = c}, m,
                    0,       m * (r * r + 0.75 * t * t),    m * (0.5 * r * r + 0.625 * t * t)};
        }
        case 3: {
            const double m = pi * r * r * h;
            return {"cylinder",      Cylinder{.radius = a, .height = b}, m, 0,
                    0.5 * m * r * r, m * (3 * r * r + h * h) / 12};
        }
        case 4: {
            const double m = pi * h / 3 * (r * r + r * t + t * t);
            const double z = h / 4 * (r * r + 2 * r * t + 3 * t * t) / (r * r + r * t + t * t) - h / 2;
            return {"cone", CappedCone{.radius_bottom = a, .radius_top = c, .height = b}, m, z};
        }
        case 5:
        case 6: {
            const double d = 1.2 * r, height = r - d / 2;  // of each of the two caps
            const double lens = 2 * pi * height * height * (3 * r - height) / 3;
            const float off = static_cast<float>(d / 2);
            const std::vector<Field> balls{warped(Translate{.by = {0, 0, off}}, Sphere{.radius = a}),
                                           warped(Translate{.by = {0, 0, -off}}, Sphere{.radius = a})};
            if (kind == 5) return {"lens", Intersection{.of = balls}, lens};
            return {"two balls", Union{.of = balls}, 2 * 4 * pi / 3 * cubed(r) - lens};
        }
        default: {
            const float hole = 0.4f * std::min(a, b);
            const double block = r * r * h, ball = 4 * pi / 3 * cubed(static_cast<double>(hole));
            const double of_ball = 0.4 * ball * static_cast<double>(hole) * static_cast<double>(hole);
            return {"hollow block",
                    Difference{.from = Box{.size = {a, a, b}}, .subtract = {Sphere{.radius = hole}}},
                    block - ball,
                    0,
                    block * r * r / 6 - of_ball,
                    block * (r * r + h * h) / 12 - of_ball};
        }
    }
}

// The fraction by which rounding of parameters to 32 bits may change a volume.
constexpr double rounding = 2e-6;

bool is_near(const Measured& m, double v, double error) {
    return m.low <= v + error && v - error <= m.high;
}

MeasureOptions to(double tolerance) {
    return {.tolerance = tolerance};
}

Phased stack() {
    const auto ball = [](Phase p, float z) {
        return Phased(Set{.phase = p, .of = warped(Translate{.by = {0, 0, z}}, Sphere{.radius = 0.7f})});
    };
    return Under{.of = {ball(first, 0), ball(second, 0.5f), ball(third, 1)}};
}

const Measured& volume_of(const MeasureResult& r, Phase p) {
    for (const MeasuredPhase& m : r.phases)
        if (m.phase == p) return m.body.volume;
    FAIL("no phase " << int{p.index});
    return r.vacuum;
}

std::string message_of(const Phased& object, const MeasureOptions& options) {
    try {
        (void)measure(object, options);
    } catch (const ModelError& e) {
        return e.what();
    }
    return "";
}

}  // namespace

TEST_CASE("intervals contain volumes, centres of mass and moments of inertia in closed form") {
    Random rng(2024);
    for (int i = 0; i < (long_tests() ? 1000 : 24); ++i) {
        const Known known = random_solid(rng, i % 8);
        const glm::vec3 axis = rng.direction(), by = 3.f * rng.direction();
        const bool is_turned = i >= 8;
        const float angle = is_turned ? rng.uniform(0, 360) : 0;
        const Field turned = warped(Rotate{.axis = axis, .angle = angle}, known.field);
        const double tolerance = is_turned || known.name == "cone" ? 4e-2 : 8e-3;
        const MeasureResult r = measure(Set{.phase = second, .of = warped(Translate{.by = by}, turned)}, to(tolerance));
        INFO(known.name << " " << i);
        REQUIRE(r.phases.size() == 1);
        const MeasuredPhase& p = r.phases[0];
        const double v = known.volume, error = rounding * v;
        CHECK(r.end == MeasureEnd::tolerance);
        CHECK(p.body.volume.width() <= tolerance * v);
        CHECK(is_near(p.body.volume, v, error));
        CHECK(p.body.volume.estimate == doctest::Approx(v).epsilon(1e-2));
        // In each box, the estimates of the two phases add up to the box, so a lost box is found.
        const glm::dvec3 size = glm::dvec3(r.bounds.high) - glm::dvec3(r.bounds.low);
        const double all = size.x * size.y * size.z;
        CHECK(r.vacuum.estimate + p.body.volume.estimate == doctest::Approx(all).epsilon(1e-11));
        // An error of one percent is found.
        if (tolerance < 1e-2) {
            CHECK_FALSE(is_near(p.body.volume, 1.01 * v, error));
            CHECK_FALSE(is_near(p.body.volume, 0.99 * v, error));
        }
        // Rodrigues' rotation of the z axis.
        const double s = std::sin(double{angle} * pi / 180), c = std::cos(double{angle} * pi / 180);
        const glm::dvec3 k = glm::normalize(glm::dvec3(axis)), z(0, 0, 1);
        const glm::dvec3 d = z * c + glm::cross(k, z) * s + k * (glm::dot(k, z) * (1 - c));
        for (int j = 0; j < 3; ++j) {
            const auto a = static_cast<std::size_t>(j);
            const double centre = double{by[j]} + known.centre_z * d[j];
            CHECK(is_near(p.body.centre[a], centre, 4 * rounding));
            CHECK(p.body.centre[a].estimate == doctest::Approx(centre).epsilon(1e-2));
            for (int l = 0; known.inertia_along > 0 && l < 3; ++l) {
                const double across = known.inertia_across, more = known.inertia_along - across;
                const double moment = more * d[j] * d[l] + (j == l ? across : 0);
                const Measured& found = p.body.inertia[a][static_cast<std::size_t>(l)];
                CHECK(is_near(found, moment, 8 * rounding * v));
                CHECK(found.estimate == doctest::Approx(moment).epsilon(2e-2).scale(v));
            }
        }
    }
}

TEST_CASE("intervals contain the sides of the smallest box around a phase") {
    const Phased object =
        Set{.phase = first, .of = warped(Translate{.by = {1, 2, 4}}, Cylinder{.radius = 0.5f, .height = 3})};
    const MeasuredPhase p = measure(object, to(1e-2)).phases.at(0);
    const double low[] = {0.5, 1.5, 2.5}, high[] = {1.5, 2.5, 5.5};
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(is_near(p.box_low[i], low[i], 1e-6));
        CHECK(is_near(p.box_high[i], high[i], 1e-6));
        CHECK(p.box_low[i].width() < 4e-2);
        CHECK(p.box_high[i].width() < 4e-2);
    }
}

TEST_CASE("phases of a stack and the vacuum fill the bounds") {
    const MeasureResult r = measure(stack(), to(8e-3));
    REQUIRE(r.phases.size() == 3);
    const glm::dvec3 size = glm::dvec3(r.bounds.high) - glm::dvec3(r.bounds.low);
    double low = r.vacuum.low, high = r.vacuum.high, estimate = r.vacuum.estimate;
    for (const MeasuredPhase& p : r.phases) {
        low += p.body.volume.low;
        high += p.body.volume.high;
        estimate += p.body.volume.estimate;
    }
    const double all = size.x * size.y * size.z;
    CHECK(low <= all);
    CHECK(all <= high);
    CHECK(estimate == doctest::Approx(all).epsilon(1e-4));
    // A ball, less the lens that it shares with the ball over it. The third ball touches the first only within the
    // second.
    const double radius = 0.7, ball = 4 * pi / 3 * cubed(radius), height = radius - 0.25;
    const double lens = 2 * pi * height * height * (3 * radius - height) / 3;
    CHECK(is_near(volume_of(r, third), ball, rounding * ball));
    CHECK(is_near(volume_of(r, second), ball - lens, rounding * ball));
    CHECK_FALSE(is_near(volume_of(r, second), 1.01 * (ball - lens), rounding * ball));
}

TEST_CASE("masses, and several phases as one body") {
    const Phased two =
        Under{.of = {Set{.phase = first, .of = warped(Translate{.by = {-1, 0, 0}}, Sphere{.radius = 0.5f})},
                     Set{.phase = second, .of = warped(Translate{.by = {1, 0, 0}}, Sphere{.radius = 0.5f})}}};
    MeasureOptions options = to(1e-2);
    options.densities = {{first, 1}, {second, 3}};
    const MeasureResult r = measure(two, options);
    const double v = 4 * pi / 3 * cubed(0.5);
    REQUIRE(r.all);
    CHECK(is_near(r.all->volume, 2 * v, rounding));
    CHECK(is_near(r.all->mass, 4 * v, rounding));
    CHECK(r.all->mass.width() < 1e-2 * 4 * v);
    CHECK(is_near(r.all->centre[0], 0.5, rounding));
    // By Steiner: both balls, and their distances of 1.5 and 0.5 from the centre of mass.
    const double own = 0.4 * 4 * v * 0.25, apart = v * 1.5 * 1.5 + 3 * v * 0.5 * 0.5;
    CHECK(is_near(r.all->inertia[0][0], own, rounding));
    CHECK(is_near(r.all->inertia[1][1], own + apart, rounding));
    CHECK(r.all->inertia[1][1].width() < 0.05 * (own + apart));
    CHECK(r.phases.at(1).has_density);
    CHECK(is_near(r.phases.at(1).body.mass, 3 * v, rounding));

    options.densities = {{second, 0}};
    const MeasureResult massless = measure(two, options);
    CHECK(massless.all->mass.high < 1e-9);
    CHECK_FALSE(std::isfinite(massless.all->centre[0].high));
}

TEST_CASE("the result is the same for any number of threads, and after a cancelled measurement, to the last bit") {
    const auto bits_of = [](const MeasureResult& r) {
        std::vector<std::uint64_t> bits{r.boxes};
        const auto add = [&](const Measured& m) {
            for (const double v : {m.low, m.high, m.estimate}) bits.push_back(std::bit_cast<std::uint64_t>(v));
        };
        add(r.vacuum);
        for (const MeasuredPhase& p : r.phases) {
            add(p.body.volume);
            for (std::size_t j = 0; j < 3; ++j) {
                add(p.body.centre[j]);
                add(p.box_low[j]);
                add(p.box_high[j]);
                for (std::size_t l = 0; l < 3; ++l) add(p.body.inertia[j][l]);
            }
        }
        return bits;
    };
    const Phased object = stack();
    std::vector<std::uint64_t> bits[3];
    const int threads[] = {1, 2, 4};
    for (std::size_t i = 0; i < 3; ++i) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 4);
        tbb::task_arena arena(threads[i]);
        std::atomic<int> polls{0};
        MeasureOptions options = to(3e-2);
        options.cancelled = [&] { return ++polls > 100; };
        const MeasureResult cancelled = arena.execute([&] { return measure(object, options); });
        CHECK(cancelled.end == MeasureEnd::cancelled);
        const MeasureResult r = arena.execute([&] { return measure(object, to(3e-2)); });
        bits[i] = bits_of(r);
        for (std::size_t k = 0; k < r.phases.size(); ++k) {
            const Measured &less = cancelled.phases.at(k).body.volume, &more = r.phases[k].body.volume;
            CHECK(less.low <= more.estimate);
            CHECK(more.estimate <= less.high);
            CHECK(less.width() >= more.width());
        }
    }
    CHECK(bits[0] == bits[1]);
    CHECK(bits[0] == bits[2]);
}

TEST_CASE("measuring ends as requested, with intervals that are certain") {
    const Phased ball = Set{.phase = first, .of = Sphere{.radius = 1}};
    const double v = 4 * pi / 3;
    std::vector<float> told;
    MeasureOptions options = to(1e-9);
    options.max_boxes = 30'000;
    options.progress = [&](float share) { told.push_back(share); };
    const MeasureResult few = measure(ball, options);
    CHECK(few.end == MeasureEnd::boxes);
    CHECK(few.boxes < 40'000);
    CHECK(few.phases.at(0).body.volume.contains(v));
    CHECK(few.phases.at(0).body.volume.width() < 0.05);
    REQUIRE_FALSE(told.empty());
    CHECK(told.back() == 1);
    CHECK(std::is_sorted(told.begin(), told.end()));

    options = to(1e-9);
    options.seconds = 0.05;
    const MeasureResult fast = measure(ball, options);
    CHECK(fast.end == MeasureEnd::seconds);
    CHECK(fast.phases.at(0).body.volume.contains(v));

    options = to(1e-9);
    options.cancelled = [] { return true; };
    const MeasureResult cancelled = measure(ball, options);
    CHECK(cancelled.end == MeasureEnd::cancelled);
    CHECK(cancelled.phases.at(0).body.volume.contains(v));

    // The faces of a box are planes, so only its edges are in doubt, until rounding errors are all that is left.
    const MeasureResult box = measure(Set{.phase = first, .of = Box{.size = {1, 1, 1}}}, to(1e-6));
    CHECK(box.end == MeasureEnd::precision);
    CHECK(box.phases.at(0).body.volume.contains(1));
    CHECK(box.phases.at(0).body.volume.width() < 1e-4);
}

TEST_CASE("measuring ends when what is known is enough") {
    const Phased ball = Set{.phase = first, .of = Sphere{.radius = 1}};
    const double v = 4 * pi / 3;
    std::vector<double> widths;
    MeasureOptions options = to(2e-3);
    options.is_enough = [&](const MeasureResult& known) {
        const Measured& volume = known.phases.at(0).body.volume;
        CHECK(volume.contains(v));
        widths.push_back(volume.width());
        return volume.low > 3.9;
    };
    const MeasureResult enough = measure(ball, options);
    CHECK(enough.end == MeasureEnd::enough);
    CHECK(enough.phases.at(0).body.volume.low > 3.9);
    CHECK(std::is_sorted(widths.rbegin(), widths.rend()));
    const MeasureResult all = measure(ball, to(2e-3));
    CHECK(enough.boxes * 3 < all.boxes);
    // What is never enough changes no bit.
    options.is_enough = [](const MeasureResult&) { return false; };
    const MeasureResult never = measure(ball, options);
    CHECK(never.end == MeasureEnd::tolerance);
    CHECK(never.boxes == all.boxes);
    CHECK(never.phases.at(0).body.volume.low == all.phases.at(0).body.volume.low);
}

TEST_CASE("only the phases that must be precise are divided finely") {
    const Phased object =
        Under{.of = {Set{.phase = first, .of = Sphere{.radius = 1}},
                     Set{.phase = second, .of = warped(Translate{.by = {5, 0, 0}}, Sphere{.radius = 1})}}};
    MeasureOptions options = to(1e-3);
    const MeasureResult both = measure(object, options);
    options.precise_phases = PhaseSet::of(second);
    const MeasureResult one = measure(object, options);
    CHECK(one.end == MeasureEnd::tolerance);
    CHECK(volume_of(one, second).width() <= 1e-3 * volume_of(one, second).low);
    CHECK(volume_of(one, first).contains(4 * pi / 3));
    CHECK(volume_of(one, first).width() > 1e-3 * volume_of(one, first).high);
    CHECK(one.boxes * 10 < both.boxes * 7);
}

TEST_CASE("the reasons for an end have names") {
    CHECK(name_of(MeasureEnd::tolerance) == "tolerance");
    CHECK(name_of(MeasureEnd::precision) == "precision");
    CHECK(name_of(MeasureEnd::seconds) == "time");
    CHECK(name_of(MeasureEnd::boxes) == "boxes");
    CHECK(name_of(MeasureEnd::cancelled) == "interrupted");
    CHECK(name_of(MeasureEnd::enough) == "enough");
}

TEST_CASE("a phase that is hidden has a volume of zero") {
    const Phased hidden = Under{
        .of = {Set{.phase = first, .of = Sphere{.radius = 0.5f}}, Set{.phase = second, .of = Sphere{.radius = 1}}}};
    const MeasureResult r = measure(hidden, to(1e-2));
    CHECK(volume_of(r, first).contains(0));
    CHECK(volume_of(r, first).high < 1e-4);
    CHECK(is_near(volume_of(r, second), 4 * pi / 3, rounding));
}

TEST_CASE("bad input is rejected in words") {
    const Phased ball = Set{.phase = first, .of = Sphere{.radius = 1}};
    const Phased half_space = Set{.phase = first, .of = Plane{}};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(message_of(half_space, {}).starts_with("the object is unbounded"));
    for (const double tolerance : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()})
        CHECK(message_of(ball, {.tolerance = tolerance}).starts_with("the tolerance must be a positive number"));
    for (const double seconds : {0.0, -1.0, nan})
        CHECK(message_of(ball, {.seconds = seconds}).starts_with("the time must be a positive number"));
    CHECK(message_of(ball, {.densities = {{second, 1}}}) == "the object has no phase 2, so it needs no density");
    CHECK(message_of(ball, {.densities = {{vacuum, 1}}}) == "the vacuum has no density");
    for (const double density : {-1.0, nan, std::numeric_limits<double>::infinity()})
        CHECK(message_of(ball, {.densities = {{first, density}}}).starts_with("the density of phase 1 must not be"));
}

}  // namespace test_measure
