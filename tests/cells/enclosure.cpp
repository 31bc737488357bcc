// Enclosures against what they enclose: values and gradients of every primitive at random points of random boxes.
#include "phasetree/math/enclosure.hpp"

#include <doctest/doctest.h>

#include "phasetree/math/dual.hpp"
#include "phasetree/phasetree.hpp"
#include "support/random_tree.hpp"

using namespace phasetree;
using namespace phasetree::tests;

namespace {

struct Found {
    std::size_t points = 0, outside = 0, off_slope = 0, steep = 0;
    std::size_t beyond_half = 0;  ///< points that half of the range would not have held
};

/// Values and gradients are computed in floats; tests/lib holds them to these.
constexpr double value_error = 1e-5, gradient_error = 1e-4;

template <class Primitive>
void look(const Primitive& n, Random& rng, int boxes, Found& found) {
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
        const Enclosure e = n.distance(p).tightened(extent);
        CHECK(std::abs(e.centre - static_cast<double>(n.distance(Vec3<float>{centre.x, centre.y, centre.z}))) <
              value_error);
        for (int k = 0; k < 16; ++k) {
            const glm::vec3 d = half * glm::vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
            const glm::vec3 q = centre + d;
            const Dual g = n.distance(Vec3<Dual>{Dual(q.x, 1, 0, 0), Dual(q.y, 0, 1, 0), Dual(q.z, 0, 0, 1)});
            const auto v = static_cast<double>(g.value);
            ++found.points;
            found.outside += !(v >= e.value.low - value_error && v <= e.value.high + value_error);
            Range change{0, 0};
            const float slope[] = {g.dx, g.dy, g.dz};
            for (std::size_t i = 0; i < 3; ++i) {
                change = change + e.gradient[i] * static_cast<double>(d[static_cast<int>(i)]);
                const auto s = static_cast<double>(slope[i]);
                found.steep += !(s >= e.gradient[i].low - gradient_error && s <= e.gradient[i].high + gradient_error);
            }
            const double actual = v - e.centre;
            found.off_slope += !(actual >= change.low - value_error && actual <= change.high + value_error);
            found.beyond_half += std::abs(actual - change.middle()) > 0.25 * (change.high - change.low) + value_error;
        }
    }
}

}  // namespace

TEST_CASE("an enclosure holds the values and the gradients of every primitive") {
    Random rng(23);
    std::size_t kinds = 0;
    Found all;
    for (const NodeKind& kind : node_kinds()) {
        if (!kind.is_field) continue;
        CAPTURE(kind.name);
        Found found;
        for (int i = 0; i < (long_tests() ? 500 : 20); ++i) {
            const Field f = kind.field(rng, 1);
            std::visit(
                [&](const auto& n) {
                    using N = std::remove_cvref_t<decltype(n)>;
                    if constexpr (Primitive<N> && !LongPrimitive<N>) look(n, rng, 40, found);
                },
                f.node()->node);
        }
        CHECK(found.outside == 0);
        CHECK(found.off_slope == 0);
        CHECK(found.steep == 0);
        kinds += found.points > 0;
        all.points += found.points;
        all.beyond_half += found.beyond_half;
    }
    MESSAGE(all.points, " points of ", kinds, " kinds of primitives; half of the ranges would miss ", all.beyond_half);
    CHECK(kinds > 25);
    CHECK(all.beyond_half > all.points / 100);
}

TEST_CASE("choices and operators of enclosures hold both branches") {
    const auto number = [](double low, double high, double slope_low, double slope_high) {
        return Enclosure(0.5 * (low + high), {low, high}, {Range{slope_low, slope_high}, Range{}, Range{}});
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
    CHECK((b / a).value.low == -Range::most);  // by a number that may be zero
    CHECK(sqrt(b).gradient[0].high > 1e99);
    CHECK(floor(a).value.low == -1);
    CHECK(floor(a).value.high == 2);
    CHECK((2.f - a).value.high == 3);
}
