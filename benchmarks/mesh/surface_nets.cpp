#include "mesh/surface_nets.hpp"

#include <tbb/parallel_for.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace phasetree::bench {

namespace {

// Points of the grid; cubes are between them.
struct Grid {
    glm::vec3 origin{0};
    float step = 1;
    glm::ivec3 points{0};

    Grid(const Bounds& box, int cubes) {
        const glm::vec3 extent = box.extent();
        step = std::max({extent.x, extent.y, extent.z}) / static_cast<float>(cubes);
        // One cube of vacuum about the object, and no plane of the grid where a scene's planes like to be.
        origin = box.low - 1.3819660f * step;
        for (int a = 0; a < 3; ++a) points[a] = static_cast<int>(std::ceil(extent[a] / step)) + 4;
    }
};

// Where the grid's lines along one axis cross the surface, in units of the step from the line's first point. Line (u,
// v) is at u of the next axis and v of the one after it.
struct Lines {
    int axis = 0;
    int width = 0;
    std::vector<std::vector<float>> crossings;

    const std::vector<float>& at(int u, int v) const { return crossings[static_cast<std::size_t>(v * width + u)]; }
};

std::vector<float> crossings_along(const FieldScene& scene, Ray ray, float step) {
    std::vector<float> found;
    const glm::vec3 start = ray.origin;
    while (const auto crossing = scene.intersect(ray)) {
        found.push_back(0.5f * glm::dot(crossing->p_from + crossing->p_to - 2.f * start, ray.direction) / step);
        ray.origin = crossing->p_to;
        ray.carried = crossing->to;
        if (found.size() > 100'000) throw std::runtime_error("a line of the grid runs along the surface");
    }
    return found;
}

Lines trace_lines(const FieldScene& scene, const Grid& grid, int axis) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    Lines lines{axis, grid.points[next], {}};
    lines.crossings.resize(static_cast<std::size_t>(grid.points[next]) * static_cast<std::size_t>(grid.points[last]));
    tbb::parallel_for(0, grid.points[last], [&](int v) {
        const FlushSubnormals flush;
        for (int u = 0; u < grid.points[next]; ++u) {
            Ray ray{grid.origin, glm::vec3(0), vacuum};
            ray.origin[next] += grid.step * static_cast<float>(u);
            ray.origin[last] += grid.step * static_cast<float>(v);
            ray.direction[axis] = 1;
            lines.crossings[static_cast<std::size_t>(v * lines.width + u)] = crossings_along(scene, ray, grid.step);
        }
    });
    return lines;
}

// Which points are inside, a bit each, in rows along x.
class Inside {
  public:
    Inside(const Grid& grid, const Lines& along_x) : points_(grid.points), words_((grid.points.x + 63) / 64) {
        bits_.resize(static_cast<std::size_t>(words_) * static_cast<std::size_t>(points_.y) *
                     static_cast<std::size_t>(points_.z));
        for (int z = 0; z < points_.z; ++z) {
            for (int y = 0; y < points_.y; ++y) {
                const std::vector<float>& crossings = along_x.at(y, z);
                std::size_t passed = 0;
                std::uint64_t* const row = this->row(y, z);
                for (int x = 0; x < points_.x && (passed < crossings.size() || passed % 2 == 1); ++x) {
                    while (passed < crossings.size() && crossings[passed] < static_cast<float>(x)) ++passed;
                    if (passed % 2 == 1) row[x / 64] |= std::uint64_t{1} << (x % 64);
                }
            }
        }
    }
    int words() const { return words_; }
    const std::uint64_t* row(int y, int z) const { return bits_.data() + (z * points_.y + y) * std::ptrdiff_t{words_}; }
    bool at(int x, int y, int z) const { return (row(y, z)[x / 64] >> (x % 64)) & 1; }

  private:
    std::uint64_t* row(int y, int z) { return bits_.data() + (z * points_.y + y) * std::ptrdiff_t{words_}; }

    glm::ivec3 points_;
    int words_;
    std::vector<std::uint64_t> bits_;
};

class Net {
  public:
    explicit Net(const Grid& grid) : grid_(grid) {
        for (auto& layer : layer_)
            layer.assign(static_cast<std::size_t>(grid.points.x) * static_cast<std::size_t>(grid.points.y), none);
    }
    // Cubes of layer z − 1 are complete.
    void next_layer() {
        std::swap(layer_[0], layer_[1]);
        std::fill(layer_[1].begin(), layer_[1].end(), none);
    }
    // The edge from point p along `axis`, crossed at `along` of its length; `out` if the surface faces along the axis.
    // It touches the cubes (−1, −1) … (0, 0) around it, in the plane perpendicular to the axis. z: the current layer.
    void edge(const glm::ivec3& p, int axis, float along, bool out) {
        glm::vec3 at(p);
        at[axis] += along;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::array<std::uint32_t, 4> quad{};
        constexpr int around[4][2] = {{-1, -1}, {0, -1}, {0, 0}, {-1, 0}};  // counter-clockwise seen along −axis
        for (std::size_t i = 0; i < 4; ++i) {
            glm::ivec3 cube = p;
            cube[u] += around[i][0];
            cube[v] += around[i][1];
            quad[i] = vertex(cube, cube.z == p.z ? 1 : 0);
            sums_[quad[i]] += at;
            ++counts_[quad[i]];
        }
        if (!out) std::swap(quad[1], quad[3]);
        quads_.push_back(quad);
    }
    Triangles triangles() const {
        Triangles mesh;
        for (std::size_t i = 0; i < sums_.size(); ++i)
            mesh.vertices.push_back(grid_.origin + sums_[i] * (grid_.step / static_cast<float>(counts_[i])));
        const auto apart = [&](std::uint32_t a, std::uint32_t b) {
            return glm::distance(mesh.vertices[a], mesh.vertices[b]);
        };
        for (const auto& q : quads_) {
            if (apart(q[0], q[2]) <= apart(q[1], q[3])) {
                mesh.triangles.push_back({q[0], q[1], q[2]});
                mesh.triangles.push_back({q[0], q[2], q[3]});
            } else {
                mesh.triangles.push_back({q[0], q[1], q[3]});
                mesh.triangles.push_back({q[1], q[2], q[3]});
            }
        }
        return mesh;
    }

  private:
    static constexpr std::uint32_t none = ~0u;

    std::uint32_t vertex(const glm::ivec3& cube, std::size_t layer) {
        std::uint32_t& index = layer_[layer][static_cast<std::size_t>(cube.y * grid_.points.x + cube.x)];
        if (index == none) {
            index = static_cast<std::uint32_t>(sums_.size());
            sums_.emplace_back(0);
            counts_.push_back(0);
        }
        return index;
    }

    const Grid& grid_;
    std::array<std::vector<std::uint32_t>, 2> layer_;  // of cubes below and above the points of the current z
    std::vector<glm::vec3> sums_;                      // of crossings, in steps
    std::vector<std::uint32_t> counts_;
    std::vector<std::array<std::uint32_t, 4>> quads_;
};

// Where on the edge from k to k + 1 the line crosses. The lines of two axes can disagree about a point within their
// resolution of the surface; then there is no crossing on this edge, but one at its end.
float crossing_on(const std::vector<float>& crossings, int k) {
    const float edge = static_cast<float>(k);
    float nearest = edge + 0.5f, distance = 1e30f;
    for (const float c : crossings) {
        const float d = std::max({edge - c, c - edge - 1, 0.f});
        if (d < distance) {
            distance = d;
            nearest = c;
        }
    }
    return std::clamp(nearest - edge, 0.f, 1.f);
}

}  // namespace

Triangles surface_nets(const FieldScene& scene, int cubes) {
    const Grid grid(scene.cells().bounds(), cubes);
    const std::array<Lines, 3> lines{trace_lines(scene, grid, 0), trace_lines(scene, grid, 1),
                                     trace_lines(scene, grid, 2)};
    const Inside inside(grid, lines[0]);
    Net net(grid);
    // Calls f(x) for each bit that differs between two rows.
    const auto differing = [&](const std::uint64_t* a, const std::uint64_t* b, auto&& f) {
        for (int w = 0; w < inside.words(); ++w)
            for (std::uint64_t bits = a[w] ^ b[w]; bits != 0; bits &= bits - 1) f(w * 64 + std::countr_zero(bits));
    };
    for (int z = 0; z + 1 < grid.points.z; ++z) {
        net.next_layer();
        for (int y = 0; y + 1 < grid.points.y; ++y) {
            const std::uint64_t* const row = inside.row(y, z);
            const std::vector<float>& along_x = lines[0].at(y, z);
            int last = -1;
            for (const float c : along_x) {
                const int x = static_cast<int>(std::floor(c));
                if (x == last || x < 0 || x + 1 >= grid.points.x || inside.at(x, y, z) == inside.at(x + 1, y, z))
                    continue;
                last = x;
                net.edge({x, y, z}, 0, crossing_on(along_x, x), inside.at(x, y, z));
            }
            differing(row, inside.row(y + 1, z), [&](int x) {
                net.edge({x, y, z}, 1, crossing_on(lines[1].at(z, x), y), inside.at(x, y, z));
            });
            differing(row, inside.row(y, z + 1), [&](int x) {
                net.edge({x, y, z}, 2, crossing_on(lines[2].at(x, y), z), inside.at(x, y, z));
            });
        }
    }
    return net.triangles();
}

}  // namespace phasetree::bench
