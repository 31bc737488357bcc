// Compares enclosures with what they enclose: values, gradients and curvatures of every primitive at random points of
// random boxes.
#include "enclosure/enclosure.hpp"

#include <doctest/doctest.h>

#include "bounding/convex_in_box.hpp"
#include "enclosure/difference.hpp"
#include "math/dual.hpp"
#include "phasetree/model/concepts.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/copies/endless_grid.hpp"
#include "support/random_tree.hpp"
#include "tree/node.hpp"
#include "tree/walk.hpp"

namespace test_enclosure {

using namespace phasetree;
using namespace phasetree::tests;

using bounding::AffinePoint, bounding::enclose_convex;
using enclosure::Enclosure, enclosure::least_difference, enclosure::Interval;

namespace {

struct CellBuffer {
    std::size_t points = 0, outside = 0, off_slope = 0, steep = 0;
    std::size_t beyond_half = 0;  ///< points that half of the range would not have held
    std::size_t chords = 0, off_chord = 0;
    std::size_t curved = 0;  ///< chords that half of the curvature would not have held
};

/// Values and gradients are computed in floats; tests/lib checks their accuracy.
constexpr double value_error = 1e-5, gradient_error = 1e-4;
/// Of the mean of two values less a third, each of a few numbers up to 3 rounded to 2⁻²³.
constexpr double chord_error = 2e-6;

/// Of two random points, near each other or not, the middle is above the mean of both by what the curvature allows. The
/// values' rounding counts; so does that a chord is short for it to matter less than the curvature.
template <class Primitive>
void check_chord(const Primitive& n, const Enclosure& e, const glm::vec3& centre, const glm::vec3& half, Random& rng,
                 CellBuffer& found) {
    const auto at = [&](const glm::vec3& q) { return static_cast<double>(n.distance(Vec3<float>{q.x, q.y, q.z})); };
    const auto inside = [&] { return glm::vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)); };
    const glm::vec3 a = centre + half * inside(), b = centre + half * inside(), m = 0.5f * (a + b);
    const double squared = glm::dot(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(b) - glm::dvec3(a)) / 8;
    const double sag = 0.5 * (at(a) + at(b)) - at(m);
    const auto holds = [&](double share) {
        return sag <= share * e.curvature.high * squared + chord_error &&
               sag >= share * e.curvature.low * squared - chord_error;
    };
    if (!(e.curvature.high < 1e30) && !(e.curvature.low > -1e30)) return;
    ++found.chords;
    found.off_chord += !holds(1);
    found.curved += !holds(0.5);
}

/// `enclose(p, half extents)` encloses the primitive's distance, or says that it cannot.
template <class Primitive, class Enclose>
void look(const Primitive& n, Random& rng, int boxes, CellBuffer& found, Enclose&& enclose) {
    for (int box = 0; box < boxes; ++box) {
        const glm::vec3 centre = rng.uniform(0, 1.5f) * rng.direction();
        const float size = std::exp2(rng.uniform(-9, 0));
        const glm::vec3 half = size * glm::vec3(rng.uniform(0.2f, 1), rng.uniform(0.2f, 1), rng.uniform(0.2f, 1));
        std::array<double, 3> extent;
        Vec3<Enclosure> p;
        Enclosure* const axes[] = {&p.x, &p.y, &p.z};
        for (int i = 0; i < 3; ++i) {
            extent[static_cast<std::size_t>(i)] = static_cast<double>(half[i]);
            *axes[i] = Enclosure::coordinate(i, static_cast<double>(centre[i]), static_cast<double>(half[i]));
        }
        const std::optional<Enclosure> enclosed = enclose(p, extent);
        if (!enclosed) continue;
        const Enclosure e = enclosed->tightened(extent);
        CHECK(std::abs(e.centre - static_cast<double>(n.distance(Vec3<float>{centre.x, centre.y, centre.z}))) <
              value_error);
        for (int k = 0; k < 16; ++k) {
            const glm::vec3 d = half * glm::vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
            const glm::vec3 q = centre + d;
            const Dual g = n.distance(Vec3<Dual>{Dual(q.x, 1, 0, 0), Dual(q.y, 0, 1, 0), Dual(q.z, 0, 0, 1)});
            const auto v = static_cast<double>(g.value());
            ++found.points;
            found.outside += !(v >= e.value.low - value_error && v <= e.value.high + value_error);
            Interval change{0, 0};
            const glm::vec3 gradient = g.gradient();
            const std::array<float, 3> slope{gradient.x, gradient.y, gradient.z};
            for (std::size_t i = 0; i < 3; ++i) {
                change = change + e.gradient[i] * static_cast<double>(d[static_cast<int>(i)]);
                const auto s = static_cast<double>(slope[i]);
                found.steep += !(s >= e.gradient[i].low - gradient_error && s <= e.gradient[i].high + gradient_error);
            }
            const double actual = v - e.centre;
            found.off_slope += !(actual >= change.low - value_error && actual <= change.high + value_error);
            check_chord(n, e, centre, half, rng, found);
            found.beyond_half += std::abs(actual - change.middle()) > 0.25 * (change.high - change.low) + value_error;
        }
    }
}

}  // namespace

TEST_CASE("an enclosure holds the values and the gradients of every primitive") {
    std::size_t kinds = 0, curved_kinds = 0;
    CellBuffer all;
    for (const NodeKind& kind : node_kinds()) {
        Random rng = random_for(23, kind);
        if (!kind.is_field) continue;
        CAPTURE(kind.name);
        CellBuffer found;
        for (int i = 0; i < (long_tests() ? 500 : 20); ++i) {
            const Field f = kind.field(rng, 1);
            std::visit(
                [&](const auto& n) {
                    using N = std::remove_cvref_t<decltype(n)>;
                    if constexpr (Primitive<N> && !LongPrimitive<N>)
                        look(n, rng, 40, found, [&](const Vec3<Enclosure>& p, const Enclosure::Vector&) {
                            return std::optional(n.distance(p));
                        });
                },
                f.node()->node);
        }
        CHECK(found.outside == 0);
        CHECK(found.off_slope == 0);
        CHECK(found.steep == 0);
        CHECK(found.off_chord == 0);
        kinds += found.points > 0;
        all.points += found.points;
        all.beyond_half += found.beyond_half;
        all.chords += found.chords;
        all.curved += found.curved;
        curved_kinds += found.curved > 0;
    }
    MESSAGE(all.chords, " chords; with half of the curvature ", all.curved, " of ", curved_kinds,
            " kinds would be off");
    CHECK(curved_kinds > 15);
    MESSAGE(all.points, " points of ", kinds, " kinds of primitives; half of the ranges would miss ", all.beyond_half);
    CHECK(kinds > 25);
    CHECK(all.beyond_half > all.points / 100);
}

namespace {

/// A primitive behind an affine map.
template <class P>
struct Mapped {
    P primitive;
    AffineMap map;

    template <class T>
    T distance(const Vec3<T>& p) const {
        return primitive.distance(map(p));
    }
};

}  // namespace

TEST_CASE("a box's own point is made ready as any affine point is") {
    Random rng(7);
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 centre(rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-2, 2));
        const Enclosure::Vector half{rng.uniform(0.01f, 1), rng.uniform(0.01f, 1), rng.uniform(0.01f, 1)};
        const auto axis = [&](int k) { return Enclosure::coordinate(k, centre[k], half[static_cast<std::size_t>(k)]); };
        const AffinePoint own = AffinePoint::of_box(centre, half);
        const std::optional<AffinePoint> any = AffinePoint::of({axis(0), axis(1), axis(2)}, half);
        REQUIRE(any);
        const auto is_same = [](const Dual& a, const Dual& b) {
            return a.value() == b.value() && a.gradient() == b.gradient();
        };
        CHECK(is_same(own.at_centre.x, any->at_centre.x));
        CHECK(is_same(own.at_centre.y, any->at_centre.y));
        CHECK(is_same(own.at_centre.z, any->at_centre.z));
        CHECK(own.squared_stretch == any->squared_stretch);
        CHECK(own.largest_coordinate == any->largest_coordinate);
        CHECK(own.radius == any->radius);
    }
}

namespace {

/// The maximum curvature of the distance along straight lines through q, from differences of its gradient.
template <class Solid>
double largest_bend(const Solid& solid, const glm::dvec3& q) {
    const auto gradient = [&](const glm::dvec3& at) {
        const auto x = [&](int k) { return static_cast<float>(at[k]); };
        const Vec3<Dual> p{Dual(x(0), 1.f, 0.f, 0.f), Dual(x(1), 0.f, 1.f, 0.f), Dual(x(2), 0.f, 0.f, 1.f)};
        return glm::dvec3(solid.distance(p).gradient());
    };
    constexpr double h = 1.0 / 128;
    const glm::dvec3 n = gradient(q);
    const glm::dvec3 t = glm::normalize(glm::cross(n, std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 s = glm::cross(n, t);
    const auto across = [&](const glm::dvec3& u) { return (gradient(q + h * u) - gradient(q - h * u)) / (2 * h); };
    const glm::dvec3 along_t = across(t), along_s = across(s);
    // Second derivatives by which it bends most along u, if no seam is near; that it does is asked again.
    const double angle =
        0.5 * std::atan2(glm::dot(along_t, s) + glm::dot(along_s, t), glm::dot(along_t, t) - glm::dot(along_s, s));
    const glm::dvec3 u = std::cos(angle) * t + std::sin(angle) * s;
    return glm::dot(across(u), u);
}

}  // namespace

TEST_CASE("a rounded solid's distance bends as that to the ball which it says lies in its surface") {
    std::size_t kinds = 0;
    for (const NodeKind& kind : node_kinds()) {
        Random rng = random_for(41, kind);
        if (!kind.is_field) continue;
        CAPTURE(kind.name);
        // Of 1/(f + ρ), the bend at most: where ρ is of all points within reach, and of the point itself.
        double within_reach = 0, at_the_point = 0;
        std::size_t points = 0;
        const auto look_at = [&](const auto& n) {
            using N = std::remove_cvref_t<decltype(n)>;
            if constexpr (RoundedPrimitive<N>) {
                for (int j = 0; j < 400; ++j) {
                    const glm::dvec3 p(rng.uniform(0, 1.5f) * rng.direction());
                    const double reach = std::exp2(rng.uniform(-6, -1));
                    const glm::dvec3 q =
                        p + (j % 4 == 0 ? double{rng.uniform(0, 1)} : 1.0) * reach * glm::dvec3(rng.direction());
                    const glm::vec3 single(q);
                    const auto f = static_cast<double>(n.distance(Vec3<float>{single.x, single.y, single.z}));
                    const double to_centre = f + n.rolling_radius(p, reach);
                    if (!(to_centre > 0.125) || f > 0.25) continue;  // h is a sixteenth of that
                    ++points;
                    if (std::isinf(to_centre)) {
                        within_reach = std::max(within_reach, largest_bend(n, q) > 1e-4 ? 2.0 : 1.0);
                        at_the_point = 1;
                    } else {
                        const double bend = largest_bend(n, q);
                        within_reach = std::max(within_reach, bend * to_centre);
                        at_the_point = std::max(at_the_point, bend * (f + n.rolling_radius(q, 0)));
                    }
                }
            }
        };
        for (int i = 0; i < 100; ++i) std::visit(look_at, kind.field(rng, 1).node()->node);
        if (points == 0) continue;
        ++kinds;
        MESSAGE(kind.name, ": ", points, " points, ", within_reach, " within reach, ", at_the_point, " at the point");
        CHECK(points > 2000);
        // Differences over h bend less by (h/(f + ρ))²/2, and at seams.
        CHECK(within_reach < 1.001);
        CHECK(at_the_point > 0.999);
        CHECK(at_the_point < 1.001);
    }
    CHECK(kinds == 4);
}

TEST_CASE("what is known at a box's centre encloses rounded solids, behind affine maps, too") {
    std::size_t kinds = 0;
    for (const NodeKind& kind : node_kinds()) {
        Random rng = random_for(29, kind);
        if (!kind.is_field) continue;
        CAPTURE(kind.name);
        CellBuffer found;
        bool is_rounded = false;
        for (int i = 0; i < (long_tests() ? 2000 : 100); ++i) {
            AffineMap map;
            const float size = std::exp2(rng.uniform(-2, 0));
            for (int k = 0; k < 3; ++k) {
                const glm::vec3 row = size * (i % 2 == 0 ? rng.direction() : glm::vec3(k == 0, k == 1, k == 2));
                map.row[k] = row;
                map.before[k] = rng.uniform(-0.5f, 0.5f);
            }
            const Field f = kind.field(rng, 1);
            std::visit(
                [&](const auto& n) {
                    using N = std::remove_cvref_t<decltype(n)>;
                    if constexpr (RoundedPrimitive<N>) {
                        is_rounded = true;
                        const Mapped<N> mapped{n, map};
                        look(mapped, rng, 40, found, [&](const Vec3<Enclosure>& p, const Enclosure::Vector& half) {
                            const auto at = AffinePoint::of(map(p), half);
                            Enclosure e;
                            return at && enclose_convex(n, *at, e) ? std::optional(e) : std::nullopt;
                        });
                    }
                },
                f.node()->node);
        }
        if (!is_rounded) continue;
        ++kinds;
        CHECK(found.outside == 0);
        CHECK(found.off_slope == 0);
        CHECK(found.steep == 0);
        CHECK(found.off_chord == 0);
        CHECK(found.points > 5000);
        CHECK(found.chords > 5000);
        MESSAGE(kind.name, ": ", found.points, " points, ", found.chords, " chords; half of the ranges would miss ",
                found.beyond_half, ", half of the curvature ", found.curved);
    }
    CHECK(kinds == 4);
}

namespace {

/// Evaluates a tree with enclosures, as cells evaluate its program.
struct EnclosingWalk {
    using Scalar = Enclosure;
    using Point = Vec3<Enclosure>;

    Enclosure::Vector half;
    bool folds = false;  ///< space is folded, which may jump: then there are no enclosures

    Scalar field(const Field& f, const Point& p) {
        return std::visit(
            [&](const auto& n) {
                using N = std::remove_cvref_t<decltype(n)>;
                if constexpr (Primitive<N> || DataPrimitive<N>)
                    return primitive(n, p);
                else
                    return n.evaluate(*this, p);
            },
            f.node()->node);
    }
    Phases<Scalar> phases(const Phased& a, const Point& p) {
        return std::visit([&](const auto& n) { return n.evaluate(*this, p); }, a.node()->node);
    }
    template <class P>
    Scalar primitive(const P& n, const Point& p) {
        if constexpr (LongPrimitive<P>) {
            folds = true;  // only its slope is used, which is almost useless here
            return Enclosure(0.f);
        } else if constexpr (ConvexPrimitive<P>) {
            return known_to_be_convex(n.distance(p), p).tightened(half);
        } else {
            return n.distance(p).tightened(half);
        }
    }
    Scalar one_lipschitz(const Scalar& value, const Point&) const { return value; }
    template <class M>
    Point map(const M& m, const Point& p, float) {
        folds = folds || std::is_same_v<M, FoldMap>;
        Point q = m(p);
        for (Enclosure* e : {&q.x, &q.y, &q.z}) *e = e->tightened(half);
        return q;
    }
};

}  // namespace

TEST_CASE("an enclosure of a tree holds its values and how they bend") {
    // Of a tree's values, whose numbers are up to 10 and pass through a dozen operations.
    constexpr double error = 2e-5;
    std::size_t looked = 0, bounded = 0, outside = 0, off_chord = 0, off_tangent = 0, seen = 0, kinds = 0;
    for (const NodeKind& kind : node_kinds()) {
        Random rng = random_for(29, kind);
        if (!kind.is_field) continue;
        CAPTURE(kind.name);
        const std::size_t before = bounded;
        for (int tree = 0; tree < (long_tests() ? 400 : 12); ++tree) {
            const Field f = kind.field(rng, 1 + tree % 3);
            const Walk<float> exactly;
            const auto at = [&](const glm::vec3& q) {
                return static_cast<double>(exactly.field(f, Vec3<float>{q.x, q.y, q.z}));
            };
            for (int box = 0; box < 60; ++box) {
                const glm::vec3 centre = rng.uniform(0, 1.5f) * rng.direction();
                const glm::vec3 half = std::exp2(rng.uniform(-6, 0)) *
                                       glm::vec3(rng.uniform(0.2f, 1), rng.uniform(0.2f, 1), rng.uniform(0.2f, 1));
                EnclosingWalk walk{{half.x, half.y, half.z}};
                const auto on = [&](int i) {
                    return Enclosure::coordinate(i, static_cast<double>(centre[i]), static_cast<double>(half[i]));
                };
                const Enclosure e = walk.field(f, {on(0), on(1), on(2)});
                if (walk.folds) break;
                ++looked;
                const bool is_bounded = e.curvature.high < 1e30 || e.curvature.low > -1e30;
                bounded += is_bounded;
                for (int k = 0; k < 8; ++k) {
                    const glm::vec3 a = half * rng.in({glm::vec3(-1), glm::vec3(1)}),
                                    b = half * rng.in({glm::vec3(-1), glm::vec3(1)});
                    const double va = at(centre + a), vb = at(centre + b), vm = at(centre + 0.5f * (a + b));
                    outside += va > e.value.high + error || va < e.value.low - error;
                    if (!is_bounded) continue;
                    const auto squared = [](const glm::vec3& v) { return glm::dot(glm::dvec3(v), glm::dvec3(v)); };
                    const double sag = 0.5 * (va + vb) - vm, span = squared(b - a) / 8;
                    off_chord += sag > e.curvature.high * span + error || sag < e.curvature.low * span - error;
                    const auto& g = e.centre_gradient;
                    if (std::isnan(g[0]) || std::isnan(g[1]) || std::isnan(g[2])) continue;
                    const glm::dvec3 d(a);
                    const double rise = va - e.centre - (g[0] * d.x + g[1] * d.y + g[2] * d.z);
                    off_tangent += rise > 0.5 * e.curvature.high * squared(a) + error ||
                                   rise < 0.5 * e.curvature.low * squared(a) - error;
                    seen += std::abs(rise) > 0.25 * std::min(e.curvature.magnitude(), 1e3) * squared(a) + error;
                }
            }
        }
        CHECK(outside == 0);
        CHECK(off_chord == 0);
        CHECK(off_tangent == 0);
        kinds += bounded > before;
    }
    MESSAGE(looked, " boxes, ", bounded, " with a bounded curvature, of ", kinds, " kinds; half of it would miss ",
            seen);
    CHECK(kinds > 40);
    CHECK(seen > 1000);
}

TEST_CASE("choices and operators of enclosures hold both branches") {
    const auto number = [](double low, double high, double slope_low, double slope_high) {
        return Enclosure(0.5 * (low + high), {low, high}, {Interval{slope_low, slope_high}, Interval{}, Interval{}}, {},
                         {});
    };
    const Enclosure a = number(-1, 2, -1, 1), b = number(0, 1, 0, 0.5), far = number(5, 6, 1, 1);
    const Enclosure least = min(a, b), most = max(a, b);
    CHECK(least.value.low == -1);
    CHECK(least.value.high == 1);
    CHECK(most.value.low == 0);
    CHECK(most.value.high == 2);
    CHECK(most.gradient[0].low == -1);
    CHECK(most.gradient[0].high == 1);
    CHECK(min(a, far).gradient[0].high == 1);
    CHECK(max(a, far).gradient[0].low == 1);  // decided: only one branch counts
    CHECK(abs(a).value.low == 0);
    CHECK(abs(a).value.high == 2);
    CHECK((a * a).value.low == 0);  // a square, not a product
    CHECK((a * b).value.low == -1);
    CHECK((b / a).value.low == -Interval::most);  // by a number that may be zero
    CHECK(sqrt(b).gradient[0].high > 1e99);
    CHECK(floor(a).value.low == -1);
    CHECK(floor(a).value.high == 2);
    CHECK((2.f - a).value.high == 3);
}

TEST_CASE("a difference is at least what is said of it, and just that where it bends down evenly") {
    // f = c + g·q + k/2·|q|², q from the centre: of the difference of two the least is found axis by axis.
    struct Quadratic {
        double c, k;
        std::array<double, 3> g;
        Enclosure enclosed(const Enclosure::Vector& half) const {
            std::array<Interval, 3> slopes;
            double reach = 0;
            for (std::size_t i = 0; i < 3; ++i) {
                slopes[i] = {g[i] - std::abs(k) * half[i], g[i] + std::abs(k) * half[i]};
                reach += slopes[i].magnitude() * half[i];
            }
            return {c, {c - reach, c + reach}, slopes, g, {k, k}};
        }
    };
    Random rng(39);
    const auto number = [&] { return static_cast<double>(rng.uniform(-1, 1)); };
    std::size_t exact = 0;
    for (int n = 0; n < 10'000; ++n) {
        const Quadratic a{number(), number(), {number(), number(), number()}};
        const Quadratic b{number(), number(), {number(), number(), number()}};
        const Enclosure::Vector half{0.5 + 0.4 * number(), 0.5 + 0.4 * number(), 0.5 + 0.4 * number()};
        double least = a.c - b.c;
        const double k = a.k - b.k;
        for (std::size_t i = 0; i < 3; ++i) {
            const double g = a.g[i] - b.g[i], at_ends = 0.5 * k * half[i] * half[i] - std::abs(g) * half[i];
            least += k > 0 && std::abs(g) < k * half[i] ? -0.5 * g * g / k : at_ends;
        }
        Enclosure of_a = a.enclosed(half), of_b = b.enclosed(half);
        const double bound = least_difference(of_a, of_b, half);
        CHECK(bound <= least + 1e-12);
        if (k < 0) {
            CHECK(bound == doctest::Approx(least).epsilon(1e-12));
            ++exact;
        }
        // By the gradients' ranges alone, where it may bend down endlessly or the centre is on a seam.
        (n % 2 == 0 ? of_a : of_b).set_curvature(Interval::all());
        const double by_gradient = least_difference(of_a, of_b, half);
        CHECK(by_gradient <= least + 1e-12);
        CHECK(by_gradient > least - 100);
        of_a.centre_gradient = enclosure::detail::no_gradient;
        CHECK(least_difference(of_a, of_b, half) == by_gradient);
    }
    CHECK(exact > 4'000);
}

}  // namespace test_enclosure
