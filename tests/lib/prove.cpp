// Statements about objects: what is true by construction is proved, what is not is refuted with points that show it,
// and nothing is decided against dense samples. Objects have planted defects, and labels in closed form, in double
// precision, which know nothing of fields.
#include "phasetree/measuring/prove.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "phasetree/nodes/list.hpp"
#include "support/long_tests.hpp"
#include "support/simple_shapes.hpp"

namespace test_prove {

using namespace phasetree;
using namespace phasetree::tests;
using namespace phasetree::tests::simple;

namespace {

using Label = std::function<int(const Point&)>;

// An object, and its label at a point by closed forms.
struct Subject {
    Phased object;
    Label label;
    double size;  // half of its longest side, or more
};

bool is_in_ball(const Point& p, const Point& centre, double radius) {
    return glm::length(p - centre) < radius;
}
bool is_in_block(const Point& p, const Point& half) {
    return std::abs(p.x) < half.x && std::abs(p.y) < half.y && std::abs(p.z) < half.z;
}

// A vessel of glass, a ball or a block, filled with water; its wall is as thick as said.
struct Vessel {
    bool is_ball;
    Point half;
    double wall;

    explicit Vessel(UniformReals& random)
        : is_ball(random(0, 1) < 0.5), half(random(0.7, 1.2)), wall(random(0.16, 0.24)) {
        if (!is_ball) half = {half.x, half.x * random(0.7, 1), half.x * random(0.7, 1)};
    }
    Field outer() const { return is_ball ? ball({}, half.x) : block(half); }
    Field inner() const { return is_ball ? ball({}, half.x - wall) : block(half - wall); }
    bool is_in_outer(const Point& p) const { return is_ball ? is_in_ball(p, {}, half.x) : is_in_block(p, half); }
    bool is_in_inner(const Point& p) const {
        return is_ball ? is_in_ball(p, {}, half.x - wall) : is_in_block(p, half - wall);
    }
    // The middle of the wall somewhere, away from edges, and the direction from inside to outside there.
    std::pair<Point, Point> somewhere_in_wall(UniformReals& random) const {
        if (is_ball) {
            const Point d = random.direction();
            return {d * (half.x - 0.5 * wall), d};
        }
        const auto axis = static_cast<int>(random(0, 2.999));
        const double sign = random(0, 1) < 0.5 ? -1 : 1;
        Point p, d(0);
        for (int i = 0; i < 3; ++i) p[i] = random(-0.4, 0.4) * half[i];
        p[axis] = sign * (half[axis] - 0.5 * wall);
        d[axis] = sign;
        return {p, d};
    }
};

// The vessel with these parts cut from it and from the water.
Subject vessel_without(const Vessel& v, const std::vector<std::pair<Point, double>>& balls, bool cuts_water) {
    std::vector<Field> cut{v.inner()};
    std::vector<Field> from_water;
    for (const auto& [centre, radius] : balls) {
        cut.push_back(ball(centre, radius));
        from_water.push_back(ball(centre, radius));
    }
    const Field filling =
        cuts_water && !from_water.empty() ? Field(Difference{.from = v.inner(), .subtract = from_water}) : v.inner();
    const Phased object = Over{.of = {set(glass, Difference{.from = v.outer(), .subtract = cut}), set(water, filling)}};
    const Label label = [v, balls, cuts_water](const Point& p) {
        bool is_cut = false;
        for (const auto& [centre, radius] : balls) is_cut = is_cut || is_in_ball(p, centre, radius);
        if (v.is_in_inner(p)) return cuts_water && is_cut ? 0 : static_cast<int>(water.index);
        return v.is_in_outer(p) && !is_cut ? static_cast<int>(glass.index) : 0;
    };
    return {object, label, glm::length(v.half)};
}

std::vector<Proof> proofs_of(const Subject& s, const std::vector<Statement>& statements) {
    ProveOptions options;
    options.resolution = 0.03;
    const std::vector<Proof> proofs = prove(s.object, statements, options);
    for (const Proof& proof : proofs)
        for (const Witness& w : proof.witnesses) CHECK(s.label(Point(w.point)) == static_cast<int>(w.phase.index));
    return proofs;
}

// A point of the phase that has no ball of this diameter within reach, checked by sampling: around each centre on a
// fine grid there is a point outside the phase that is closer than the radius.
bool is_thin_by_samples(const Subject& s, const Point& p, Phase phase, double diameter) {
    const double reach = diameter, radius = diameter / 2, step = diameter / 6;
    if (s.label(p) != static_cast<int>(phase.index)) return false;
    std::vector<Point> directions;
    UniformReals random{std::mt19937(7)};
    for (int i = 0; i < 200; ++i) directions.push_back(random.direction());
    for (double x = -reach; x <= reach; x += step)
        for (double y = -reach; y <= reach; y += step)
            for (double z = -reach; z <= reach; z += step) {
                const Point c = p + Point(x, y, z);
                if (glm::length(c - p) > reach) continue;
                bool has_outside = false;
                for (double r = 0.98 * radius; r > 0 && !has_outside; r -= radius / 6)
                    for (const Point& d : directions)
                        if (has_outside = s.label(c + r * d) != static_cast<int>(phase.index); has_outside) break;
                if (!has_outside) return false;
            }
    return true;
}

// Each segment of the path is outside the walls, and the path leads from the inside to far outside.
bool is_leak_by_samples(const Subject& s, const Proof& proof) {
    const std::vector<Witness>& path = proof.witnesses;
    if (path.size() < 2 || path.front().phase != water || path.back().phase != vacuum) return false;
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
        for (int k = 0; k <= 50; ++k)
            if (s.label(glm::mix(Point(path[i].point), Point(path[i + 1].point), k / 50.0)) ==
                static_cast<int>(glass.index))
                return false;
    return glm::length(Point(path.back().point)) > 0.9 * s.size / std::sqrt(3.0);
}

// In all, 66 defects, or 224 in the long form.
int count_of_defects() {
    return long_tests() ? 48 : 14;
}

}  // namespace

TEST_CASE("a sound vessel is closed, connected, thick and full") {
    for (int i = 0; i < (long_tests() ? 12 : 3); ++i) {
        CAPTURE(i);
        UniformReals random{std::mt19937(static_cast<unsigned>(i))};
        const Vessel v(random);
        const Subject s = vessel_without(v, {}, false);
        const std::vector<Proof> proofs =
            proofs_of(s, {IsPresent{glass}, IsConnected{glass}, IsConnected{water},
                          IsClosed{PhaseSet::of(glass), PhaseSet::of(water)}, AreTouching{glass, water},
                          AreApart{water, vacuum, 0.4 * v.wall}, IsThick{glass, 0.8 * v.wall}, IsThick{water, 0.3}});
        for (std::size_t k = 0; k < proofs.size(); ++k) {
            CAPTURE(k);
            CHECK(proofs[k].verdict == phasetree::Verdict::proved);
        }
    }
}

TEST_CASE("holes in the wall are refuted with a path through them") {
    for (int i = 0; i < count_of_defects(); ++i) {
        CAPTURE(i);
        UniformReals random{std::mt19937(static_cast<unsigned>(100 + i))};
        const Vessel v(random);
        const auto [centre, outwards] = v.somewhere_in_wall(random);
        // A ball that is larger than the wall is thick.
        const double radius = v.wall * random(0.75, 1.1);
        const Subject s = vessel_without(v, {{centre, radius}}, true);
        const std::vector<Proof> proofs =
            proofs_of(s, {IsClosed{PhaseSet::of(glass), PhaseSet::of(water)}, AreApart{water, vacuum, 0}});
        CHECK(proofs[0].verdict == phasetree::Verdict::refuted);
        CHECK(is_leak_by_samples(s, proofs[0]));
        CHECK(proofs[1].verdict == phasetree::Verdict::refuted);
    }
}

TEST_CASE("dents that leave too thin a wall are refuted with a point in it") {
    for (int i = 0; i < count_of_defects() / 2; ++i) {
        CAPTURE(i);
        UniformReals random{std::mt19937(static_cast<unsigned>(200 + i))};
        const Vessel v(random);
        const auto [centre, outwards] = v.somewhere_in_wall(random);
        // A large ball from outside leaves a third of the wall or less.
        const double left = v.wall * random(0.2, 0.33), radius = random(0.8, 1.5);
        const Point surface = centre - outwards * (0.5 * v.wall - left);
        const Subject s = vessel_without(v, {{surface + outwards * radius, radius}}, false);
        const Proof proof = proofs_of(s, {IsThick{glass, 0.8 * v.wall}})[0];
        CHECK(proof.verdict == phasetree::Verdict::refuted);
        REQUIRE(proof.witnesses.size() == 1);
        CHECK(is_thin_by_samples(s, Point(proof.witnesses[0].point), glass, 0.8 * v.wall));
    }
}

TEST_CASE("drops that are separate pieces are refuted with a point in each of two") {
    for (int i = 0; i < count_of_defects(); ++i) {
        CAPTURE(i);
        UniformReals random{std::mt19937(static_cast<unsigned>(300 + i))};
        const double radius = random(0.4, 0.8), drop = random(0.12, 0.3), gap = random(0.08, 0.3);
        const bool is_apart = i % 3 != 2;
        // Along an axis, the seams of a bridge have a direction in which the distance falls.
        const Point at = (is_apart ? random.direction() : Point(0, 1, 0)) * (radius + gap + drop);
        const double bridge = 0.7 * drop;
        std::vector<Field> parts{ball({}, radius), ball(at, drop)};
        if (!is_apart) parts.push_back(Capsule{.from = {}, .to = glm::vec3(at), .radius = static_cast<float>(bridge)});
        const Subject s{set(water, Union{.of = parts}),
                        [=](const Point& p) {
                            const double t = std::clamp(glm::dot(p, at) / glm::dot(at, at), 0.0, 1.0);
                            const bool is_in = is_in_ball(p, {}, radius) || is_in_ball(p, at, drop) ||
                                               (!is_apart && is_in_ball(p, t * at, bridge));
                            return is_in ? static_cast<int>(water.index) : 0;
                        },
                        radius + gap + 2 * drop};
        const Proof proof = proofs_of(s, {IsConnected{water}})[0];
        CHECK(proof.verdict == (is_apart ? phasetree::Verdict::refuted : phasetree::Verdict::proved));
        if (!is_apart) continue;
        REQUIRE(proof.witnesses.size() == 2);
        const bool is_first_in_drop = is_in_ball(Point(proof.witnesses[0].point), at, drop);
        CHECK(is_first_in_drop != is_in_ball(Point(proof.witnesses[1].point), at, drop));
    }
}

TEST_CASE("gaps that are too small are refuted with two points, and others are proved") {
    for (int i = 0; i < count_of_defects(); ++i) {
        CAPTURE(i);
        UniformReals random{std::mt19937(static_cast<unsigned>(400 + i))};
        const double a = random(0.3, 0.8), b = random(0.3, 0.8), gap = random(0.2, 0.4);
        const Point at = random.direction() * (a + gap + b);
        const Subject s{Over{.of = {set(glass, ball({}, a)), set(iron, ball(at, b))}},
                        [=](const Point& p) {
                            return is_in_ball(p, {}, a)   ? static_cast<int>(glass.index)
                                   : is_in_ball(p, at, b) ? static_cast<int>(iron.index)
                                                          : 0;
                        },
                        a + gap + 2 * b};
        const std::vector<Proof> proofs =
            proofs_of(s, {AreApart{glass, iron, 1.6 * gap}, AreApart{glass, iron, 0.6 * gap}, AreApart{glass, iron, 0},
                          AreTouching{glass, iron}});
        CHECK(proofs[0].verdict == phasetree::Verdict::refuted);
        REQUIRE(proofs[0].witnesses.size() == 2);
        CHECK(glm::length(Point(proofs[0].witnesses[0].point) - Point(proofs[0].witnesses[1].point)) < 1.6 * gap);
        CHECK(proofs[1].verdict == phasetree::Verdict::proved);
        CHECK(proofs[2].verdict == phasetree::Verdict::proved);
        CHECK(proofs[3].verdict == phasetree::Verdict::refuted);
    }
}

TEST_CASE("phases that others swallow are nowhere") {
    for (int i = 0; i < 2 * count_of_defects(); ++i) {
        CAPTURE(i);
        UniformReals random{std::mt19937(static_cast<unsigned>(500 + i))};
        const double radius = random(0.5, 1), hidden = random(0.1, 0.4);
        const Point at = random.direction() * random(0, 0.9 * (radius - hidden));
        const bool is_hidden = i % 4 != 3;
        const Phased inner = set(iron, ball(is_hidden ? at : at * 3.0 + Point(radius, 0, 0), hidden));
        const Subject s{Over{.of = {set(glass, ball({}, radius)), inner}},
                        [=](const Point& p) {
                            if (is_in_ball(p, {}, radius)) return static_cast<int>(glass.index);
                            const Point centre = is_hidden ? at : at * 3.0 + Point(radius, 0, 0);
                            return is_in_ball(p, centre, hidden) ? static_cast<int>(iron.index) : 0;
                        },
                        4};
        const std::vector<Proof> proofs = proofs_of(
            s, {IsPresent{iron}, IsConnected{iron}, IsPresent{glass}, HasVolume{{{glass, 1.0}, {iron, 1.0}}, 0, 100}});
        CHECK(proofs[2].verdict == phasetree::Verdict::proved);
        if (is_hidden) {
            CHECK(proofs[0].verdict == phasetree::Verdict::refuted);
            CHECK(proofs[0].witnesses.empty());
            CHECK(proofs[1].verdict == phasetree::Verdict::refuted);
            CHECK(proofs[3].verdict == phasetree::Verdict::refuted);
        } else {
            CHECK(proofs[0].verdict == phasetree::Verdict::proved);
            CHECK(proofs[3].verdict == phasetree::Verdict::proved);
        }
    }
}

TEST_CASE("volumes within and beyond limits") {
    const Subject s{set(glass, ball({}, 1)),
                    [](const Point& p) { return is_in_ball(p, {}, 1) ? static_cast<int>(glass.index) : 0; }, 1};
    const double volume = 4.0 / 3 * 3.141592653589793;
    const std::vector<Proof> proofs = proofs_of(
        s, {HasVolume{{{glass, 1.0}}, 0.99 * volume, 1.01 * volume},
            HasVolume{{{glass, 1.0}}, 1.05 * volume, 2 * volume}, HasVolume{{{glass, 2.0}}, 0, 1.99 * volume}});
    CHECK(proofs[0].verdict == phasetree::Verdict::proved);
    CHECK(proofs[1].verdict == phasetree::Verdict::refuted);
    CHECK(proofs[2].verdict == phasetree::Verdict::refuted);
    CHECK(proofs[0].measured.contains(volume));
}

TEST_CASE("a proof ends as soon as all is decided, and tells how far it is") {
    const Phased object = Over{.of = {set(glass, ball({0.5, 0, 0}, 1)), set(iron, ball({4, 0, 0}, 1))}};
    const double volume = 4.0 / 3 * 3.141592653589793;
    // The second statement needs a much finer division than the first, and neither needs much time.
    const std::vector<Statement> statements{HasVolume{{{glass, 1.0}}, 0.9 * volume, 1.1 * volume},
                                            HasVolume{{{iron, 1.0}}, 0.999 * volume, 1.001 * volume},
                                            IsThick{glass, 0.5}, HasNoDeadNodes{}};
    ProveOptions options;
    options.resolution = 0.1;
    options.seconds = 1000;
    std::vector<float> told;
    options.progress = [&](float share) { told.push_back(share); };
    const auto start = std::chrono::steady_clock::now();
    for (const Proof& proof : prove(object, statements, options)) CHECK(proof.verdict == phasetree::Verdict::proved);
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(250));
    REQUIRE(told.size() > 1);
    CHECK(std::is_sorted(told.begin(), told.end()));
    CHECK(told.back() == 1);
    CHECK(told.front() < 1);
}

TEST_CASE("volumes that no measurement decides leave time for other statements") {
    const Phased object = set(glass, ball({}, 1));
    // The limit is the volume, so every interval contains it.
    const std::vector<Statement> statements{HasVolume{{{glass, 1.0}}, 4.0 / 3 * 3.141592653589793, 100},
                                            IsThick{glass, 0.5}};
    ProveOptions options;
    options.resolution = 0.1;
    options.seconds = 3;
    const std::vector<Proof> proofs = prove(object, statements, options);
    CHECK(proofs[0].verdict == phasetree::Verdict::undecided);
    CHECK(proofs[1].verdict == phasetree::Verdict::proved);
}

TEST_CASE("witnesses of contact are near the contact, and near each other") {
    const Phased object = Over{.of = {set(glass, ball({}, 1)), set(iron, ball({}, 1.5))}};
    ProveOptions options;
    options.resolution = 0.02;
    const std::vector<Statement> statements{AreTouching{glass, iron}, AreApart{glass, iron, 0.1}};
    for (const Proof& proof : prove(object, statements, options)) {
        REQUIRE(proof.witnesses.size() == 2);
        const Point a(proof.witnesses[0].point), b(proof.witnesses[1].point);
        CHECK(glm::length(a) < 1);
        CHECK(glm::length(b) > 1);
        CHECK(glm::length(a - b) < 8 * proof.resolution);
    }
}

TEST_CASE("a thin wall is found in boxes much larger than what it lacks") {
    // A film that no box of the division is inside.
    const Subject s{set(glass, Shell{.of = ball({}, 1), .half_thickness = 0.004f}),
                    [](const Point& p) { return std::abs(glm::length(p) - 1) < 0.004 ? 1 : 0; }, 1.1};
    const Proof proof = proofs_of(s, {IsThick{glass, 0.5}})[0];
    CHECK(proof.verdict == phasetree::Verdict::refuted);
}

TEST_CASE("time, boxes and cancellation leave statements undecided, with the reason") {
    UniformReals random{std::mt19937(1)};
    const Subject s = vessel_without(Vessel(random), {}, false);
    const std::vector<Statement> statements{IsThick{glass, 1e-4}};
    ProveOptions options;
    options.max_boxes = 5000;
    CHECK(prove(s.object, statements, options)[0].reason == "more boxes are needed than allowed");
    options = {};
    options.cancelled = [] { return true; };
    CHECK(prove(s.object, statements, options)[0].reason == "interrupted");
    options = {};
    options.seconds = 1e-9;
    CHECK(prove(s.object, statements, options)[0].reason == "time ran out");
}

TEST_CASE("walls cannot be thicker than the object, however large the number") {
    const Phased object = set(glass, ball({}, 1));
    ProveOptions options;
    options.resolution = 0.2;
    for (const double at_least : {5.0, 1e30, 1e300}) {
        const Proof proof = prove(object, std::vector<Statement>{IsThick{glass, at_least}}, options)[0];
        CHECK(proof.verdict == phasetree::Verdict::refuted);
        REQUIRE(proof.witnesses.size() == 1);
        CHECK(glm::length(proof.witnesses[0].point) < 1);
    }
    // What fits is not refuted.
    for (const double at_least : {1.0, 1.5, 1.8})
        CHECK(prove(object, std::vector<Statement>{IsThick{glass, at_least}}, options)[0].verdict !=
              phasetree::Verdict::refuted);
}

TEST_CASE("statements that make no sense are errors") {
    const Phased object = set(glass, ball({}, 1));
    const auto error = [&](const Statement& s) {
        try {
            (void)prove(object, std::vector{s});
        } catch (const ModelError& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    CHECK(error(IsThick{glass, 0}) == "the thickness must be a finite, positive number, but is 0");
    CHECK(error(IsThick{glass, 1, 0.5}) == "the reach must be more than half of the thickness, 0.5, but is 0.5");
    CHECK(error(IsThick{vacuum, 1}) == "the vacuum has no walls");
    CHECK(error(AreApart{glass, glass}) == "the two phases of a statement must differ");
    CHECK(error(AreApart{glass, vacuum, -1}) == "the distance must be a finite, non-negative number, but is -1");
    CHECK(error(IsClosed{PhaseSet::of(glass), PhaseSet::of(glass)}) ==
          "a phase cannot be both a wall and inside the walls");
    CHECK(error(IsClosed{PhaseSet::of(vacuum), PhaseSet::of(glass)}) ==
          "the vacuum surrounds the object, so it is neither a wall nor inside walls");
    CHECK(error(HasVolume{{{glass, 1.0}}, 2, 1}) == "the least volume must not be more than the greatest");
}

}  // namespace test_prove
