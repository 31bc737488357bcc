#include "phasetree/meshing/phase_mesh.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <mutex>
#include <numeric>

#include "meshing/active_cubes.hpp"
#include "meshing/crossing_nearby.hpp"
#include "meshing/cube_patches.hpp"
#include "meshing/joined_sides.hpp"
#include "meshing/label_grid.hpp"
#include "meshing/separation.hpp"
#include "meshing/vertex_in_cube.hpp"
#include "meshing/well_composed.hpp"

namespace phasetree {

namespace meshing {

namespace {

// The minimum of `apart` for vertex_in_cube; rounding far from the origin requires more.
constexpr double least_apart = 1e-3;

constexpr glm::ivec3 along[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// Reports the progress of the work over all of its stages.
class MeshProgress {
  public:
    explicit MeshProgress(const std::function<void(float)>& tell) : tell_(tell) {}

    /// Begins a stage of this many steps. At its end, the fraction `end` of all the work is done.
    void begin(std::size_t steps, float end) {
        start_ = end_;
        end_ = end;
        steps_ = steps;
        done_ = 0;
    }
    /// Records that this many more steps are done. Thread-safe.
    void advance(std::size_t steps = 1) {
        if (!tell_) return;
        const std::lock_guard lock(mutex_);
        done_ += steps;
        tell_(done_ == steps_ ? end_
                              : start_ + (end_ - start_) * static_cast<float>(done_) / static_cast<float>(steps_));
    }

  private:
    const std::function<void(float)>& tell_;
    std::mutex mutex_;
    float start_ = 0, end_ = 0;
    std::size_t steps_ = 0, done_ = 0;
};

class Mesher {
  public:
    Mesher(const Bounds& bounds, const LineTracer& lines, const MeshOptions& options)
        : lines_(lines),
          options_(options),
          progress_(options.progress),
          grid_(Grid::around(bounds, options.spacing)),
          crossings_{CrossingsAlong(grid_, 0), CrossingsAlong(grid_, 1), CrossingsAlong(grid_, 2)} {
        std::size_t count = 0;
        for (const CrossingsAlong& axis : crossings_) count += axis.lines();
        progress_.begin(count, 0.35f);
        for (CrossingsAlong& axis : crossings_)
            axis.trace(lines, [&](std::size_t more) {
                stop_if_cancelled();
                progress_.advance(more);
            });
    }

    PhaseMesh mesh() {
        PhaseMesh mesh;
        mesh.spacing = static_cast<float>(grid_.spacing);
        labels_ = labels_of(grid_, crossings_[0]);
        const auto stop = [&] { stop_if_cancelled(); };
        JoinedSides joined(grid_, lines_);
        joined.find_all(labels_, stop);
        make_well_composed(grid_, labels_, joined, stop);
        count_crossings(mesh);
        const auto layers_of_points = static_cast<std::size_t>(grid_.points.z);
        progress_.begin(layers_of_points - 1, 0.65f);
        const ActiveCubes cubes(grid_, labels_, joined);
        QuadMesh quads;
        quads.vertices.resize(cubes.vertices());
        tbb::parallel_for(0, grid_.points.z - 1, [&](int k) {
            stop_if_cancelled();
            cubes.for_each_in_layer(k, [&](const glm::ivec3& point, const ActiveCube& cube) {
                for (int patch = 0; patch < cube.patches.count(); ++patch)
                    quads.vertices[cube.vertex + static_cast<std::uint32_t>(patch)] =
                        glm::vec3(grid_.place(point) + grid_.spacing * vertex_of(point, cube.patches, patch));
            });
            progress_.advance();
        });
        progress_.begin(layers_of_points, 0.7f);
        add_quads(cubes, quads);
        progress_.begin(layers_of_points, 0.95f);
        separate({grid_, lines_, crossings_, labels_, joined, cubes}, quads, stop, [&] { progress_.advance(); });
        progress_.begin(1, 1);
        add_triangles(quads, mesh);
        mesh.vertices = std::move(quads.vertices);
        progress_.advance();
        return mesh;
    }

  private:
    void stop_if_cancelled() const {
        if (options_.cancelled && options_.cancelled()) throw MeshingCancelled();
    }
    Phase label(const glm::ivec3& point) const { return labels_[grid_.index(point)]; }

    // Calls f(axis, point) for each edge of the grid that leads from a point of a layer to the next point along an
    // axis.
    template <class F>
    void for_each_edge_of_layer(int k, F&& f) const {
        for (int axis = 0; axis < 3; ++axis) {
            const glm::ivec3 end = grid_.points - along[axis];
            if (k >= end.z) continue;
            for (int j = 0; j < end.y; ++j)
                for (int i = 0; i < end.x; ++i) f(axis, glm::ivec3(i, j, k));
        }
    }

    // An edge of the grid shows one of its crossings, if it has any and its ends have different labels; all others are
    // skipped.
    void count_crossings(PhaseMesh& mesh) const {
        for (const CrossingsAlong& axis : crossings_) mesh.crossings += axis.size();
        std::vector<std::size_t> shown(static_cast<std::size_t>(grid_.points.z), 0);
        tbb::parallel_for(0, grid_.points.z, [&](int k) {
            stop_if_cancelled();
            for_each_edge_of_layer(k, [&](int axis, const glm::ivec3& point) {
                if (label(point) == label(point + along[axis])) return;
                const bool has_crossing = !crossings_[static_cast<std::size_t>(axis)].of_edge(point).empty();
                shown[static_cast<std::size_t>(k)] += has_crossing ? 1 : 0;
            });
        });
        mesh.skipped = mesh.crossings - std::accumulate(shown.begin(), shown.end(), std::size_t{0});
    }

    glm::dvec3 vertex_of(const glm::ivec3& cube, const CubePatches& patches, int patch) const {
        std::array<PlaneInCube, 12> planes;
        std::size_t count = 0;
        glm::dvec3 sum(0);
        int edges = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
            for (int corner = 0; corner < 4; ++corner) {
                glm::ivec3 offset(0);
                offset[u] = corner & 1;
                offset[v] = corner >> 1;
                const glm::ivec3 point = cube + offset;
                const Phase first = label(point), second = label(point + along[axis]);
                if (first == second || patches.patch(edge_number(axis, offset)) != patch) continue;
                const auto c = crossings_[static_cast<std::size_t>(axis)].shown_on_edge(point);
                glm::dvec3 at(offset);
                at[axis] = c ? static_cast<double>(c->at) - point[axis] : 0.5;
                if (c) planes[count++] = {at, glm::dvec3(c->normal)};
                sum += at;
                ++edges;
            }
        }
        const glm::dvec3 mean = sum / static_cast<double>(edges);
        const double apart = std::max(least_apart, 4 * grid_.digit / grid_.spacing);
        glm::dvec3 vertex = mean;
        if (count > 0) vertex = vertex_in_cube(std::span(planes).first(count), mean, apart, patches.count() == 1);
        // Where labels were changed, planes are missing, and the vertex may be away from all interfaces.
        return static_cast<int>(count) < edges ? on_interface(cube, vertex, apart) : vertex;
    }

    // Moves a vertex to the nearest point where one of the axis-parallel lines through it meets an interface. If there
    // is none within two cubes, the vertex stays: farther away, the interface might belong to another part of the
    // object.
    glm::dvec3 on_interface(const glm::ivec3& cube, const glm::dvec3& vertex, double apart) const {
        const glm::dvec3 place = grid_.place(cube) + grid_.spacing * vertex;
        double nearest = 2;
        glm::dvec3 found = vertex;
        for (int axis = 0; axis < 3; ++axis)
            if (const auto at = crossing_nearby(grid_, lines_, place, axis, -nearest, nearest)) {
                nearest = std::abs(*at);
                found = vertex + (1 - apart) * *at * glm::dvec3(along[axis]);
            }
        return found;
    }

    // Adds a quadrilateral for each edge of the grid that lies between two phases.
    void add_quads(const ActiveCubes& cubes, QuadMesh& mesh) {
        std::vector<std::vector<Quad>> layers(static_cast<std::size_t>(grid_.points.z));
        tbb::parallel_for(0, grid_.points.z, [&](int k) {
            stop_if_cancelled();
            for_each_edge_of_layer(k, [&](int axis, const glm::ivec3& point) {
                const Phase first = label(point), second = label(point + along[axis]);
                if (first == second) return;
                const glm::ivec3 u = along[(axis + 1) % 3], v = along[(axis + 2) % 3];
                Quad q{.point = point, .axis = static_cast<std::uint8_t>(axis), .is_turned = first < second};
                const glm::ivec3 offsets[] = {u + v, v, glm::ivec3(0), u};
                for (std::size_t i = 0; i < 4; ++i)
                    q.corners[i] = cubes.vertex(point - offsets[i], edge_number(axis, offsets[i]));
                layers[static_cast<std::size_t>(k)].push_back(q);
            });
            progress_.advance();
        });
        std::size_t count = 0;
        for (const std::vector<Quad>& layer : layers) count += layer.size();
        mesh.quads.reserve(count);
        for (std::vector<Quad>& layer : layers) {
            mesh.quads.insert(mesh.quads.end(), layer.begin(), layer.end());
            layer = {};
        }
    }
    void add_triangles(const QuadMesh& quads, PhaseMesh& mesh) const {
        mesh.triangles.reserve(2 * quads.quads.size());
        for (std::uint32_t i = 0; i < quads.quads.size(); ++i) {
            const Quad& q = quads.quads[i];
            const Phase first = label(q.point), second = label(q.point + along[q.axis]);
            quads.for_each_triangle(i, [&](const std::array<std::uint32_t, 3>& t) {
                mesh.triangles.push_back({t, std::max(first, second), std::min(first, second)});
            });
        }
    }

    const LineTracer& lines_;
    const MeshOptions& options_;
    MeshProgress progress_;
    Grid grid_;
    std::array<CrossingsAlong, 3> crossings_;
    Labels labels_;
};

}  // namespace

}  // namespace meshing

PhaseSet PhaseMesh::phases() const {
    PhaseSet all;
    for (const Triangle& t : triangles) all = all | PhaseSet::of(t.behind) | PhaseSet::of(t.front);
    return all;
}

PhaseMesh mesh_of(const Bounds& bounds, const LineTracer& lines, const MeshOptions& options) {
    return meshing::Mesher(bounds, lines, options).mesh();
}

LineTracer line_tracer(const InterfaceTracer& tracer) {
    return [&tracer](const glm::vec3& origin, const glm::vec3& direction, float length,
                     std::vector<CrossingOnLine>& found) {
        Evaluator::Workspace& workspace = Evaluator::thread_workspace();
        Phase phase = vacuum;
        float from = 0;
        while (const auto c = tracer.first_crossing(origin, direction, from, length, phase, workspace)) {
            found.push_back({0.5f * (c->t_from + c->t_to), c->from, c->to, tracer.normal(*c, direction)});
            phase = c->to;
            from = c->t_to;
        }
    };
}

double ClosedMesh::volume() const {
    double six_times = 0;
    for (const auto& t : triangles)
        six_times +=
            glm::dot(glm::dvec3(vertices[t[0]]), glm::cross(glm::dvec3(vertices[t[1]]), glm::dvec3(vertices[t[2]])));
    return six_times / 6;
}

ClosedMesh surface_of(const PhaseMesh& mesh, PhaseSet phases) {
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> number(mesh.vertices.size(), none);
    ClosedMesh closed;
    for (const PhaseMesh::Triangle& t : mesh.triangles) {
        const bool has_behind = phases.contains(t.behind), has_front = phases.contains(t.front);
        if (has_behind == has_front) continue;
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            std::uint32_t& n = number[t.vertices[i]];
            if (n == none) {
                n = static_cast<std::uint32_t>(closed.vertices.size());
                closed.vertices.push_back(mesh.vertices[t.vertices[i]]);
                closed.in_mesh.push_back(t.vertices[i]);
            }
            corners[i] = n;
        }
        if (has_front) std::swap(corners[1], corners[2]);
        closed.triangles.push_back(corners);
    }
    return closed;
}

}  // namespace phasetree
