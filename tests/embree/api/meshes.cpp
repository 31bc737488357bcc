// Meshes of geometries through the C99 interface: their guarantees, and rejected arguments.
#include "embree/api/api.hpp"
#include "support/manifold.hpp"

namespace test_api_meshes {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

const char* const shell_text = R"({
  "phases": {"glass": 0, "water": 0},
  "tree": {"thin_shell": {"of": {"sphere": {"radius": 1}}, "shell": "glass", "inside": "water", "half_thickness": 0.1}}
})";

struct Received {
    int times = 0;
    std::size_t triangles = 0;
};

void receive(const PhasetreeMesh* mesh, void* to) {
    auto& received = *static_cast<Received*>(to);
    ++received.times;
    received.triangles = mesh->triangleCount;
}

// The outward triangles that have a phase on exactly one side.
std::vector<std::array<std::uint32_t, 3>> surface_of(const embree::Mesh& mesh, unsigned phase) {
    std::vector<std::array<std::uint32_t, 3>> surface;
    for (std::size_t i = 0; i < mesh.behind.size(); ++i) {
        const unsigned *const t = mesh.indices.data() + 3 * i, behind = mesh.behind[i], front = mesh.front[i];
        if (behind == phase) surface.push_back({t[0], t[1], t[2]});
        if (front == phase) surface.push_back({t[0], t[2], t[1]});
    }
    return surface;
}

double volume_of(const embree::Mesh& mesh, const std::vector<std::array<std::uint32_t, 3>>& surface) {
    double six_times = 0;
    const auto at = [&](std::uint32_t v) {
        const float* const p = mesh.vertices.data() + 3 * v;
        return glm::dvec3(p[0], p[1], p[2]);
    };
    for (const auto& t : surface) six_times += glm::dot(at(t[0]), glm::cross(at(t[1]), at(t[2])));
    return six_times / 6;
}

}  // namespace

TEST_CASE("a geometry's mesh has closed surfaces of its phases, hidden and moved ones too") {
    const Device device;
    const embree::Tree tree = embree::Tree::from_text(shell_text);
    embree::Geometry geometry(device, tree);
    geometry.set_shown_phases(PhasetreePhaseSet{1} << 1);
    geometry.set_motion({{1, 0, 0, 0, 1, 0, 0, 0, 1, 5, 0, 0}});
    PhasetreeMeshOptions options = embree::default_mesh_options();
    options.spacing = 0.05f;
    const embree::Mesh mesh = geometry.mesh(options);
    CHECK(mesh.spacing == 0.05f);
    CHECK(mesh.crossings > 1000);
    CHECK(mesh.skipped * 50 < mesh.crossings);
    CHECK(mesh.indices.size() == 3 * mesh.behind.size());
    const double unit = 4 * 3.14159265358979 / 3, outer = 1.1 * 1.1 * 1.1, inner = 0.9 * 0.9 * 0.9;
    for (const auto& [phase, volume] : {std::pair(1u, outer - inner), std::pair(2u, inner), std::pair(0u, -outer)}) {
        const auto surface = surface_of(mesh, phase);
        std::vector<std::uint32_t> number(mesh.vertices.size() / 3, 0);
        std::uint32_t used = 0;
        auto compact = surface;
        for (auto& t : compact)
            for (std::uint32_t& v : t) {
                if (number[v] == 0) number[v] = ++used;
                v = number[v] - 1;
            }
        CHECK(manifold_faults(compact, used).all() == 0);
        CHECK(volume_of(mesh, surface) == doctest::Approx(unit * volume).epsilon(0.01));
    }
}

TEST_CASE("making a mesh refuses what it cannot do, and can be followed and ended") {
    const Device device;
    const embree::Tree tree = embree::Tree::from_text(shell_text);
    const embree::Geometry geometry(device, tree);
    Received received;
    PhasetreeMeshOptions options = embree::default_mesh_options();
    const auto make = [&](PhasetreeGeometry of) { return phasetreeMakeGeometryMesh(of, &options, receive, &received); };
    CHECK(make(nullptr) == PHASETREE_ERROR_INVALID_HANDLE);
    CHECK(phasetreeMakeGeometryMesh(geometry.get(), &options, nullptr, nullptr) == PHASETREE_ERROR_INVALID_ARGUMENT);
    for (const float spacing :
         {-1.f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e-6f}) {
        options.spacing = spacing;
        CHECK(make(geometry.get()) == PHASETREE_ERROR_INVALID_ARGUMENT);
        CHECK(std::string(phasetreeGetErrorMessage()).find("options->spacing") != std::string::npos);
    }
    options.spacing = 0.1f;
    options.cancelled = [](void*) { return true; };
    CHECK(make(geometry.get()) == PHASETREE_ERROR_CANCELLED);
    PhasetreeGeometryOptions opaque = embree::default_options();
    opaque.opaquePhases = PhasetreePhaseSet{1} << 2;
    options.cancelled = nullptr;
    CHECK(make(embree::Geometry(device, tree, opaque).get()) == PHASETREE_ERROR_INVALID_OPERATION);
    CHECK(received.times == 0);

    float told = 0;
    options.progressUserPtr = &told;
    options.progress = [](float done, void* to) { *static_cast<float*>(to) = done; };
    CHECK(make(geometry.get()) == PHASETREE_ERROR_NONE);
    CHECK(received.times == 1);
    CHECK(received.triangles > 1000);
    CHECK(told == 1);
    // Defaults.
    CHECK(phasetreeMakeGeometryMesh(geometry.get(), nullptr, receive, &received) == PHASETREE_ERROR_NONE);
    CHECK(received.times == 2);
    CHECK(received.triangles > 100'000);
}

}  // namespace test_api_meshes
