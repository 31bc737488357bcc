// Compares the solids of meshes with every defect with winding numbers in double precision over all triangles, at
// points and along rays.
//
// The long form takes a million points and 20,000 rays for each of 40 meshes. Set PHASETREE_MESHES to a folder to add
// all OBJ, PLY and STL files in it.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/mesh.hpp"
#include "phasetree/nodes/fields/mesh_traits.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "source_directory.hpp"
#include "support/compared_crossings.hpp"
#include "support/mesh_defects.hpp"
#include "support/set_algebra/meshes.hpp"
#include "support/winding_numbers.hpp"

namespace test_mesh_solids {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

// The region of a face extends beyond each of its sides, and beyond the ends of the longest one, by 2⁻²² of that side,
// which bounds the rounding errors (mesh_pieces.hpp). With these errors, that is twice as much, and at corners √2 times
// more.
constexpr double slack_of_faces = 0x1.6ap-21;  // of the mesh's diagonal
constexpr double moved_by_repair = 1e-6;       // of the mesh's largest coordinate

bool is_inside(const std::string& rule, double winding) {
    if (rule == "even_odd") return std::lround(winding) % 2 != 0;
    return (rule == "non_zero" ? std::abs(winding) : winding) >= 0.5;
}

class Solid {
  public:
    explicit Solid(DefectiveMesh mesh) : mesh_(std::move(mesh)), node_{.file = held(mesh_.file), .rule = mesh_.rule} {
        node_.prepare();
        float largest = 0;
        for (const glm::vec3& v : mesh_.meant.vertices) {
            box_ = unite(box_, {v, v});
            for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(v[i]));
        }
        rounding_ = slack_of_faces * static_cast<double>(box_.diagonal());
        if (is_repaired()) rounding_ += moved_by_repair * static_cast<double>(largest);
    }

    const DefectiveMesh& mesh() const { return mesh_; }
    bool is_repaired() const { return !node_.corners.empty(); }
    const Bounds& box() const { return box_; }
    Phased object() const { return Set{.phase = Phase{1}, .of = node_}; }
    double rounding() const { return rounding_; }

    bool contains(const glm::vec3& p) const {
        return Mesh::distance(node_.table.data(), Vec3<float>{p.x, p.y, p.z}) < 0;
    }
    mesh::PieceKind nearest(const glm::vec3& p) const {
        return mesh::PieceTree::nearest(node_.table.data(), {p.x, p.y, p.z}).kind;
    }
    bool is_at_hole(const glm::dvec3& p) const {
        return std::ranges::any_of(mesh_.holes, [&](const HullOfHole& h) { return h.contains(p, rounding_); });
    }

  private:
    DefectiveMesh mesh_;
    Mesh node_;
    Bounds box_;
    double rounding_ = 0;
};

// Half of the points are anywhere in the box and around it, the others near triangles, edges and vertices, at distances
// between a hundredth of the diagonal and its rounding.
glm::vec3 random_point(const Solid& solid, Random& rng) {
    if (rng.chance(0.5)) return rng.in(solid.box().inflated(0.05f * solid.box().diagonal()));
    const TriangleMesh& meant = solid.mesh().meant;
    const glm::uvec3 t = meant.triangles[static_cast<std::size_t>(rng.below(static_cast<int>(meant.triangles.size())))];
    glm::vec3 weights(rng.uniform(0, 1), rng.uniform(0, 1), rng.uniform(0, 1));
    for (int kind = rng.below(3), i = 0; i < kind; ++i) weights[i] = 0;
    weights /= weights.x + weights.y + weights.z + 1e-9f;
    const glm::vec3 on =
        weights.x * meant.vertices[t.x] + weights.y * meant.vertices[t.y] + weights.z * meant.vertices[t.z];
    return on + std::pow(10.f, rng.uniform(-6, -2)) * solid.box().diagonal() * rng.direction();
}

struct Labels {
    std::size_t points = 0, inside = 0, at_holes = 0, within_rounding = 0, wrong = 0;
    double farthest = 0;  // of those within rounding, relative to it
};

Labels compare_labels(const Solid& solid, Random& rng, std::size_t count) {
    Labels found;
    std::vector<glm::vec3> points(std::min<std::size_t>(count, 4096));
    for (; found.points < count; found.points += points.size()) {
        for (glm::vec3& p : points) p = random_point(solid, rng);
        const std::vector<double> windings = winding_numbers(solid.mesh().meant, points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const bool expected = is_inside(solid.mesh().rule, windings[i]);
            found.inside += expected;
            if (expected == solid.contains(points[i])) continue;
            const glm::dvec3 p(points[i]);
            if (solid.is_at_hole(p)) {
                ++found.at_holes;
                continue;
            }
            const double far = oracle::to_triangles(solid.mesh().meant, p) / solid.rounding();
            if (far <= 1) {
                ++found.within_rounding;
                found.farthest = std::max(found.farthest, far);
                continue;
            }
            CAPTURE(windings[i]);
            CAPTURE(far);
            CAPTURE(p.x);
            CAPTURE(p.y);
            CAPTURE(p.z);
            if (++found.wrong < 10) CHECK_MESSAGE(expected == solid.contains(points[i]), solid.mesh().name);
        }
    }
    return found;
}

struct Line {
    glm::vec3 origin, direction;
};
struct Passage {
    double t;
    int turn;  // how much the winding number rises
};

// Where a line passes through the triangles, in double. Nothing if it is too close to an edge to tell.
std::optional<std::vector<Passage>> passages(const TriangleMesh& mesh, const Line& line) {
    std::vector<Passage> found;
    const glm::dvec3 o(line.origin), d(line.direction);
    for (const glm::uvec3& t : mesh.triangles) {
        const std::array<glm::dvec3, 3> q{glm::dvec3(mesh.vertices[t.x]) - o, glm::dvec3(mesh.vertices[t.y]) - o,
                                          glm::dvec3(mesh.vertices[t.z]) - o};
        const double u = glm::dot(d, glm::cross(q[0], q[1])), v = glm::dot(d, glm::cross(q[1], q[2])),
                     w = glm::dot(d, glm::cross(q[2], q[0]));
        const double least = std::min({u, v, w}), most = std::max({u, v, w}), rounding = 1e-13;
        if (least < -rounding && most > rounding) continue;
        const glm::dvec3 n = glm::cross(q[1] - q[0], q[2] - q[0]);
        if (!(least > rounding || most < -rounding)) {
            if (glm::dot(n, n) == 0) continue;
            return std::nullopt;
        }
        found.push_back({glm::dot(n, q[0]) / glm::dot(n, d), most > 0 ? -1 : 1});
    }
    std::ranges::sort(found, {}, &Passage::t);
    return found;
}

struct Rays {
    std::size_t rays = 0, crossings = 0, intervals = 0, wrong = 0;
};

// Between any two places where the line passes through a triangle or the traced ray changes its phase, the phase must
// be that of the winding number, unless the interval is at a hole or within rounding of the surface.
void compare_ray(const Solid& solid, const CellsAlongRay& cells, const Line& line, Evaluator::Workspace& workspace,
                 Rays& found) {
    const auto expected = passages(solid.mesh().meant, line);
    if (!expected) return;
    ++found.rays;
    std::vector<double> traced;  // the phase alternates
    glm::vec3 p = line.origin;
    Phase phase = vacuum;
    TraceCounters counters;
    const glm::dvec3 o(line.origin), d(line.direction);
    while (const auto next = nearest_crossing(cells, p, line.direction, phase, workspace, counters)) {
        traced.push_back(glm::dot(0.5 * (glm::dvec3(next->p_from) + glm::dvec3(next->p_to)) - o, d));
        p = next->p_to;
        phase = next->to;
        REQUIRE(traced.size() < 10'000);
    }
    found.crossings += traced.size();
    std::vector<double> ends;
    for (const Passage& at : *expected) ends.push_back(at.t);
    ends.insert(ends.end(), traced.begin(), traced.end());
    std::ranges::sort(ends);
    const double tolerance = solid.rounding() + 2 * static_cast<double>(cells.cells().resolution());
    std::size_t passed = 0, crossed = 0;
    int winding = 0;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        for (; passed < expected->size() && (*expected)[passed].t <= ends[i]; ++passed)
            winding += (*expected)[passed].turn;
        while (crossed < traced.size() && traced[crossed] <= ends[i]) ++crossed;
        ++found.intervals;
        if (is_inside(solid.mesh().rule, winding) == (crossed % 2 == 1) || ends[i + 1] - ends[i] <= tolerance) continue;
        const glm::dvec3 middle = o + 0.5 * (ends[i] + ends[i + 1]) * d;
        if (solid.is_at_hole(middle) || oracle::to_triangles(solid.mesh().meant, middle) <= tolerance) continue;
        ++found.wrong;
        CHECK_MESSAGE(is_inside(solid.mesh().rule, winding) == (crossed % 2 == 1), solid.mesh().name);
    }
}

Rays compare_rays(const Solid& solid, Random& rng, int count) {
    const InterfaceCells cells(solid.object());
    const CellsAlongRay boxes(cells);
    Evaluator::Workspace workspace;
    Rays found;
    const glm::vec3 middle = solid.box().centre();
    for (int i = 0; i < count; ++i) {
        const glm::vec3 origin = middle + solid.box().diagonal() * rng.direction();
        const glm::vec3 to = i % 2 == 0 ? rng.in(solid.box()) : random_point(solid, rng);
        compare_ray(solid, boxes, {origin, glm::normalize(to - origin)}, workspace, found);
    }
    return found;
}

void compare(DefectiveMesh mesh, Random& rng) {
    const Solid solid(std::move(mesh));
    const auto points = static_cast<std::size_t>(long_tests() ? 1'000'000 : 4096);
    const Labels labels = compare_labels(solid, rng, points);
    const Rays rays = compare_rays(solid, rng, long_tests() ? 20'000 : 100);
    MESSAGE(solid.mesh().name, std::string(solid.is_repaired() ? ", repaired: " : ": "),
            solid.mesh().file.triangles.size(), " triangles, ", labels.points, " points, ", labels.inside, " inside, ",
            labels.at_holes, " at holes, ", labels.within_rounding, " within rounding (up to ", labels.farthest,
            " of it), ", labels.wrong, " wrong; ", rays.rays, " rays, ", rays.crossings, " crossings, ", rays.wrong,
            " wrong");
    CHECK(labels.wrong == 0);
    CHECK(labels.inside > labels.points / 100);
    CHECK(labels.inside < labels.points);
    CHECK(labels.at_holes < labels.points / 20);
    CHECK(labels.within_rounding < labels.points / 20);
    CHECK(rays.wrong == 0);
    CHECK(rays.crossings > rays.rays / 2);
}

// The file of a cow, about as large as the other meshes.
TriangleMesh cow() {
    TriangleMesh mesh = FileFormat<TriangleMesh>::read(source_directory() + "/scenes/assets/spot.ply");
    return mesh;
}

}  // namespace

TEST_CASE("winding numbers by products of complex numbers are sums of arc tangents") {
    Random rng(1);
    const TriangleMesh mesh = random_mesh(rng, 2, 0.5f);
    std::vector<glm::vec3> points;
    for (int i = 0; i < 1001; ++i) points.push_back(rng.uniform(0, 1.2f) * rng.direction());
    const std::vector<double> found = winding_numbers(mesh, points);
    double worst = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        worst = std::max(worst, std::abs(found[i] - oracle::winding_number(mesh, points[i])));
    CHECK(worst < 1e-10);
    TriangleMesh open = mesh;
    open.triangles.resize(open.triangles.size() / 2);
    append(open, mesh, glm::vec3(0.1f));
    const std::vector<double> of_open = winding_numbers(open, points);
    for (std::size_t i = 0; i < points.size(); ++i)
        worst = std::max(worst, std::abs(of_open[i] - oracle::winding_number(open, points[i])));
    CHECK(worst < 1e-10);
}

// Each cap is a fan of triangles around a vertex on the rim, with angles of half a degree there, as CAD programs write.
TEST_CASE("the region of a face does not extend beyond its sharp corners") {
    constexpr int n = 360;
    TriangleMesh mesh;
    for (int i = 0; i < n; ++i) {
        const double a = 2 * std::numbers::pi * i / n;
        for (const double z : {-0.5, 0.5}) mesh.vertices.push_back(glm::dvec3(std::cos(a), std::sin(a), z));
    }
    // Turned, because points outside the box around the mesh are outside anyway.
    const glm::dmat3 turn = glm::dmat3(glm::rotate(glm::dmat4(1), 0.8, glm::normalize(glm::dvec3(1, 2, 3))));
    for (glm::vec3& v : mesh.vertices) v = turn * glm::dvec3(v);
    const auto vertex = [](int i, int top) { return static_cast<std::uint32_t>(2 * (i % n) + top); };
    for (int i = 0; i < n; ++i) {
        mesh.triangles.push_back({vertex(i, 0), vertex(i + 1, 0), vertex(i + 1, 1)});
        mesh.triangles.push_back({vertex(i, 0), vertex(i + 1, 1), vertex(i, 1)});
        if (i == 0 || i + 1 == n) continue;
        mesh.triangles.push_back({vertex(0, 1), vertex(i, 1), vertex(i + 1, 1)});
        mesh.triangles.push_back({vertex(0, 0), vertex(i + 1, 0), vertex(i, 0)});
    }
    const Solid solid({.name = "fans", .file = mesh, .meant = mesh});
    CHECK_FALSE(solid.is_repaired());
    Random rng(339);
    std::size_t wrong = 0, outside = 0;
    double farthest = 0;
    std::vector<glm::vec3> points;
    for (int k = 0; k < 20'000; ++k) {
        const float away = std::pow(10.f, rng.uniform(-6, -3));
        points.push_back(mesh.vertices[vertex(0, 1)] + away * rng.direction());
    }
    const std::vector<double> windings = winding_numbers(mesh, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool expected = windings[i] >= 0.5;
        outside += !expected;
        if (expected == solid.contains(points[i])) continue;
        const double far = oracle::to_triangles(mesh, glm::dvec3(points[i]));
        wrong += far > solid.rounding();
        farthest = std::max(farthest, far / solid.rounding());
    }
    MESSAGE("wrong labels at most ", farthest, " roundings from the surface");
    CHECK(outside > points.size() / 2);
    CHECK(wrong == 0);
    compare({.name = "fans", .file = mesh, .meant = mesh}, rng);
}

// Beside the tip of a spike, the tip is nearest. Up to rounding, the edges that end there are equally near, and one may
// win although its height has the wrong sign. The test skips points to which a face is nearest, and points opposite the
// coplanar faces, where an edge of these may be right about the direction but wrong about the side.
TEST_CASE("beside the tip of a spike, edges with the wrong sign are not nearest") {
    Random rng(341);
    std::size_t edges = 0, wrong = 0;
    double farthest = 0;
    for (int spike = 0; spike < 300; ++spike) {
        const glm::dmat3 turn(
            glm::rotate(glm::dmat4(1), static_cast<double>(rng.uniform(0, 6)), glm::dvec3(rng.direction())));
        const double width = std::pow(10.0, static_cast<double>(rng.uniform(-2.5f, -0.5f)));
        const auto corner = [&](int k) {
            const double a = 2 * std::numbers::pi / 3 * k;
            return turn * glm::dvec3(width * std::cos(a), width * std::sin(a), 1);
        };
        // The triangles on either side of the edge from vertex 0 to 2 are coplanar. The other edges from vertex 0 are
        // sharp, with about 60 degrees between their normals and those of the faces.
        const glm::dvec3 a = corner(0), b = corner(1), up = glm::normalize(glm::cross(b, a));
        const TriangleMesh spiked{{glm::vec3(0), a, glm::mix(a, b, 0.3), b, corner(2)},
                                  {{0, 2, 1}, {0, 3, 2}, {0, 4, 3}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}}};
        const Solid solid({.name = "spike", .file = spiked, .meant = spiked});
        CHECK_FALSE(solid.is_repaired());
        std::vector<glm::vec3> beside;
        while (beside.size() < 400) {
            const glm::vec3 edge = spiked.vertices[static_cast<std::size_t>(1 + rng.below(4))];
            const glm::vec3 away = glm::normalize(glm::cross(edge, rng.direction()));
            if (glm::dot(glm::dvec3(away), up) > -0.6) beside.push_back(std::pow(10.f, rng.uniform(-6, -3)) * away);
        }
        const std::vector<double> windings = winding_numbers(spiked, beside);
        for (std::size_t i = 0; i < beside.size(); ++i) {
            if (solid.nearest(beside[i]) != mesh::PieceKind::edge) continue;
            ++edges;
            if ((windings[i] >= 0.5) == solid.contains(beside[i])) continue;
            farthest = std::max(farthest, oracle::to_triangles(spiked, glm::dvec3(beside[i])));
            ++wrong;
        }
    }
    // The bound in mesh_pieces.hpp: 2 s/cos β, where s is twice the slack, and the edges are about as long as 1.
    const double bound = 2 * 2 * 0x1p-22 * 1.06 / 0.498;
    MESSAGE(edges, " points nearest to edges, ", wrong, " wrong, at most ", farthest, " away");
    CHECK(edges > 10'000);
    CHECK(farthest < bound);
}

// A repaired mesh, and a point beside one of its spikes to which an edge of the spike was once nearest.
TEST_CASE("an edge of a repaired spike is not nearest to a point on its other side") {
    Random rng(337);
    PlantedDefects planted(rng);
    const Solid solid(planted.all("rough ball", random_mesh(rng, 3, 0.6f)).front());
    CHECK(solid.is_repaired());
    const glm::vec3 p(0x1.08b05ep+0f, 0x1.fc3eep-1f, -0x1.c870eap-1f);
    CHECK(std::abs(oracle::winding_number(solid.mesh().meant, p)) < 1e-9);
    CHECK(oracle::to_triangles(solid.mesh().meant, glm::dvec3(p)) > solid.rounding());
    CHECK_FALSE(solid.contains(p));
}

TEST_CASE("meshes with planted defects are the solids of their winding numbers") {
    Random rng(337);
    PlantedDefects planted(rng);
    std::size_t meshes = 0;
    const auto all = [&](const std::string& name, const TriangleMesh& base) {
        for (DefectiveMesh& mesh : planted.all(name, base)) {
            compare(std::move(mesh), rng);
            ++meshes;
        }
    };
    all("rough ball", random_mesh(rng, 3, 0.6f));
    all("torus", torus_mesh(20, 12, 0.7, 0.3));
    if (long_tests()) all("cow", cow());
    CHECK(meshes >= (long_tests() ? 39 : 26));
}

TEST_CASE("meshes of other people are the solids of their winding numbers") {
    Random rng(338);
    compare(with_closed_holes("spot.ply", cow()), rng);
    const char* folder = std::getenv("PHASETREE_MESHES");
    if (folder == nullptr) return;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        for (const char* extension : {".obj", ".ply", ".stl", ".STL"})
            if (entry.path().extension() == extension) files.push_back(entry.path());
    std::ranges::sort(files);
    for (const auto& file : files) {
        try {
            compare(with_closed_holes(file.filename(), FileFormat<TriangleMesh>::read(file)), rng);
        } catch (const ModelError& e) {
            MESSAGE(file.filename().string(), ": ", std::string(e.what()));
            CHECK(std::string(e.what()).find("is a sheet that encloses nothing") != std::string::npos);
        }
    }
}

}  // namespace test_mesh_solids
