#pragma once

/// Meshes with every defect that occurs in files, and the closed surfaces that they mean.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "phasetree/nodes/fields/joined_vertices.hpp"
#include "support/random_mesh.hpp"

namespace phasetree::tests {

/// The directions in which the hull of a hole is bounded: a superset of the convex hull.
struct HullOfHole {
    std::vector<glm::dvec3> axes;
    std::vector<std::pair<double, double>> ranges;

    explicit HullOfHole(const std::vector<glm::dvec3>& corners) {
        for (int x = -2; x <= 2; ++x)
            for (int y = -2; y <= 2; ++y)
                for (int z = 0; z <= 2; ++z)
                    if (x != 0 || y != 0 || z != 0) axes.push_back(glm::normalize(glm::dvec3(x, y, z)));
        glm::dvec3 middle(0), up(0);
        for (const glm::dvec3& c : corners) middle += c / static_cast<double>(corners.size());
        for (std::size_t i = 0; i + 1 < corners.size(); i += 2)
            up += glm::cross(corners[i] - middle, corners[i + 1] - middle);
        if (glm::length(up) > 0) axes.push_back(glm::normalize(up));
        for (const glm::dvec3& axis : axes) {
            auto& [least, most] = ranges.emplace_back(1e300, -1e300);
            for (const glm::dvec3& c : corners) {
                least = std::min(least, glm::dot(c, axis));
                most = std::max(most, glm::dot(c, axis));
            }
        }
    }
    bool contains(const glm::dvec3& p, double margin) const {
        for (std::size_t i = 0; i < axes.size(); ++i) {
            const double at = glm::dot(p, axes[i]);
            if (at < ranges[i].first - margin || at > ranges[i].second + margin) return false;
        }
        return true;
    }
};

/// A mesh as in a file, and the surface whose winding numbers say what is inside.
struct DefectiveMesh {
    std::string name{};
    TriangleMesh file{}, meant{};
    std::string rule{};
    std::vector<HullOfHole> holes{};  ///< here, a surface that closes the hole may be on either side of a point
};

inline void append(TriangleMesh& mesh, const TriangleMesh& part, const glm::vec3& offset, float scale = 1,
                   bool is_turned = false) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const glm::vec3& v : part.vertices) mesh.vertices.push_back(offset + scale * v);
    for (glm::uvec3 t : part.triangles) {
        if (is_turned) std::swap(t.y, t.z);
        mesh.triangles.push_back(t + first);
    }
}

inline TriangleMesh torus_mesh(int around, int across, double radius, double thickness) {
    TriangleMesh mesh;
    for (int i = 0; i < around; ++i)
        for (int k = 0; k < across; ++k) {
            const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * k / across,
                         r = radius + thickness * std::cos(b);
            mesh.vertices.push_back(glm::dvec3(r * std::cos(a), r * std::sin(a), thickness * std::sin(b)));
        }
    const auto vertex = [&](int i, int k) { return static_cast<std::uint32_t>(i % around * across + k % across); };
    for (int i = 0; i < around; ++i)
        for (int k = 0; k < across; ++k) {
            mesh.triangles.push_back({vertex(i, k), vertex(i + 1, k), vertex(i + 1, k + 1)});
            mesh.triangles.push_back({vertex(i, k), vertex(i + 1, k + 1), vertex(i, k + 1)});
        }
    return mesh;
}

/// Closes each connected set of open edges of a mesh by triangles from its centre, and notes its hull. For an edge
/// with several triangles, as many are added as it lacks for the surface to have no boundary.
inline DefectiveMesh with_closed_holes(std::string name, TriangleMesh mesh) {
    DefectiveMesh made{.name = std::move(name), .file = mesh};
    const JoinedVertices joined = join_vertices(mesh.vertices, mesh.triangles);
    TriangleMesh meant{joined.points, {}};
    std::map<std::array<std::uint32_t, 3>, int> kept;  // duplicates, once
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::uvec3 j(joined.of[t.x], joined.of[t.y], joined.of[t.z]);
        if (j.x == j.y || j.y == j.z || j.z == j.x) continue;
        std::array<std::uint32_t, 3> key{j.x, j.y, j.z};
        std::ranges::sort(key);
        if (kept[key]++ == 0) meant.triangles.push_back(j);
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
    for (const glm::uvec3& t : meant.triangles)
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t a = t[i], b = t[(i + 1) % 3];
            balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
    std::erase_if(balance, [](const auto& edge) { return edge.second == 0; });
    std::map<std::uint32_t, std::uint32_t> parent;
    const std::function<std::uint32_t(std::uint32_t)> root = [&](std::uint32_t v) {
        const auto at = parent.try_emplace(v, v).first;
        return at->second == v ? v : at->second = root(at->second);
    };
    for (const auto& [edge, times] : balance) parent[root(edge.first)] = root(edge.second);
    std::map<std::uint32_t, std::vector<glm::dvec3>> corners;
    for (const auto& [edge, times] : balance)
        for (const std::uint32_t v : {edge.first, edge.second}) corners[root(v)].push_back(joined.points[v]);
    std::map<std::uint32_t, std::uint32_t> apexes;
    for (const auto& [hole, at] : corners) {
        glm::dvec3 middle(0);
        for (const glm::dvec3& p : at) middle += p / static_cast<double>(at.size());
        apexes[hole] = static_cast<std::uint32_t>(meant.vertices.size());
        meant.vertices.push_back(middle);
        made.holes.emplace_back(at);
    }
    for (const auto& [edge, times] : balance)
        for (int n = 0; n < std::abs(times); ++n) {
            const auto [from, to] = times > 0 ? std::pair(edge.second, edge.first) : edge;
            meant.triangles.push_back({from, to, apexes[root(from)]});
        }
    made.meant = std::move(meant);
    return made;
}

/// Plants defects into closed meshes of about the size 1.
class PlantedDefects {
  public:
    explicit PlantedDefects(Random& rng) : rng_(rng) {}

    /// Every defect, in a mesh of its own, and all of them in one mesh.
    std::vector<DefectiveMesh> all(const std::string& name, const TriangleMesh& base) {
        std::vector<DefectiveMesh> made;
        const auto add = [&](const char* defect, auto&& plant) {
            DefectiveMesh mesh{.name = name + ", " + defect, .file = base, .meant = base};
            plant(mesh);
            made.push_back(std::move(mesh));
        };
        add("crossing itself", [&](DefectiveMesh& m) { cross(m); });
        add("overlapping parts", [&](DefectiveMesh& m) { overlap(m, base); });
        add("nested parts", [&](DefectiveMesh& m) { nest(m, base); });
        add("parts in contact", [&](DefectiveMesh& m) { touch(m, base); });
        add("duplicate triangles", [&](DefectiveMesh& m) { duplicate(m); });
        add("triangles without area", [&](DefectiveMesh& m) { flatten(m); });
        add("T-junctions", [&](DefectiveMesh& m) { split(m); });
        add("small holes", [&](DefectiveMesh& m) { pierce(m); });
        add("edges with many triangles", [&](DefectiveMesh& m) { branch(m); });
        add("triangles and parts inside out", [&](DefectiveMesh& m) { turn(m, base); });
        add("all at once", [&](DefectiveMesh& m) {
            overlap(m, base), nest(m, base), duplicate(m), flatten(m), split(m), turn(m, base);
        });
        for (const char* rule : {"even_odd", "non_zero"})
            add(rule, [&](DefectiveMesh& m) {
                overlap(m, base);
                m.rule = rule;
            });
        return made;
    }

  private:
    std::size_t any(const TriangleMesh& mesh) {
        return static_cast<std::size_t>(rng_.below(static_cast<int>(mesh.triangles.size())));
    }
    static void append_both(DefectiveMesh& m, const TriangleMesh& part, const glm::vec3& offset, float scale = 1) {
        append(m.file, part, offset, scale);
        append(m.meant, part, offset, scale);
    }
    // Vertices move through the opposite side, so that the surface crosses itself.
    void cross(DefectiveMesh& m) {
        for (int k = 0; k < 8; ++k) {
            const auto v = static_cast<std::size_t>(rng_.below(static_cast<int>(m.file.vertices.size())));
            m.file.vertices[v] += rng_.uniform(0.5f, 2) * rng_.direction();
        }
        m.meant = m.file;
    }
    void overlap(DefectiveMesh& m, const TriangleMesh& base) {
        for (int k = 0; k < 2; ++k)
            append_both(m, base, rng_.uniform(0.1f, 0.6f) * rng_.direction(), rng_.uniform(0.7f, 1.2f));
    }
    void nest(DefectiveMesh& m, const TriangleMesh& base) {
        append_both(m, base, 0.05f * rng_.direction(), 0.6f);
        append_both(m, octahedron_mesh(), glm::vec3(0), 3);
    }
    // Cubes that share faces, edges and corners, and a part once more.
    void touch(DefectiveMesh& m, const TriangleMesh& base) {
        append_both(m, base, glm::vec3(0));
        const TriangleMesh cube{
            {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}},
            {{0, 2, 3},
             {0, 3, 1},
             {4, 5, 7},
             {4, 7, 6},
             {0, 1, 5},
             {0, 5, 4},
             {2, 6, 7},
             {2, 7, 3},
             {0, 4, 6},
             {0, 6, 2},
             {1, 3, 7},
             {1, 7, 5}}};
        for (const glm::vec3& at : {glm::vec3(0), {1, 0, 0}, {1, 1, 0}, {2, 1, 1}, {0.5f, 0.25f, 1}})
            append_both(m, cube, 0.5f * at + glm::vec3(0.25f), 0.5f);
    }
    void duplicate(DefectiveMesh& m) {
        for (int k = 0; k < 40; ++k) {
            glm::uvec3 t = m.file.triangles[any(m.file)];
            if (k % 2 == 0) t = {t.y, t.z, t.x};
            m.file.triangles.push_back(t);
        }
    }
    void flatten(DefectiveMesh& m) {
        for (int k = 0; k < 20; ++k) {
            const glm::uvec3 t = m.file.triangles[any(m.file)];
            m.file.triangles.push_back({t.x, t.x, t.y});
            // Two triangles instead of one, and a third without area beside them.
            const std::size_t i = any(m.file);
            const glm::uvec3 u = m.file.triangles[i];
            const auto middle = static_cast<std::uint32_t>(m.file.vertices.size());
            m.file.vertices.push_back(0.5f * (m.file.vertices[u.x] + m.file.vertices[u.y]));
            m.file.triangles[i] = {u.x, middle, u.z};
            m.file.triangles.push_back({middle, u.y, u.z});
            m.file.triangles.push_back({u.x, u.y, middle});
        }
    }
    void split(DefectiveMesh& m) {
        for (int k = 0; k < 20; ++k) {
            const std::size_t i = any(m.file);
            const glm::uvec3 u = m.file.triangles[i];
            if (u.x == u.y || u.y == u.z || u.z == u.x) continue;
            const auto middle = static_cast<std::uint32_t>(m.file.vertices.size());
            m.file.vertices.push_back(glm::mix(m.file.vertices[u.x], m.file.vertices[u.y], rng_.uniform(0.2f, 0.8f)));
            m.file.triangles[i] = {u.x, middle, u.z};
            m.file.triangles.push_back({middle, u.y, u.z});
        }
    }
    // Single triangles, and all triangles around a vertex.
    void pierce(DefectiveMesh& m) {
        std::vector<char> is_hole(m.file.triangles.size(), 0), is_taken(m.file.vertices.size(), 0);
        for (int k = 0; k < 12; ++k) {
            const glm::uvec3 t = m.file.triangles[any(m.file)];
            if (is_taken[t.x] || is_taken[t.y] || is_taken[t.z]) continue;
            for (std::size_t i = 0; i < is_hole.size(); ++i) {
                const glm::uvec3 u = m.file.triangles[i];
                const bool is_removed = k % 2 == 0 ? u == t : u.x == t.x || u.y == t.x || u.z == t.x;
                if (!is_removed || is_taken[u.x] || is_taken[u.y] || is_taken[u.z]) continue;
                is_hole[i] = 1;
            }
            for (std::size_t i = 0; i < is_hole.size(); ++i)
                if (is_hole[i])
                    for (int c = 0; c < 3; ++c) is_taken[m.file.triangles[i][c]] = 1;
        }
        std::vector<glm::uvec3> kept;
        for (std::size_t i = 0; i < is_hole.size(); ++i)
            if (!is_hole[i]) kept.push_back(m.file.triangles[i]);
        m.file.triangles = std::move(kept);
        DefectiveMesh closed = with_closed_holes(m.name, m.file);
        m.meant = std::move(closed.meant);
        m.holes = std::move(closed.holes);
    }
    // Tetrahedra on triangles, with the triangle between them and the solid, and tetrahedra at edges.
    void branch(DefectiveMesh& m) {
        const std::size_t triangles = m.file.triangles.size();
        for (int k = 0; k < 20; ++k) {
            const glm::uvec3 t = m.file.triangles[static_cast<std::size_t>(rng_.below(static_cast<int>(triangles)))];
            const glm::vec3 a = m.file.vertices[t.x], b = m.file.vertices[t.y], c = m.file.vertices[t.z];
            const glm::vec3 out = glm::normalize(glm::cross(b - a, c - a)) * glm::length(b - a);
            const auto apex = static_cast<std::uint32_t>(m.file.vertices.size());
            m.file.vertices.push_back((a + b + c) / 3.f + out);
            std::uint32_t third = t.z;
            if (k % 2 == 1) {
                third = apex + 1;
                m.file.vertices.push_back(0.5f * (a + b) + out - 0.3f * (c - a));
            }
            for (const glm::uvec3& side :
                 {glm::uvec3(t.x, third, t.y), {t.x, t.y, apex}, {t.y, third, apex}, {third, t.x, apex}})
                m.file.triangles.push_back(side);
        }
        m.meant = m.file;
    }
    void turn(DefectiveMesh& m, const TriangleMesh& base) {
        for (int k = 0; k < 15; ++k) {
            glm::uvec3& t = m.file.triangles[any(m.file)];
            std::swap(t.x, t.y);
        }
        append(m.file, base, {2.5f, 0.25f, 0.5f}, 0.7f, true);
        append(m.meant, base, {2.5f, 0.25f, 0.5f}, 0.7f);
    }

    Random& rng_;
};

}  // namespace phasetree::tests
