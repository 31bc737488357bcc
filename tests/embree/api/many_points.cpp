// Many points at once give the same bits as single points, whatever their layout.
#include "embree/api/api.hpp"

namespace test_many_points {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

constexpr float untouched = -77;

std::vector<std::array<float, 3>> some_points(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> coordinate(-1.6f, 1.6f);
    std::vector<std::array<float, 3>> all(count);
    for (auto& p : all) p = {coordinate(random), coordinate(random), coordinate(random)};
    return all;
}

PhasetreePoints one_after_another(const std::vector<std::array<float, 3>>& all) {
    PhasetreePoints p;
    phasetreeInitPoints(&p);
    p.count = all.size();
    p.x = all.front().data(), p.y = p.x + 1, p.z = p.x + 2;
    p.stride = sizeof all.front();
    return p;
}

const std::vector<std::array<float, 12>> motion{{0.8f, 0.3f, 0, -0.2f, 1.1f, 0, 0, 0.1f, 0.9f, 0.5f, -0.25f, 1},
                                                {0.4f, 0.7f, 0, -0.9f, 0.6f, 0, 0, 0.1f, 1.2f, -1, 0.75f, 0.5f}};

bool same(float a, float b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace

TEST_CASE("phases and radii of many points are those of each") {
    for (const bool moves : {false, true}) {
        CAPTURE(moves);
        Placed placed;
        if (moves) placed.geometry.set_motion(motion);
        for (const std::size_t count : {1, 7, 8, 9, 64, 1001}) {
            const auto all = some_points(count, static_cast<unsigned>(count));
            PhasetreePoints p = one_after_another(all);
            std::vector<float> x, y, z, times;
            for (const auto& q : all) {
                x.push_back(q[0]), y.push_back(q[1]), z.push_back(q[2]);
                times.push_back(static_cast<float>(times.size() % 5) / 4);
            }
            PhasetreePoints arrays = p;
            arrays.x = x.data(), arrays.y = y.data(), arrays.z = z.data();
            arrays.stride = sizeof(float);
            p.time = arrays.time = times.data();
            p.timeStride = arrays.timeStride = sizeof(float);
            std::vector<unsigned> phases(count + 1, 99), again(count);
            std::vector<float> radii(count + 1, untouched);
            REQUIRE(phasetreeGetPhaseN(placed.geometry.get(), &p, phases.data(), radii.data()) == PHASETREE_ERROR_NONE);
            REQUIRE(phasetreeGetPhaseN(placed.geometry.get(), &arrays, again.data(), nullptr) == PHASETREE_ERROR_NONE);
            for (std::size_t i = 0; i < count; ++i) {
                float radius = 0;
                REQUIRE(placed.geometry.phase(all[i], times[i], &radius) == phases[i]);
                REQUIRE(same(radius, radii[i]));
                REQUIRE(again[i] == phases[i]);
            }
            CHECK(phases[count] == 99);
            CHECK(radii[count] == untouched);
            // Without times all are at time 0; with a stride of 0 at the one time.
            p.time = nullptr;
            arrays.time = &times[count - 1];
            arrays.timeStride = 0;
            REQUIRE(phasetreeGetPhaseN(placed.geometry.get(), &p, phases.data(), nullptr) == PHASETREE_ERROR_NONE);
            REQUIRE(phasetreeGetPhaseN(placed.geometry.get(), &arrays, again.data(), nullptr) == PHASETREE_ERROR_NONE);
            for (std::size_t i = 0; i < count; ++i) {
                REQUIRE(placed.geometry.phase(all[i], 0) == phases[i]);
                REQUIRE(placed.geometry.phase(all[i], times[count - 1]) == again[i]);
            }
            CHECK(placed.geometry.phases(all, times[count - 1]) == again);
        }
    }
}

TEST_CASE("distances of many points are those of each, in any layout") {
    Placed placed;
    placed.geometry.set_motion(motion);
    constexpr std::size_t count = 203;
    constexpr unsigned phase_count = 7;  // two more than there are
    const auto all = some_points(count, 5);
    const PhasetreePoints p = one_after_another(all);
    struct Layout {
        std::size_t point, phase;
    };
    for (const Layout& layout : {Layout{4 * phase_count, 4}, Layout{4, 4 * count}, Layout{4 * phase_count + 8, 4},
                                 Layout{12, 12 * count + 16}, Layout{8 * phase_count, 8}}) {
        CAPTURE(layout.point);
        const std::size_t floats = (layout.point * count + layout.phase * phase_count) / 4;
        std::vector<float> out(floats, untouched);
        REQUIRE(phasetreeGetDistancesN(placed.geometry.get(), &p, phase_count, out.data(), layout.point,
                                       layout.phase) == PHASETREE_ERROR_NONE);
        for (std::size_t i = 0; i < count; ++i) {
            const auto phi = placed.geometry.distances(all[i]);
            for (unsigned k = 0; k < phase_count; ++k) {
                float& d = out[(layout.point * i + layout.phase * k) / 4];
                REQUIRE(same(d, phi[k]));
                d = untouched;
            }
        }
        for (const float d : out) REQUIRE(d == untouched);
    }
    const std::vector<float> wrapped = placed.geometry.distances(all, 3);
    for (std::size_t i = 0; i < count; ++i)
        for (unsigned k = 0; k < 3; ++k) REQUIRE(same(wrapped[3 * i + k], placed.geometry.distances(all[i])[k]));
}

TEST_CASE("many points that are asked for wrongly, and none at all") {
    Placed placed;
    const PhasetreeGeometry g = placed.geometry.get();
    const auto invalid = PHASETREE_ERROR_INVALID_ARGUMENT, not_now = PHASETREE_ERROR_INVALID_OPERATION,
               no_handle = PHASETREE_ERROR_INVALID_HANDLE;
    auto all = some_points(20, 6);
    const PhasetreePoints good = one_after_another(all);
    std::vector<unsigned> phases(20, 99);
    std::vector<float> out(20 * 64, untouched);
    PhasetreePoints none;
    phasetreeInitPoints(&none);
    CHECK(phasetreeGetPhaseN(g, &none, nullptr, nullptr) == PHASETREE_ERROR_NONE);
    CHECK(phasetreeGetDistancesN(g, &none, 1, nullptr, 4, 4) == PHASETREE_ERROR_NONE);
    const auto phase_n = [&](const PhasetreePoints& p) { return phasetreeGetPhaseN(g, &p, phases.data(), out.data()); };
    const auto distances_n = [&](unsigned count, std::size_t point, std::size_t phase) {
        return phasetreeGetDistancesN(g, &good, count, out.data(), point, phase);
    };
    expect_error(phasetreeGetPhaseN(nullptr, &good, phases.data(), nullptr), no_handle, "geometry is NULL");
    expect_error(phasetreeGetPhaseN(g, nullptr, phases.data(), nullptr), invalid, "points is NULL");
    expect_error(phasetreeGetPhaseN(g, &good, nullptr, out.data()), invalid, "phases is NULL");
    expect_error(phasetreeGetDistancesN(nullptr, &good, 1, out.data(), 4, 4), no_handle, "geometry is NULL");
    expect_error(phasetreeGetDistancesN(g, &good, 1, nullptr, 4, 4), invalid, "distances is NULL");
    for (const auto member : {&PhasetreePoints::x, &PhasetreePoints::y, &PhasetreePoints::z}) {
        PhasetreePoints bad = good;
        bad.*member = nullptr;
        expect_error(phase_n(bad), invalid, "is NULL");
    }
    for (const std::size_t stride : {0, 2, 6, 13}) {
        PhasetreePoints bad = good;
        bad.stride = stride;
        expect_error(phase_n(bad), invalid, "points->stride");
        bad = good;
        bad.time = out.data();
        bad.timeStride = stride;
        if (stride != 0) expect_error(phase_n(bad), invalid, "points->timeStride");
        expect_error(distances_n(2, stride, 80), invalid, "pointStride");
        expect_error(distances_n(2, 8, stride), invalid, "phaseStride");
    }
    expect_error(distances_n(0, 4, 4), invalid, "phaseCount is 0");
    expect_error(distances_n(65, 400, 4), invalid, "phaseCount is 65");
    expect_error(distances_n(5, 16, 4), invalid, "overlap");
    expect_error(distances_n(5, 4, 76), invalid, "overlap");
    expect_error(distances_n(2, 4, 4), invalid, "overlap");
    // The last point counts as the first does, and before anything is written.
    all[19][1] = std::numeric_limits<float>::quiet_NaN();
    expect_error(phase_n(good), invalid, "point 19");
    expect_error(distances_n(1, 4, 4), invalid, "point 19");
    all[19][1] = 0;
    std::vector<float> times(20, 0);
    PhasetreePoints timed = good;
    timed.time = times.data();
    times[18] = std::numeric_limits<float>::infinity();
    expect_error(phase_n(timed), invalid, "time of point 18");
    times[18] = 0.5f;
    placed.geometry.set_motion({{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, {-1, 0, 0, 0, -1, 0, 0, 0, 1, 0, 0, 0}});
    expect_error(phase_n(timed), not_now, "no inverse");
    PhasetreeGeometry freed = nullptr;
    {
        const embree::Geometry gone(placed.device, placed.tree);
        freed = gone.get();
    }
    expect_error(phasetreeGetPhaseN(freed, &good, phases.data(), nullptr), no_handle, "released");
    for (const unsigned phase : phases) REQUIRE(phase == 99);
    for (const float d : out) REQUIRE(d == untouched);
}

}  // namespace test_many_points
