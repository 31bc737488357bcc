// Compares fields and objects made of lists of balls with evaluating the balls one by one, and tests invalid lists.
#include "phasetree/nodes/fields/balls.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <glm/geometric.hpp>

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/phased/particles.hpp"
#include "support/random_tree.hpp"
#include "support/set_algebra.hpp"

namespace test_balls {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

/// Many balls in a cube, of which some are equal, overlap or hold others.
BallList random_balls(Random& rng, int count) {
    BallList list;
    const float usual = 0.6f / std::cbrt(static_cast<float>(count));
    for (int i = 0; i < count; ++i) {
        const glm::vec3 c(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
        list.centres.push_back(rng.chance(0.1) ? glm::round(4.f * c) / 4.f : c);
        list.radii.push_back(rng.chance(0.02) ? 0.5f : rng.uniform(0.2f, 1.2f) * usual);
        list.phases.push_back(static_cast<std::uint8_t>(rng.below(4)));
    }
    return list;
}
FromFile<BallList> held(BallList list) {
    return {"balls", std::make_shared<const BallList>(std::move(list))};
}
Balls node_of(BallList list) {
    Balls node{.file = held(std::move(list))};
    node.prepare();
    return node;
}
glm::vec3 point_about(Random& rng) {
    return (rng.chance(0.1) ? 50.f : 1.2f) * glm::vec3(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
}
template <class Node>
std::string said_of(Node node) {
    try {
        node.prepare();
    } catch (const ModelError& e) {
        return e.what();
    }
    return "balls";
}

}  // namespace

TEST_CASE("the search finds the distance that a loop over all balls would, to the last bit") {
    Random rng(391);
    for (int n = 0; n < 30; ++n) {
        const Balls node = node_of(random_balls(rng, 1 + rng.below(n % 3 == 0 ? 20 : 3000)));
        for (int k = 0; k < 500; ++k) {
            const glm::vec3 p = point_about(rng);
            const Vec3<float> at{p.x, p.y, p.z};
            const float searched = Balls::distance(node.table.data(), at);
            const float looped = balls::ShortList::distance(node.table.data(), at);
            REQUIRE(std::memcmp(&searched, &looped, sizeof searched) == 0);
        }
    }
}

TEST_CASE("the distance is the same to the last bit in whatever order the balls are given") {
    Random rng(392);
    BallList list = random_balls(rng, 70'000), other = list;  // more than one task processes
    std::ranges::reverse(other.centres);
    std::ranges::reverse(other.radii);
    CHECK(node_of(list).table == node_of(other).table);
}

TEST_CASE("in a box few balls are enough: all values to the last bit, or those up to a number") {
    Random rng(393);
    std::size_t boxes = 0, refused = 0, points = 0, beyond = 0, all_balls = 0, required_balls = 0;
    for (int n = 0; n < (long_tests() ? 200 : 20); ++n) {
        const Balls node = node_of(random_balls(rng, 2000));
        for (int b = 0; b < 50; ++b) {
            PointRange box;
            for (std::size_t i = 0; i < 3; ++i) {
                box.centre[i] = static_cast<double>(rng.uniform(-1.1f, 1.1f));
                box.half_extents[i] = static_cast<double>(std::exp2(rng.uniform(-8, -3)));
            }
            const float farthest = rng.chance(0.5) ? 0.f : rng.uniform(-0.02f, 0.05f);
            std::vector<float> exact, required, part;
            ++boxes;
            if (!Balls::specialise(node.table.data(), box, {}, exact) ||
                !Balls::specialise(node.table.data(), box, static_cast<double>(farthest), {}, required)) {
                ++refused;
                continue;
            }
            PointRange half = box;
            for (double& r : half.half_extents) r /= 2;
            REQUIRE(Balls::specialise(node.table.data(), half, static_cast<double>(farthest), required, part));
            for (const auto* list : {&exact, &required, &part}) REQUIRE(Balls::Specialised::is_sound(*list));
            all_balls += balls::ShortList::count(exact.data());
            required_balls += balls::ShortList::count(required.data());
            for (int k = 0; k < 20; ++k) {
                const auto point_in = [&](const PointRange& in) {
                    Vec3<float> p;
                    float* axes[] = {&p.x, &p.y, &p.z};
                    for (std::size_t i = 0; i < 3; ++i) {
                        const float u = rng.chance(0.5) ? (rng.chance(0.5) ? 1.f : -1.f) : rng.uniform(-1, 1);
                        *axes[i] = static_cast<float>(in.centre[i] + static_cast<double>(u) * in.half_extents[i]);
                    }
                    return p;
                };
                const auto is_right = [&](const std::vector<float>& list, const Vec3<float>& p) {
                    const float whole = Balls::distance(node.table.data(), p);
                    const float few = Balls::Specialised::distance(list.data(), p);
                    return whole > farthest ? few > farthest : std::memcmp(&whole, &few, sizeof whole) == 0;
                };
                const Vec3<float> p = point_in(box);
                const float whole = Balls::distance(node.table.data(), p);
                REQUIRE(whole == Balls::Specialised::distance(exact.data(), p));
                REQUIRE(is_right(required, p));
                REQUIRE(is_right(part, point_in(half)));
                ++points;
                PointRange large = box;
                for (double& r : large.half_extents) r *= 8;
                beyond += !is_right(required, point_in(large));
            }
        }
    }
    MESSAGE(boxes, " boxes, ", refused, " refused; ", all_balls, " balls, of which ", required_balls,
            " are required; in boxes eight times as large ", beyond, " of ", points, " points would be wrong");
    CHECK(refused < boxes / 2);
    CHECK(beyond > points / 100);
    CHECK(required_balls < all_balls);
}

TEST_CASE("objects of listed balls have the phases that set algebra says, and one negative component at most") {
    Random rng(394);
    int met = 0;
    for (int n = 0; n < 20; ++n) {
        Particles node{.of_phases = {Phase{2}, Phase{1}, Phase{4}, Phase{3}}, .file = held(random_balls(rng, 300))};
        const Phased object = node;
        for (int k = 0; k < 300; ++k) {
            const glm::vec3 p = point_about(rng), q = p + rng.uniform(0, 0.2f) * rng.direction();
            const Components expected = tests::values(object, glm::dvec3(p));
            const Phases<float> found = distances(object, p), other = distances(object, q);
            int negative = 0;
            for_each_phase(found.present, [&](int i) {
                const double rounding = 1e-6 * (1 + static_cast<double>(glm::length(p)));
                REQUIRE(std::abs(static_cast<double>(found[i]) - expected[static_cast<std::size_t>(i)]) < rounding);
                REQUIRE(std::abs(found[i] - other[i]) <= glm::length(p - q) + 2 * static_cast<float>(rounding));
                negative += found[i] < 0;
            });
            REQUIRE(negative <= 1);
            met += tests::label(object, glm::dvec3(p)) != vacuum;
        }
    }
    CHECK(met > 500);
}

TEST_CASE("what are no balls is rejected, with the place") {
    const std::vector<glm::vec3> two{{0, 0, 0}, {1, 0, 0}};
    CHECK(said_of(Balls{.centres = two, .radii = {1}}) == "balls");
    CHECK(said_of(Balls{}) == "balls: either \"centres\" or \"file\" is required");
    CHECK(said_of(Balls{.centres = two, .radii = {1}, .file = held({two, {1, 1}, {}})}) ==
          "balls: either \"centres\" or \"file\" is required");
    CHECK(said_of(Balls{.centres = two}) == "balls: \"radii\" is missing");
    CHECK(said_of(Balls{.centres = two, .radii = {1, 2, 3}}) ==
          "balls: \"radii\" needs one entry per ball, or one for all");
    CHECK(said_of(Balls{.radii = {1}, .file = held({})}) == "balls: there are no balls");
    CHECK(said_of(Balls{.file = held({two, {1, -1}, {}})}) == "balls: the radius of ball 2 of balls is not positive");
    CHECK(said_of(Balls{.file = held({two, {1, std::numeric_limits<float>::quiet_NaN()}, {}})}) ==
          "balls: the radius of ball 2 of balls is not positive");
    CHECK(said_of(Balls{.file = held({{{0, 0, 2e9f}}, {1}, {}})}) ==
          "balls: ball 1 of balls is smaller than 1e-9 m, or farther or larger than 1e9 m");
    CHECK(said_of(Particles{.of_phases = {Phase{1}, Phase{2}, Phase{3}}, .centres = two, .radii = {1}}) ==
          "particles: \"phases\" needs one entry per centre, or one for all");
    CHECK(said_of(Particles{.of_phases = {Phase{1}, Phase{2}}, .file = held({two, {1, 1}, {0, 2}})}) ==
          "particles: ball 2 of balls has phase 2, counted from 0, but \"phases\" has only 2");
    CHECK(said_of(Particles{.of_phases = {Phase{1}, Phase{2}}, .file = held({two, {1, 1}, {}})}) ==
          "particles: balls has no column \"phase\", so \"phases\" must have a single entry");
}

TEST_CASE("what balls and particles derive is counted, of a list in the scene and of one in a file") {
    Random rng(398);
    const BallList list = random_balls(rng, 1000);
    const std::size_t own = 16 * list.centres.size();
    const Field given = Balls{.centres = list.centres, .radii = list.radii}, taken = Balls{.file = held(list)};
    CHECK(statistics(given).bytes > 2 * own);
    CHECK(statistics(taken).bytes > own + list.bytes());
    const Phased particles = Particles{.of_phases = {Phase{1}, Phase{2}, Phase{3}, Phase{4}}, .file = held(list)};
    CHECK(statistics(particles).bytes > own + list.bytes());
}

}  // namespace test_balls
