// Carved bounds through the C99 interface: their guarantees, and rejected arguments.
#include "embree/api/api.hpp"
#include "support/random_tree.hpp"

namespace test_bounds {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

const char* const turned_sticks = R"({
  "phases": {"oak": 0, "elm": 0},
  "tree": {"rotate": {"axis": [1, 2, 3], "angle": 50, "of": {"under": [
    {"set": {"phase": "oak", "of": {"box": {"size": [2, 0.3, 0.2]}}}},
    {"set": {"phase": "elm", "of": {"translate": {"by": [0, 1, 0], "of": {"sphere": {"radius": 0.2}}}}}}
  ]}}}
})";

bool is_behind(const embree::CarvedBounds& carved, const std::array<float, 3>& p) {
    return std::all_of(carved.planes.begin(), carved.planes.end(), [&](const PhasetreePlane& plane) {
        double sum = -static_cast<double>(plane.offset);
        for (int i = 0; i < 3; ++i)
            sum += static_cast<double>(plane.normal[i]) * static_cast<double>(p[static_cast<std::size_t>(i)]);
        return sum <= 0;
    });
}

}  // namespace

TEST_CASE("all of a phase is behind the planes, and they are near") {
    const embree::Tree tree = embree::Tree::from_text(turned_sticks);
    const Device device;
    const embree::Geometry geometry(device, tree);
    const PhasetreePhaseSet oak = PhasetreePhaseSet{1} << tree.phase("oak");
    const embree::CarvedBounds whole = tree.carved(), stick = tree.carved(oak);
    CHECK(stick.volume < 0.12f * 1.05f);
    CHECK(stick.volume > 0.12f * 0.999f);
    CHECK(whole.volume > 2 * stick.volume);
    CHECK(stick.planes.size() >= 6);
    CHECK(stick.evaluations > 6);
    CHECK(stick.isWithinTolerance);

    tests::Random rng(1);
    int inside = 0;
    for (int i = 0; i < 30'000; ++i) {
        const glm::vec3 q = rng.in(Bounds::centred(glm::vec3(1.2f)));
        const std::array<float, 3> p{q.x, q.y, q.z};
        const unsigned phase = geometry.phase(p);
        if (phase != PHASETREE_VACUUM) CHECK(is_behind(whole, p));
        if (phase == tree.phase("oak")) {
            CHECK(is_behind(stick, p));
            ++inside;
        }
    }
    CHECK(inside > 100);
}

TEST_CASE("carving refuses what it cannot do, and can be ended") {
    const embree::Tree tree = embree::Tree::from_text(turned_sticks);
    PhasetreePlane planes[PHASETREE_MAX_PLANES];
    unsigned count = 77;
    PhasetreeCarveOptions options;
    phasetreeInitCarveOptions(&options);
    CHECK(phasetreeCarveTree(nullptr, PHASETREE_ALL_PHASES, nullptr, planes, &count, nullptr) ==
          PHASETREE_ERROR_INVALID_HANDLE);
    CHECK(phasetreeCarveTree(tree.get(), 1, nullptr, planes, &count, nullptr) == PHASETREE_ERROR_INVALID_ARGUMENT);
    CHECK(phasetreeCarveTree(tree.get(), PHASETREE_ALL_PHASES, nullptr, planes, nullptr, nullptr) ==
          PHASETREE_ERROR_INVALID_ARGUMENT);
    options.maxPlanes = 5;
    CHECK(phasetreeCarveTree(tree.get(), PHASETREE_ALL_PHASES, &options, planes, &count, nullptr) ==
          PHASETREE_ERROR_INVALID_ARGUMENT);
    options.maxPlanes = 6;
    options.tolerance = 0;
    CHECK(phasetreeCarveTree(tree.get(), PHASETREE_ALL_PHASES, &options, planes, &count, nullptr) ==
          PHASETREE_ERROR_INVALID_ARGUMENT);
    options.tolerance = 0.01f;
    options.cancelled = [](void*) { return true; };
    CHECK(phasetreeCarveTree(tree.get(), PHASETREE_ALL_PHASES, &options, planes, &count, nullptr) ==
          PHASETREE_ERROR_CANCELLED);
    CHECK(count == 77);
    options.cancelled = nullptr;
    CHECK(phasetreeCarveTree(tree.get(), PHASETREE_ALL_PHASES, &options, planes, &count, nullptr) ==
          PHASETREE_ERROR_NONE);
    CHECK(count == 6);

    const embree::Tree endless = embree::Tree::from_text(R"({"phases": {"a": 0}, "tree": {"set": {"phase": "a", "of":
        {"plane": {}}}}})");
    CHECK(phasetreeCarveTree(endless.get(), PHASETREE_ALL_PHASES, nullptr, planes, &count, nullptr) ==
          PHASETREE_ERROR_INVALID_TREE);
}

}  // namespace test_bounds
