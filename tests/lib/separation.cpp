// Triangles of meshes never cross or touch each other, whatever the object and the spacing.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <string>
#include <vector>

#include "meshing/regular_points.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/meshing/phase_mesh.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/mesh.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/over.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/thin_shell.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/gallery.hpp"
#include "support/manifold.hpp"
#include "support/random_mesh.hpp"
#include "support/random_voxel_lines.hpp"
#include "support/triangle_contacts.hpp"

namespace test_separation {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

using Corners3 = std::array<glm::dvec3, 3>;

PhaseMesh meshed(const InterfaceTracer& tracer, float spacing) {
    return mesh_of(tracer.bounds(), line_tracer(tracer), {.spacing = spacing});
}

TriangleContacts contacts_of(const PhaseMesh& mesh) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const PhaseMesh::Triangle& t : mesh.triangles) triangles.push_back(t.vertices);
    const double tolerance = std::min(last_place(mesh.vertices), static_cast<double>(mesh.spacing) / 128);
    return triangle_contacts(mesh.vertices, triangles, tolerance);
}

// Checks the triangles of all phases together, and that each phase has a closed, oriented surface.
void check(const PhaseMesh& mesh) {
    const TriangleContacts contacts = contacts_of(mesh);
    CHECK(contacts.pairs == 0);
    CHECK(contacts.slivers == 0);
    for_each_phase(mesh.phases().bits, [&](int p) {
        const ClosedMesh closed = surface_of(mesh, PhaseSet::of(Phase{static_cast<std::uint8_t>(p)}));
        CHECK(manifold_faults(closed.triangles, closed.vertices.size()).all() == 0);
    });
}

std::optional<InterfaceTracer> tracer_of(const Phased& object) {
    try {
        return std::optional<InterfaceTracer>(std::in_place, object);
    } catch (const ModelError&) {
        return std::nullopt;
    }
}

// Triangles from the vertex of a patch of a cube to its segments on the sides.
struct Patch {
    std::vector<meshing::PlacedTriangle> triangles;
};

// The patches of a cube with regular points. Vertices of different patches have different numbers.
std::vector<Patch> regular_patches(const meshing::CubeLabels& labels) {
    const meshing::CubePatches patches(labels);
    std::vector<Patch> all(static_cast<std::size_t>(patches.count()));
    for (int side = 0; side < 6; ++side)
        for (int i = 0; i < 4; ++i) {
            const int a = meshing::sides_of_cube[side][i], b = meshing::sides_of_cube[side][(i + 1) % 4];
            if (labels.at(a) == labels.at(b)) continue;
            const int edge = meshing::edge_between(a, b), patch = patches.patch(edge);
            const meshing::SideCut cut = cut_of_side(labels, side, edge);
            const auto point = static_cast<std::uint32_t>(12 + 9 * side + 1 + cut.corner);
            all[static_cast<std::size_t>(patch)].triangles.push_back(
                {{static_cast<std::uint32_t>(edge), point, static_cast<std::uint32_t>(100 + patch)},
                 {meshing::edge_of_cube(edge).middle(), cut.regular_point(side),
                  regular_vertex(patches, labels, patch)}});
        }
    return all;
}

// Calls f for all labels of a cube, up to their names, and all choices of the phases joined across sides.
template <class F>
void for_each_cube(F&& f) {
    meshing::CubeLabels labels;
    const auto choose = [&](auto& self, int corner, int phases) -> void {
        if (corner < 8) {
            for (int p = 0; p <= phases; ++p) {
                labels.corners[static_cast<std::size_t>(corner)] = Phase{static_cast<std::uint8_t>(p)};
                self(self, corner + 1, std::max(phases, p + 1));
            }
            return;
        }
        std::vector<int> undecided;
        for (int side = 0; side < 6; ++side)
            if (meshing::take_turns(labels.corners, side)) undecided.push_back(side);
        for (int choice = 0; choice < 1 << undecided.size(); ++choice) {
            for (std::size_t i = 0; i < undecided.size(); ++i)
                labels.joined[static_cast<std::size_t>(undecided[i])] =
                    labels.at(meshing::sides_of_cube[undecided[i]][choice >> i & 1]);
            f(labels);
        }
    };
    choose(choose, 0, 0);
}

// The distance from a point to a segment between two others.
double distance_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    return glm::distance(p, a + t * (b - a));
}

}  // namespace

TEST_CASE("triangles that cross, touch or lie on each other are found, and neighbours are not") {
    const double tolerance = 1e-6;
    meshing::TriangleContact contact(tolerance);
    const Corners3 base{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    struct Case {
        std::array<std::uint32_t, 3> vertices;  // 0, 1 and 2 are those of the first triangle
        Corners3 at;
        bool is_contact;
    };
    const glm::dvec3 o = base[0], x = base[1], y = base[2];
    const Case cases[] = {
        {{3, 4, 5}, {{{0.2, 0.2, -1}, {0.2, 0.2, 1}, {2, 2, 0}}}, true},         // an edge goes through
        {{3, 4, 5}, {{{0.2, 0.2, 0}, {0.2, 0.2, 1}, {0.3, 0.2, 1}}}, true},      // a vertex on the inside
        {{3, 4, 5}, {{{0.5, 0, 0}, {0.5, -1, 1}, {0.5, -1, -1}}}, true},         // a vertex on an edge
        {{3, 4, 5}, {{{0.5, 0, -1}, {0.5, 0, 1}, {0.5, -1, 0}}}, true},          // two edges meet
        {{3, 4, 5}, {{o, {-1, 0, 1}, {-1, 0, 2}}}, true},                        // two vertices in one place
        {{3, 4, 5}, {{{0.2, 0.1, 0}, {0.6, 0.1, 0}, {0.2, 0.6, 0}}}, true},      // in one plane, one inside the other
        {{3, 4, 5}, {{{-1, 0.3, 0}, {1, 0.3, 0}, {-1, 0.4, 0}}}, true},          // in one plane, edges cross
        {{0, 1, 3}, {{o, x, {0.3, 0.3, 0}}}, true},                              // folded over a common edge
        {{0, 1, 3}, {{o, x, {0.3, 0.3, 1e-7}}}, true},                           // nearly folded
        {{0, 3, 4}, {{o, {0.9, 0.9, 1}, {0.9, 0.9, -1}}}, true},                 // a common vertex, and a crossing
        {{0, 1, 2}, base, true},                                                 // the same triangle
        {{3, 4, 5}, {{{0.2, 0.2, 1e-5}, {0.2, 0.2, 1}, {0.3, 0.2, 1}}}, false},  // just above
        {{0, 1, 3}, {{o, x, {0.3, -0.3, 0}}}, false},                            // neighbours in one plane
        {{0, 1, 3}, {{o, x, {0.3, 0.3, 0.01}}}, false},                          // neighbours at a sharp angle
        {{0, 3, 4}, {{o, {-1, 0.2, 0}, {-1, -0.2, 0}}}, false},                  // a common vertex in one plane
        {{2, 3, 4}, {{y, {0.5, 0.6, 0.1}, {0.5, 0.6, -0.1}}}, false},            // a common vertex across the plane
        {{3, 4, 5}, {{{2, 2, -1}, {2, 2, 1}, {3, 2, 0}}}, false},                // far away
    };
    int number = 0;
    for (const Case& c : cases) {
        CAPTURE(number++);
        for (int turn = 0; turn < 9; ++turn) {  // the result depends on neither order nor place
            meshing::PlacedTriangle a{{0, 1, 2}, base}, b{c.vertices, c.at};
            std::rotate(a.vertices.begin(), a.vertices.begin() + turn % 3, a.vertices.end());
            std::rotate(a.at.begin(), a.at.begin() + turn % 3, a.at.end());
            std::rotate(b.vertices.begin(), b.vertices.begin() + turn / 3, b.vertices.end());
            std::rotate(b.at.begin(), b.at.begin() + turn / 3, b.at.end());
            CHECK(contact.between(a, b) == c.is_contact);
            CHECK(contact.between(b, a) == c.is_contact);
        }
    }
    CHECK(contact.within({{0, 1, 2}, {{o, x, {0.5, 1e-7, 0}}}}));
    CHECK(contact.within({{0, 1, 2}, {{o, o, y}}}));
    CHECK_FALSE(contact.within({{0, 1, 2}, {{o, x, {0.5, 1e-4, 0}}}}));
}

TEST_CASE("with regular points, triangles of a cube keep a distance, whatever its labels") {
    // The smallest allowed spacing is 16 times the precision of coordinates, so rounding may move each point by 0.055
    // cubes.
    meshing::TriangleContact contact(0.125);
    std::size_t cubes = 0, with_patches = 0, touching = 0, outside = 0, thin = 0;
    for_each_cube([&](const meshing::CubeLabels& labels) {
        ++cubes;
        const std::vector<Patch> patches = regular_patches(labels);
        with_patches += patches.size() > 1 ? 1 : 0;
        for (std::size_t i = 0; i < patches.size(); ++i)
            for (const meshing::PlacedTriangle& t : patches[i].triangles) {
                const glm::dvec3& vertex = t.at[2];
                if (glm::clamp(vertex, 0.1, 0.9) != vertex) ++outside;
                // The segment on the side is not close to the vertex, and its ends are not close to each other.
                if (distance_to_segment(vertex, t.at[0], t.at[1]) < 0.15 || glm::distance(t.at[0], t.at[1]) < 0.15)
                    ++thin;
                for (std::size_t k = 0; k < i; ++k)
                    for (const meshing::PlacedTriangle& s : patches[k].triangles)
                        if (contact.between(t, s)) ++touching;
            }
    });
    CHECK(cubes > 4140);  // the ways to label eight corners, and to join sides
    CHECK(with_patches > 100);
    CHECK(touching == 0);
    CHECK(outside == 0);
    CHECK(thin == 0);
}

TEST_CASE("triangles of random labels cross nowhere") {
    std::size_t triangles = 0;
    for (std::uint64_t seed = 0; seed < (long_tests() ? 400u : 6u); ++seed) {
        const int phases = 2 + static_cast<int>(seed % 5);
        const RandomVoxels voxels{0.1 + 0.03 * static_cast<double>(seed % 4), phases, seed};
        // Slanted normals put vertices far outside their cubes.
        const PhaseMesh mesh =
            mesh_of(Bounds::centred(glm::vec3(0.5f)), voxels.lines(0.8f * Random(seed).direction()), {.spacing = 0.1f});
        triangles += mesh.triangles.size();
        CAPTURE(seed);
        check(mesh);
    }
    CHECK(triangles > 5'000);
}

TEST_CASE("triangles of random objects cross nowhere") {
    int objects = 0;
    for (std::uint64_t seed = 1; objects < (long_tests() ? 500 : 6); ++seed) {
        REQUIRE(seed < 10'000);
        Random rng(seed);
        const auto tracer = tracer_of(random_object(rng, 3));
        if (!tracer) continue;
        ++objects;
        CAPTURE(seed);
        for (const float cubes : {9.f, 31.f}) {
            CAPTURE(cubes);
            check(meshed(*tracer, tracer->bounds().diagonal() / cubes));
        }
    }
}

TEST_CASE("triangles of thin walls, small angles and sharp edges cross nowhere, near and far from the origin") {
    const Field box = warped(Rotate{.axis = {1, 2, 3}, .angle = 40}, Field(Box{.size = {1, 1, 1}}));
    const Field block = warped(Translate{{0.013f, 0.007f, 0.95f + 0.5f}}, Field(Box{.size = {3, 3, 1}}));
    const Phase one{1}, two{2};
    const Phased lens = Over{{Set{.phase = two, .of = block}, Set{.phase = one, .of = Sphere{.radius = 1}}}};
    const Phased wall = ThinShell{.of = box, .shell = one, .inside = two, .half_thickness = 0.02f};
    const Phased far = Set{.phase = one, .of = warped(Translate{{10'000, 7000, -3000}}, box)};
    // The last spacing is the smallest that coordinates allow there.
    for (const auto& [object, number] :
         {std::pair(lens, 0.05f), {wall, 0.1f}, {wall, 0.05f}, {far, 0.1f}, {far, 0.0192f}}) {
        const float spacing = number;  // Clang 14 captures no structured bindings in lambdas
        CAPTURE(spacing);
        check(meshed(InterfaceTracer(object), spacing));
    }
}

TEST_CASE("triangles of the gallery cross nowhere") {
    for (const std::filesystem::path& file : gallery_of_the_library()) {
        const std::string name = file.stem().string();
        if (!long_tests() && name != "hourglass" && name != "pearls" && name != "reinforced_pipe") continue;
        CAPTURE(name);
        const Phased object = read_tree(Document::from_file(file)).object;
        const auto tracer = tracer_of(object);
        if (!tracer || !tracer->bounds().finite()) continue;
        const glm::vec3 extent = tracer->bounds().extent();
        const float longest = std::max({extent.x, extent.y, extent.z});
        for (const float cubes : {19.f, 41.f, 67.f}) {
            if (!long_tests() && cubes > 30) continue;
            CAPTURE(cubes);
            check(meshed(*tracer, longest / cubes));
        }
    }
}

TEST_CASE("meshes that are read back need no repair, and have the object's labels") {
    int surfaces = 0;
    for (const std::string name : {"hourglass", "blob"}) {
        CAPTURE(name);
        const Phased object = read_tree(Document::from_file(source_directory() + "/scenes/" + name + ".json")).object;
        const InterfaceTracer tracer(object);
        const float spacing = tracer.bounds().diagonal() / 40;
        const PhaseMesh mesh = meshed(tracer, spacing);
        for_each_phase(mesh.phases().bits & ~std::uint64_t{1}, [&](int p) {
            CAPTURE(p);
            const Phase phase{static_cast<std::uint8_t>(p)};
            const ClosedMesh closed = surface_of(mesh, PhaseSet::of(phase));
            TriangleMesh read;
            read.vertices = closed.vertices;
            for (const auto& t : closed.triangles) read.triangles.emplace_back(t[0], t[1], t[2]);
            Mesh node{.file = held(std::move(read)), .rule = ""};
            node.prepare();
            CHECK(node.corners.empty());  // not repaired
            ++surfaces;
            Random rng(7);
            Evaluator::Workspace workspace;
            std::size_t certain = 0, wrong = 0;
            for (int i = 0; i < 20'000; ++i) {
                const glm::vec3 q = rng.in(tracer.bounds());
                const Phases<float> phi = tracer.evaluator().distances(q, workspace);
                bool is_far = true;
                for_each_phase(phi.present, [&](int k) { is_far = is_far && std::abs(phi[k]) > spacing; });
                if (!is_far) continue;
                ++certain;
                const bool is_inside = Mesh::distance(node.table.data(), Vec3<float>{q.x, q.y, q.z}) < 0;
                wrong += is_inside != (tracer.label(q, workspace) == phase) ? 1 : 0;
            }
            CHECK(certain > 1000);
            CHECK(wrong == 0);
        });
    }
    CHECK(surfaces >= 6);
}

}  // namespace test_separation
