// At the edges of convex solids a cell's field has no bound of its curvature. With certificates rays near them must
// take few batches and miss nothing. Here solids nearly touch, and a certificate that proves too much would pass
// between them; all other solids are for tests/embree/crossings.cpp.

#include <doctest/doctest.h>

#include "phasetree/cells/cells.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/capped_cone.hpp"
#include "phasetree/nodes/fields/cylinder.hpp"
#include "phasetree/nodes/fields/difference.hpp"
#include "phasetree/nodes/fields/intersection.hpp"
#include "phasetree/nodes/fields/offset.hpp"
#include "phasetree/nodes/fields/plane.hpp"
#include "phasetree/nodes/fields/shell.hpp"
#include "phasetree/nodes/fields/smooth_union.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/profiles/circle.hpp"
#include "phasetree/nodes/profiles/extrude.hpp"
#include "phasetree/nodes/profiles/rectangle.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/scale.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/twist.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/compared_crossings.hpp"
#include "support/random_tree.hpp"

namespace test_sign_certificates {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

Phased solid(Field of) {
    return Set{.phase = Phase{1}, .of = std::move(of)};
}

/// Plates, bars and cones, some of them cut or bitten out of others, a hair or a hand apart.
Field edges(Random& rng) {
    const auto part = [&]() -> Field {
        const float size = rng.uniform(0.2f, 0.7f);
        Field shape = Box{.size = {size, rng.uniform(0.05f, 0.4f), rng.uniform(0.05f, 0.4f)}};
        if (rng.chance(0.3)) shape = Cylinder{.radius = 0.5f * size, .height = rng.uniform(0.02f, 0.4f)};
        if (rng.chance(0.2)) shape = CappedCone{.radius_bottom = 0.4f * size, .radius_top = 0, .height = size};
        if (rng.chance(0.2)) shape = Offset{.of = shape, .amount = rng.uniform(0, 0.05f)};
        if (rng.chance(0.3))  // dented by a ball: edges beside what curves inward
            shape = Intersection{
                .of = {shape, Difference{.from = Box{.size = glm::vec3(3)},
                                         .subtract = {warped(Translate{0.2f * rng.direction()},
                                                             Sphere{.radius = rng.uniform(0.03f, 0.2f)})}}}};
        if (rng.chance(0.1)) shape = Shell{.of = shape, .half_thickness = rng.uniform(0.002f, 0.02f)};
        shape = warped(Rotate{.axis = rng.direction(), .angle = rng.uniform(0, 90)}, shape);
        return warped(Translate{0.4f * rng.direction()}, shape);
    };
    Field all = part();
    for (int i = 0; i < 4; ++i) {
        const float which = rng.uniform(0, 1);
        if (which < 0.4f)
            all = Union{.of = {all, part()}};
        else if (which < 0.6f)
            all = Difference{.from = all, .subtract = {part()}};
        else if (which < 0.7f)
            all = Union{.of = {all, Intersection{.of = {part(), part()}}}};
        else if (which < 0.85f)
            all = SmoothUnion{.of = {all, part()}, .radius = rng.uniform(0.01f, 0.1f)};
        else  // a gap of a hundredth to a ten-thousandth
            all = Union{.of = {all, warped(Translate{{0, 0, rng.uniform(1e-4f, 1e-2f)}},
                                           Difference{.from = part(), .subtract = {all}})}};
    }
    // Of seams as of edges.
    if (rng.chance(0.3)) all = Offset{.of = all, .amount = rng.uniform(-0.02f, 0.05f)};
    if (rng.chance(0.4)) all = Shell{.of = all, .half_thickness = rng.uniform(0.002f, 0.02f)};
    return all;
}

}  // namespace

TEST_CASE("rays along curved surfaces beside edges, and along rounded edges, meet what rays meet of the whole object") {
    Random rng(34);
    Compared all;
    for (int n = 0; n < (long_tests() ? 4000 : 40); ++n) {
        // Moved out by more and less than a cell is large: the corner's own distance counts, or that it is none.
        const float by = std::exp2(-rng.uniform(3, 10)), size = rng.uniform(0.1f, 0.6f);
        Field round = edges(rng);
        if (n % 2 == 0) {
            const Field profile = n % 8 < 4 ? Field(Rectangle{.width = size, .height = 0.5f * size})
                                            : Field(Union{{Circle{.radius = 0.5f * size},
                                                           Rectangle{.width = 1.2f * size, .height = 0.3f * size}}});
            round = Offset{.of = Extrude{.of = profile, .height = rng.uniform(0.05f, 0.3f)}, .amount = by};
        }
        if (n % 4 == 2) round = Shell{.of = round, .half_thickness = 0.5f * by};
        const Field ball = warped(Translate{0.3f * rng.direction()}, Sphere{.radius = rng.uniform(0.05f, 0.3f)});
        round = warped(Rotate{.axis = rng.direction(), .angle = rng.uniform(0, 90)}, round);
        Field both = Union{.of = {round, ball}};
        // Where space is stretched leaves are steeper than distances are.
        if (n % 4 == 1) both = warped(Twist{.rate = rng.uniform(90, 400)}, both);
        const std::size_t before = all.different;
        compare_crossings(solid(both), {}, 200, rng, all);
        CAPTURE(n);
        CHECK(all.different == before);
    }
    MESSAGE(all.rays, " rays, ", all.crossings, " crossings, ", all.different, " different");
    CHECK(all.crossings > all.rays);
}

TEST_CASE("a ray that grazes a ball beside its crease with a plate meets it") {
    Random rng(35);
    Evaluator::Workspace w;
    Compared all;
    for (int n = 0; n < (long_tests() ? 2000 : 25); ++n) {
        const float radius = rng.uniform(0.1f, 0.4f), height = rng.uniform(-0.3f, 0.3f) * radius;
        const glm::vec3 up = rng.direction();
        Field both = Union{{Sphere{.radius = radius}, warped(Translate{height * up}, Plane{.normal = up})}};
        // In finer space what is known of its values is known of their multiples.
        if (n % 4 < 2) {
            const Field large =
                Union{{Sphere{.radius = 4 * radius}, warped(Translate{4 * height * up}, Plane{.normal = up})}};
            both = warped(Scale{.factor = 0.25f}, large);
        }
        const Phased object = n % 2 == 0 ? solid(Intersection{{both, Box{.size = glm::vec3(1)}}})
                                         : solid(Difference{.from = Box{.size = glm::vec3(1)}, .subtract = {both}});
        const InterfaceCells cells(object);
        const CellsAlongRay boxes(cells);
        const InterfaceTracer tracer(object);
        const std::size_t before = all.different;
        for (int i = 0; i < 500; ++i) {
            // A point of the ball a little above the plate, and past it a ray a little deeper than that.
            const glm::vec3 side = glm::normalize(glm::cross(up, rng.direction()));
            const float angle = std::asin(height / radius) + std::exp2(-rng.uniform(2, 8));
            const glm::vec3 q = radius * (std::cos(angle) * side + std::sin(angle) * up);
            const glm::vec3 normal = glm::normalize(q), d = glm::normalize(glm::cross(normal, rng.direction()));
            const glm::vec3 o = q * (1 - std::exp2(-rng.uniform(6, 16))) - rng.uniform(0.2f, 0.8f) * radius * d;
            compare_ray(object, boxes, tracer, {}, {o, d}, w, all);
        }
        CAPTURE(n);
        CHECK(all.different == before);
    }
    MESSAGE(all.rays, " rays, ", all.crossings, " crossings, ", all.different, " different");
    CHECK(all.crossings > 2 * all.rays);
}

TEST_CASE("a ray that grazes a dome beside its cut meets it, where the bounds of curvature are nearly exact") {
    Random rng(36);
    Evaluator::Workspace w;
    Compared all;
    for (int n = 0; n < (long_tests() ? 2000 : 50); ++n) {
        const float radius = std::exp2(rng.uniform(-2.3f, 0.5f));
        const glm::vec3 up = rng.direction(), side = glm::normalize(glm::cross(up, rng.direction()));
        const Field ball = warped(Translate{-radius * up}, Sphere{.radius = radius});
        // Through the dome's top and on its other side. A plate leaves it the bound of the field itself; a wedge does
        // not: that takes a certificate.
        const auto plate = [&](float slant) { return Plane{.normal = glm::normalize(up + slant * side)}; };
        const glm::vec3 across = glm::cross(up, side);
        const auto flank = [&](float turn) {
            return Plane{.normal = glm::normalize(turn * across + side + 0.3f * rng.direction())};
        };
        const Field other =
            n % 4 < 2 ? Field(plate(std::exp2(-rng.uniform(1, 5)))) : Field(Intersection{{flank(1), flank(-1)}});
        const Field both = Union{{ball, other}};
        const Phased object = n % 2 == 0 ? solid(Intersection{{both, Box{.size = glm::vec3(1)}}})
                                         : solid(Difference{.from = Box{.size = glm::vec3(1)}, .subtract = {both}});
        // Large cells, too, in which a batch's places are far apart.
        const InterfaceCells cells(object, {.max_depth = n % 8 < 4 ? 2 : 14});
        const CellsAlongRay boxes(cells);
        const InterfaceTracer tracer(object);
        const std::size_t before = all.different;
        for (int i = 0; i < 500; ++i) {
            const glm::vec3 along = glm::normalize(glm::cross(up, rng.direction()));
            const glm::vec3 near = std::exp2(-rng.uniform(3, 10)) * (glm::dot(along, side) > 0 ? along : -along);
            const glm::vec3 normal = glm::normalize(near + radius * up), q = radius * (normal - up);
            const glm::vec3 d = glm::normalize(glm::cross(normal, rng.direction()));
            // Above the ray is about as much of it as fits between two places of a batch, but no less than a resolution
            // deep, for that is rounding's.
            const float chord = std::exp2(-rng.uniform(3, 8));
            const float depth = std::max(tracer.resolution(), chord * chord / (8 * radius));
            const glm::vec3 o = q - depth * normal - rng.uniform(0.2f, 0.4f) * d;
            compare_ray(object, boxes, tracer, {}, {o, d}, w, all);
        }
        CAPTURE(n);
        CHECK(all.different == before);
    }
    MESSAGE(all.rays, " rays, ", all.crossings, " crossings, ", all.different, " different");
    CHECK(all.crossings > 2 * all.rays);
}

TEST_CASE("near edges rays take few batches, and meet what rays meet of the whole object") {
    Random rng(31);
    std::size_t rays = 0, crossings = 0, different = 0;
    TraceCounters all;
    Evaluator::Workspace w;
    for (int n = 0; n < (long_tests() ? 4000 : 100); ++n) {
        const Phased object = solid(edges(rng));
        const InterfaceCells cells(object);
        const CellsAlongRay boxes(cells);
        const InterfaceTracer tracer(object);
        for (int i = 0; i < 200; ++i) {
            const glm::vec3 p = rng.in(cells.bounds());
            const glm::vec3 d = glm::normalize(rng.in(cells.bounds()) - p);
            const Phase phase = tracer.label(p, w);
            const auto expected = tracer.first_crossing(p, d, 0, 1e6f, phase, w);
            std::optional<Crossing> nearest;
            for (std::size_t c = 0; c < cells.size(); ++c) {
                const auto hit = cells.first_crossing(c, p, d, 0, nearest ? nearest->t_from : 1e6f, phase, w, all);
                if (hit && (!nearest || hit->t_from < nearest->t_from)) nearest = hit;
            }
            ++rays;
            crossings += expected.has_value();
            // One of them may have passed a hair that the other one saw.
            Compared by_hairs;
            if (expected.has_value() != nearest.has_value() ||
                (expected && std::abs(expected->t_from - nearest->t_from) > 4 * tracer.resolution()))
                compare_ray(object, boxes, tracer, {}, {p, d}, w, by_hairs);
            different += by_hairs.different;
        }
    }
    const double batches = static_cast<double>(all.batches) / static_cast<double>(rays);
    MESSAGE(rays, " rays, ", crossings, " crossings, ", different, " different; ", batches, " batches a ray");
    CHECK(crossings > rays / 3);
    CHECK(different == 0);
    // Without certificates it were 3.98, with them 3.35: the same rays, the same counts on every machine.
    CHECK(batches < (long_tests() ? 3.5 : 3.6));
}

}  // namespace test_sign_certificates
