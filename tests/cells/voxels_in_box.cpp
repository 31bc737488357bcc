// Compares bounds of voxel grids in a box with their values there, and tests rays through their cells.
#include "bounding/voxels_in_box.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/shell.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/volume.hpp"
#include "phasetree/nodes/phased/labels.hpp"
#include "phasetree/nodes/phased/layered.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "support/compared_crossings.hpp"
#include "support/random_voxels.hpp"

namespace test_voxels_in_box {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

struct Found {
    std::size_t boxes = 0, known = 0, curved = 0, outside = 0, steep = 0, bent = 0, beyond = 0;
};

void look(const VoxelGrid& grid, bool is_spline, Random& rng, Found& found) {
    const VoxelLattice& l = grid.lattice;
    PointRange box;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto a = static_cast<glm::length_t>(i);
        const double u = static_cast<double>(rng.uniform(-1, static_cast<float>(l.size[i])));
        box.centre[i] = static_cast<double>(static_cast<float>(l.first[a] + u * l.spacing[a]));
        box.half_extents[i] = l.spacing[a] * static_cast<double>(std::exp2(rng.uniform(-5, 2)));
    }
    const float* data = grid.table.data();
    const bounding::VoxelsInBox known = bounding::voxels_in_box(data, box, is_spline);
    ++found.boxes;
    const auto value = [&](const glm::dvec3& p) {
        const Vec3<float> q{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
        return static_cast<double>(is_spline ? voxels::spline_at(data, q) : voxels::linear_at(data, q));
    };
    const auto place = [&](double larger) {
        glm::dvec3 p;
        for (std::size_t i = 0; i < 3; ++i) {
            const double u = rng.chance(0.4) ? (rng.chance(0.5) ? 1 : -1) : static_cast<double>(rng.uniform(-1, 1));
            p[static_cast<int>(i)] = box.centre[i] + u * larger * box.half_extents[i];
        }
        return p;
    };
    const double rounding = 2e-6;
    for (int k = 0; k < 20; ++k) {
        const double v = value(place(1));
        found.outside += v < known.values.low - rounding || v > known.values.high + rounding;
        const double far = value(place(20));
        found.beyond += far < known.values.low - rounding || far > known.values.high + rounding;
    }
    if (!known.field) return;
    ++found.known;
    const auto& field = *known.field;
    const bool has_curvature = field.curvature.high < enclosure::Interval::most;
    found.curved += has_curvature;
    for (int k = 0; k < 20; ++k) {
        const glm::dvec3 a = place(1), b = place(1);
        double low = 0, high = 0;
        for (int i = 0; i < 3; ++i) {
            const auto& g = field.gradients[static_cast<std::size_t>(i)];
            const double d = b[i] - a[i];
            low += std::min(g.low * d, g.high * d);
            high += std::max(g.low * d, g.high * d);
        }
        const double at_a = value(a), at_b = value(b);
        found.steep += at_b - at_a < low - rounding || at_b - at_a > high + rounding;
        if (!has_curvature) continue;
        const double apart = glm::dot(b - a, b - a) / 8;
        const double sag = value(0.5 * (a + b)) - 0.5 * (at_a + at_b);
        found.bent += sag < -field.curvature.high * apart - rounding || sag > -field.curvature.low * apart + rounding;
    }
}

}  // namespace

TEST_CASE("in a box the values, slopes and curvatures of voxels' interpolations are within their bounds") {
    Random rng(621);
    for (const bool is_spline : {false, true}) {
        CAPTURE(is_spline);
        Found found;
        for (int n = 0; n < (long_tests() ? 2000 : 200); ++n) {
            const VoxelGrid grid = random_level_set(rng);
            for (int box = 0; box < 40; ++box) look(grid, is_spline, rng, found);
        }
        MESSAGE(found.boxes, " boxes, ", found.known, " with bounds of gradients, ", found.curved, " of curvatures");
        CHECK(found.outside == 0);
        CHECK(found.steep == 0);
        CHECK(found.bent == 0);
        CHECK(found.known > found.boxes / 2);
        CHECK(found.curved > found.boxes / (is_spline ? 20u : 100u));
        CHECK(found.beyond > found.boxes / 50);
    }
}

TEST_CASE("rays through cells of volumes and labels find what marching through the whole finds") {
    Random rng(622);
    Compared all;
    for (int n = 0; n < (long_tests() ? 100 : 8); ++n) {
        const Field volume = Volume{.file = held_content(random_level_set(rng))};
        LabelGrid grid = random_labels(rng, 3);
        const Phased labels = Labels{.file = held_content(std::move(grid)),
                                     .of_phases = {Phase{1}, Phase{2}},
                                     .values = {},
                                     .empty = {},
                                     .smoothing = n % 4 == 1 ? 0.f : 1.f,
                                     .grid = {}};
        const Phased object =
            n % 4 == 0 ? Phased(Set{.phase = Phase{1}, .of = volume})
            : n % 2 == 1
                ? labels
                : Phased(Under{.of = {warped(Rotate{.axis = rng.direction(), .angle = 40}, labels),
                                      Set{.phase = Phase{3}, .of = Shell{.of = volume, .half_thickness = 0.05f}}}});
        compare_crossings(object, {}, long_tests() ? 1000 : 150, rng, all);
    }
    MESSAGE(all.rays, " rays, ", all.crossings, " crossings");
    CHECK(all.crossings > all.rays / 2);
    CHECK(all.different == 0);
}

}  // namespace test_voxels_in_box
