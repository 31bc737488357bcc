#include "meshing/separation.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "meshing/crossing_nearby.hpp"
#include "meshing/quad_contacts.hpp"
#include "meshing/regular_points.hpp"

namespace phasetree::meshing {

namespace {

// Triangles count as touching if they are closer than this, in units of the last place of the farthest coordinate. The
// margin ensures that scaling and rounding of coordinates does not make them cross.
constexpr double touching_digits = 2;
// If the spacing is only a few of these units, a smaller distance is used: this fraction of the spacing.
constexpr double most_touching = 1.0 / 64;

// How far new vertices and those that are moved stay away from sides and edges, in cubes.
constexpr double from_border = 1.0 / 64;

double within_border(double x) {
    return std::clamp(x, from_border, 1 - from_border);
}

/// A side of a cube at its low end along an axis.
struct LowSide {
    glm::ivec3 cube;
    int axis;

    int number() const { return 4 - 2 * axis; }  // in the order of sides_of_cube
};

class Separation {
  public:
    Separation(const CutGrid& cut, QuadMesh& mesh, const std::function<void()>& cancelled)
        : cut_(cut), mesh_(mesh), cancelled_(cancelled), placements_(mesh.vertices.size(), Placement::free) {}

    void run(const std::function<void()>& advance) {
        const Grid& grid = cut_.grid;
        const double tolerance = std::min(touching_digits * grid.digit, most_touching * grid.spacing);
        std::vector<std::uint32_t> changed(mesh_.quads.size());
        std::iota(changed.begin(), changed.end(), 0u);
        const std::function<void()> begin_first = [&] {
            cancelled_();
            advance();
        };
        for (bool is_first = true; !changed.empty(); is_first = false) {
            tbb::parallel_for(std::size_t{0}, changed.size(), [&](std::size_t i) {
                if (i % 4096 == 0) cancelled_();
                choose_diagonal(mesh_.quads[changed[i]]);
            });
            for (const std::uint32_t quad : changed) split(quad);
            const std::function<void()>& begin_layer = is_first ? begin_first : cancelled_;
            changed = raise(vertices_in_contact(grid, mesh_, changed, tolerance, begin_layer));
            if (changed.empty()) changed = raise_turned_over();
        }
    }

  private:
    glm::dvec3 in_cube(const glm::ivec3& cube, std::uint32_t vertex) const {
        return (glm::dvec3(mesh_.vertices[vertex]) - cut_.grid.place(cube)) / cut_.grid.spacing;
    }
    void put(std::uint32_t vertex, const glm::ivec3& cube, const glm::dvec3& at) {
        mesh_.vertices[vertex] = glm::vec3(cut_.grid.place(cube) + cut_.grid.spacing * at);
    }
    std::optional<GridCrossing> crossing_of(const Quad& q) const {
        return cut_.crossings[q.axis].shown_on_edge(q.point);
    }
    static glm::ivec3 unit(int axis) {
        glm::ivec3 u(0);
        u[axis] = 1;
        return u;
    }

    // For each contact, raises the placement of the vertices with the lowest placement by one step. So a vertex that is
    // already higher is not raised because of its neighbours. Returns the quadrilaterals that change, in ascending
    // order.
    std::vector<std::uint32_t> raise(const std::vector<VerticesInContact>& contacts) {
        std::vector<char> is_raised(placements_.size(), 0);
        const auto placement = [&](std::uint32_t v) {
            return v < placements_.size() ? placements_[v] : Placement::regular;
        };
        for (const VerticesInContact& contact : contacts) {
            Placement lowest = Placement::regular;
            for (const std::uint32_t v : contact) lowest = std::min(lowest, placement(v));
            if (lowest == Placement::regular) continue;
            for (const std::uint32_t v : contact)
                if (placement(v) == lowest) is_raised[v] = 1;
        }
        return raise(is_raised);
    }
    std::vector<std::uint32_t> raise(const std::vector<char>& is_raised) {
        bool is_any = false;
        for (std::uint32_t v = 0; v < placements_.size(); ++v) {
            if (is_raised[v] == 0) continue;
            placements_[v] = static_cast<Placement>(static_cast<int>(placements_[v]) + 1);
            move(v);
            is_any = true;
        }
        std::vector<std::uint32_t> changed;
        if (!is_any) return changed;
        for (std::uint32_t i = 0; i < mesh_.quads.size(); ++i)
            if (std::ranges::any_of(mesh_.quads[i].corners, [&](std::uint32_t v) { return is_raised[v] != 0; }))
                changed.push_back(i);
        return changed;
    }
    // Free vertices may lie outside their cubes. So a part of a phase that is smaller than the spacing can turn inside
    // out: its triangles do not cross, but face inward. The sign of the part's volume then differs from the sign with
    // all vertices in the centres of their cubes. Moving its vertices into their cubes turns the part back.
    std::vector<std::uint32_t> raise_turned_over() {
        std::vector<char> is_raised(placements_.size(), 0);
        std::vector<std::uint32_t> parent(placements_.size());
        const auto root = [&](std::uint32_t v) {
            while (parent[v] != v) v = parent[v] = parent[parent[v]];
            return v;
        };
        struct Volumes {
            double own = 0, in_centres = 0;
        };
        std::vector<Volumes> volumes(placements_.size());
        PhaseSet phases;
        for (const Quad& q : mesh_.quads)
            for (const Phase p : phases_of(q)) phases = phases | PhaseSet::of(p);
        for_each_phase(phases.bits, [&](int i) {
            const Phase phase{static_cast<std::uint8_t>(i)};
            std::iota(parent.begin(), parent.end(), 0u);
            std::ranges::fill(volumes, Volumes());
            for (const Quad& q : mesh_.quads)
                for (const Phase p : phases_of(q))
                    if (p == phase)
                        for (const std::uint32_t v : q.corners) parent[root(v)] = root(q.corners[0]);
            for (std::uint32_t n = 0; n < mesh_.quads.size(); ++n) {
                const Quad& q = mesh_.quads[n];
                const auto [front, behind] = phases_of(q);
                if (front != phase && behind != phase) continue;
                const double sign = behind == phase ? 1 : -1;
                Volumes& of_part = volumes[root(q.corners[0])];
                const glm::dvec3 origin(mesh_.vertices[root(q.corners[0])]);
                mesh_.for_each_triangle(n, [&](const std::array<std::uint32_t, 3>& t) {
                    const auto at = [&](std::size_t k) { return glm::dvec3(mesh_.vertices[t[k]]) - origin; };
                    of_part.own += sign * glm::dot(at(0), glm::cross(at(1), at(2)));
                });
                if (q.axis == 0) of_part.in_centres += sign * (q.is_turned ? -1 : 1) * (q.point.x + 0.5);
            }
            for (const Quad& q : mesh_.quads) {
                const auto [front, behind] = phases_of(q);
                const Volumes& of_part = volumes[root(q.corners[0])];
                if ((front != phase && behind != phase) || of_part.own * of_part.in_centres >= 0) continue;
                for (const std::uint32_t v : q.corners)
                    if (placements_[v] == Placement::free) is_raised[v] = 1;
            }
        });
        return raise(is_raised);
    }
    // The phases in front of a quad and behind it.
    std::array<Phase, 2> phases_of(const Quad& q) const {
        const Phase first = cut_.labels[cut_.grid.index(q.point)],
                    second = cut_.labels[cut_.grid.index(q.point + unit(q.axis))];
        return q.is_turned ? std::array{first, second} : std::array{second, first};
    }
    void move(std::uint32_t vertex) {
        const auto [cube, patch] = cut_.cubes.place_of(vertex);
        if (placements_[vertex] == Placement::inside) {
            glm::dvec3 at = in_cube(cube, vertex);
            if (glm::clamp(at, 0.0, 1.0) == at) return;
            for (int i = 0; i < 3; ++i)
                if (at[i] < 0 || at[i] > 1) at[i] = within_border(at[i]);
            put(vertex, cube, on_interface(cube, at, -1));
        } else if (placements_[vertex] == Placement::regular) {
            const CubeLabels labels = cut_.joined.labels_of(cut_.labels, cube);
            put(vertex, cube, regular_vertex(CubePatches(labels), labels, patch));
        }
    }

    // Adds the vertices of a quadrilateral that its corners' placements require.
    void split(std::uint32_t number) {
        const Quad q = mesh_.quads[number];
        Placement highest = Placement::free;
        for (const std::uint32_t v : q.corners) highest = std::max(highest, placements_[v]);
        if (highest < Placement::split_edges) return;
        glm::dvec3 at(0);
        at[q.axis] = highest < Placement::regular ? position_on_edge(q.axis, q.point) : 0.5;
        put(mesh_.centre(number), q.point, at);
        // The sides of the grid between the cubes of neighbouring corners.
        const int u = (q.axis + 1) % 3, v = (q.axis + 2) % 3;
        const LowSide sides[] = {{q.point - unit(v), u}, {q.point, v}, {q.point, u}, {q.point - unit(u), v}};
        for (std::size_t i = 0; i < 4; ++i) {
            const std::uint32_t a = q.corners[i], b = q.corners[(i + 1) % 4];
            const Placement p = std::max(placements_[a], placements_[b]);
            if (p < Placement::split_sides) continue;
            const int edge = edge_number(q.axis, q.point - sides[i].cube);
            put(mesh_.divider(a, b), sides[i].cube, on_side(sides[i], edge, p == Placement::regular));
        }
    }
    // The point where the interface crosses an edge of the grid, moved away from the edge's ends if necessary.
    double position_on_edge(int axis, const glm::ivec3& point) const {
        const auto c = cut_.crossings[static_cast<std::size_t>(axis)].shown_on_edge(point);
        return c ? within_border(static_cast<double>(c->at) - point[axis]) : 0.5;
    }
    // A point of a side between two cubes: on an interface near the mean of where interfaces cross its edges, or a
    // regular one.
    glm::dvec3 on_side(const LowSide& side, int edge, bool is_regular) const {
        const CubeLabels labels = cut_.joined.labels_of(cut_.labels, side.cube);
        const SideCut cut = cut_of_side(labels, side.number(), edge);
        if (is_regular) return cut.regular_point(side.number());
        glm::dvec3 sum(0);
        int count = 0;
        for (int i = 0; i < 4; ++i) {
            const int a = sides_of_cube[side.number()][i], b = sides_of_cube[side.number()][(i + 1) % 4];
            if (labels.at(a) == labels.at(b) || (cut.is_wall && a != cut.corner && b != cut.corner)) continue;
            const CubeEdge e = edge_of_cube(edge_between(a, b));
            glm::dvec3 at(e.start);
            at[e.axis] = position_on_edge(e.axis, side.cube + e.start);
            sum += at;
            ++count;
        }
        glm::dvec3 at = sum / static_cast<double>(count);
        for (int i = 0; i < 3; ++i) at[i] = i == side.axis ? 0 : within_border(at[i]);
        at = on_interface(side.cube, at, side.axis);
        return cut.is_wall ? kept_at_corner(at, cut) : at;
    }
    // Moves a point of a cube along one of the axes other than `fixed_axis` to the nearest interface, if there is one
    // within the borders.
    glm::dvec3 on_interface(const glm::ivec3& cube, const glm::dvec3& at, int fixed_axis) const {
        const glm::dvec3 place = cut_.grid.place(cube) + cut_.grid.spacing * at;
        double nearest = 1;
        glm::dvec3 found = at;
        for (int axis = 0; axis < 3; ++axis) {
            if (axis == fixed_axis) continue;
            const double low = std::max(from_border - at[axis], -nearest);
            const double high = std::min(1 - from_border - at[axis], nearest);
            if (const auto way = crossing_nearby(cut_.grid, cut_.lines, place, axis, low, high)) {
                nearest = std::abs(*way);
                found = at + *way * glm::dvec3(unit(axis));
            }
        }
        return found;
    }
    // Beside a wall, the points of both cuts must be on the right side of the diagonal between them.
    static glm::dvec3 kept_at_corner(const glm::dvec3& at, const SideCut& cut) {
        constexpr double most = 1 - from_border;
        const glm::dvec3 corner(offset_of_corner(cut.corner));
        const glm::dvec3 away = at - corner;
        const double sum = std::abs(away.x) + std::abs(away.y) + std::abs(away.z);
        return sum > most ? corner + most / sum * away : at;
    }

    // The diagonal starts at corner 0 or corner 1, whichever gives the smaller maximum deviation of a triangle from the
    // interface's normal.
    void choose_diagonal(Quad& q) const {
        const auto c = crossing_of(q);
        const glm::dvec3 normal = c ? glm::dvec3(c->normal) : glm::dvec3(unit(q.axis));
        const auto at = [&](int i) { return glm::dvec3(mesh_.vertices[q.corners[static_cast<std::size_t>(i % 4)]]); };
        const auto likeness = [&](int d, int e, int f) {
            const glm::dvec3 n = glm::cross(at(e) - at(d), at(f) - at(d));
            const double length = glm::length(n);
            return length > 0 ? glm::dot(n, normal) / length : -1.0;
        };
        const auto least_likeness = [&](int d) {
            return std::min(likeness(d, d + 1, d + 2), likeness(d, d + 2, d + 3));
        };
        q.diagonal = least_likeness(1) > least_likeness(0) ? 1 : 0;
    }

    const CutGrid& cut_;
    QuadMesh& mesh_;
    const std::function<void()>& cancelled_;
    std::vector<Placement> placements_;  // for each vertex of a cube
};

}  // namespace

void separate(const CutGrid& cut, QuadMesh& mesh, const std::function<void()>& cancelled,
              const std::function<void()>& advance) {
    Separation(cut, mesh, cancelled).run(advance);
}

}  // namespace phasetree::meshing
