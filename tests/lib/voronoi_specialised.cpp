// In a small box, a few sites determine a Voronoi pattern, to the last bit.
#include <doctest/doctest.h>

#include <cstring>

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/voronoi_cells.hpp"
#include "phasetree/nodes/phased/voronoi.hpp"
#include "support/random_tree.hpp"

namespace test_voronoi_specialised {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

struct Found {
    std::size_t boxes = 0, refused = 0, points = 0, different = 0, sites = 0, beyond = 0;
};

/// In a box, on its faces and in its corners.
glm::vec3 within(Random& rng, const PointRange& box, double larger) {
    glm::vec3 p;
    for (int i = 0; i < 3; ++i) {
        const double u = rng.chance(0.5) ? (rng.chance(0.5) ? 1 : -1) : rng.uniform(-1, 1);
        const auto k = static_cast<std::size_t>(i);
        p[i] = static_cast<float>(box.centre[k] + u * larger * box.half_extents[k]);
    }
    return p;
}

template <class P>
void look(const P& primitive, float size, float far, Random& rng, Found& found) {
    const auto is_same = [](float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0; };
    PointRange box;
    for (std::size_t i = 0; i < 3; ++i) {
        box.centre[i] = static_cast<double>(far * size * rng.uniform(-1, 1));
        box.half_extents[i] = static_cast<double>(size * std::exp2(rng.uniform(-8, -2)));
    }
    // Some centres are where cubes meet.
    if (rng.chance(0.2))
        for (double& c : box.centre) c = std::round(c / static_cast<double>(size)) * static_cast<double>(size);
    std::vector<float> around, near;
    ++found.boxes;
    if (!primitive.specialise(box, {}, around)) {
        ++found.refused;
        return;
    }
    // The same for a part of the box, from all sites and from those of the box.
    PointRange part = box;
    for (std::size_t i = 0; i < 3; ++i) {
        part.half_extents[i] *= static_cast<double>(rng.uniform(0.1f, 0.9f));
        part.centre[i] += (box.half_extents[i] - part.half_extents[i]) * static_cast<double>(rng.uniform(-1, 1));
    }
    REQUIRE(primitive.specialise(part, around, near));
    found.sites += P::Specialised::sites(near.data());
    for (int k = 0; k < 24; ++k) {
        const glm::vec3 p = within(rng, box, 1), q = within(rng, part, 1), r = within(rng, box, 4);
        const auto at = [](const glm::vec3& v) { return Vec3<float>{v.x, v.y, v.z}; };
        ++found.points;
        found.different += !is_same(primitive.distance(at(p)), P::Specialised::distance(around.data(), at(p)));
        found.different += !is_same(primitive.distance(at(q)), P::Specialised::distance(near.data(), at(q)));
        found.beyond += !is_same(primitive.distance(at(r)), P::Specialised::distance(around.data(), at(r)));
    }
}

}  // namespace

TEST_CASE("in a small box a Voronoi pattern is that of few sites, to the last bit") {
    Random rng(217);
    Found cells, kinds;
    for (int n = 0; n < (long_tests() ? 200000 : 4000); ++n) {
        const float size = std::exp2(rng.uniform(-3, 3)), far = std::exp2(rng.uniform(0, 12));
        const float jitter = rng.chance(0.2) ? (rng.chance(0.5) ? 0.f : 1.f) : rng.uniform(0, 1);
        const auto seed = static_cast<float>(rng.below(289));
        VoronoiCells blocks{.size = size,
                            .gap = 0.05f * size,
                            .rounding = rng.chance(0.5) ? 0.f : rng.uniform(0.01f, 0.3f) * size,
                            .jitter = jitter,
                            .seed = seed};
        blocks.prepare();
        look(blocks, size, far, rng, cells);
        const int count = 1 + rng.below(16);
        const Voronoi::Nearest kind{size, jitter, seed, static_cast<float>(count),
                                    static_cast<float>(rng.below(count))};
        look(kind, size, far, rng, kinds);
    }
    for (const Found& f : {cells, kinds}) {
        MESSAGE(f.boxes, " boxes, ", f.refused, " too large; ",
                static_cast<double>(f.sites) / static_cast<double>(f.boxes - f.refused), " sites; ", f.points,
                " points; in boxes four times as large ", f.beyond, " would be different");
        CHECK(f.different == 0);
        CHECK(f.refused < f.boxes / 4);
        CHECK(f.beyond > f.points / 50);
    }
}

}  // namespace test_voronoi_specialised
