#include "meshing/quad_contacts.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "meshing/triangle_contact.hpp"

namespace phasetree::meshing {

namespace {

constexpr std::size_t in_chunk = 4096;

/// The cubes that a box touches.
struct CubeRange {
    glm::ivec3 low{0}, high{0};

    template <class F>
    void for_each(F&& f) const {
        for (int k = low.z; k <= high.z; ++k)
            for (int j = low.y; j <= high.y; ++j)
                for (int i = low.x; i <= high.x; ++i) f(glm::ivec3(i, j, k));
    }
};

/// Cubes of the grid, of which some are marked.
class MarkedCubes {
  public:
    explicit MarkedCubes(const Grid& grid) : grid_(grid), bits_(grid.size() / 64 + 1, 0) {}
    void mark(const CubeRange& range) {
        range.for_each([&](const glm::ivec3& cube) { bits_[grid_.index(cube) / 64] |= bit(cube); });
    }
    bool is_any_marked(const CubeRange& range) const {
        bool is_marked = false;
        range.for_each(
            [&](const glm::ivec3& cube) { is_marked = is_marked || (bits_[grid_.index(cube) / 64] & bit(cube)) != 0; });
        return is_marked;
    }

  private:
    std::uint64_t bit(const glm::ivec3& cube) const { return std::uint64_t{1} << grid_.index(cube) % 64; }

    const Grid& grid_;
    std::vector<std::uint64_t> bits_;
};

class Search {
  public:
    Search(const Grid& grid, const QuadMesh& mesh, double tolerance, const std::function<void()>& begin_layer)
        : grid_(grid),
          mesh_(mesh),
          tolerance_(tolerance),
          begin_layer_(begin_layer),
          is_changed_(mesh.quads.size(), 0) {}

    std::vector<VerticesInContact> run(std::span<const std::uint32_t> changed) {
        for (const std::uint32_t quad : changed) is_changed_[quad] = 1;
        if (changed.size() == mesh_.quads.size()) {
            near_.assign(changed.begin(), changed.end());
        } else {
            collect_near(changed);
        }
        list_by_layer();
        std::vector<std::vector<VerticesInContact>> found(static_cast<std::size_t>(grid_.points.z));
        tbb::parallel_for(0, grid_.points.z, [&](int k) {
            begin_layer_();
            examine_layer(k, found[static_cast<std::size_t>(k)]);
        });
        std::vector<VerticesInContact> all;
        for (const std::vector<VerticesInContact>& some : found) all.insert(all.end(), some.begin(), some.end());
        std::ranges::sort(all);
        return all;
    }

  private:
    /// A quadrilateral in a cube that its box touches, in one layer.
    struct Entry {
        std::uint32_t cube, quad;
        auto operator<=>(const Entry&) const = default;
    };
    struct BoxedTriangle {
        PlacedTriangle triangle;
        Bounds box;
    };
    struct BoxedQuad {
        std::uint32_t quad = 0;
        CubeRange cubes;
        Bounds box;
        std::vector<BoxedTriangle> triangles;
    };

    Bounds box_of(const std::array<std::uint32_t, 3>& triangle) const {
        Bounds box;
        for (const std::uint32_t v : triangle) box = unite(box, {mesh_.vertices[v], mesh_.vertices[v]});
        return box.inflated(static_cast<float>(tolerance_));
    }
    Bounds box_of(std::uint32_t quad) const {
        Bounds box;
        const auto add = [&](const std::array<std::uint32_t, 3>& t) { box = unite(box, box_of(t)); };
        mesh_.for_each_triangle(quad, add);
        return box;
    }
    CubeRange cubes_of(const Bounds& box) const {
        const auto cube_of = [&](const glm::vec3& p) {
            const glm::dvec3 at = glm::floor((glm::dvec3(p) - grid_.low) / grid_.spacing);
            return glm::clamp(glm::ivec3(at), glm::ivec3(0), grid_.points - 1);
        };
        return {cube_of(box.low), cube_of(box.high)};
    }

    // Changed quadrilaterals, and those whose boxes touch a cube that a changed one's box touches, in ascending order.
    void collect_near(std::span<const std::uint32_t> changed) {
        MarkedCubes marked(grid_);
        for (const std::uint32_t quad : changed) marked.mark(cubes_of(box_of(quad)));
        const std::size_t chunks = (mesh_.quads.size() + in_chunk - 1) / in_chunk;
        std::vector<std::vector<std::uint32_t>> found(chunks);
        tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
            const std::size_t end = std::min((chunk + 1) * in_chunk, mesh_.quads.size());
            for (std::size_t i = chunk * in_chunk; i < end; ++i) {
                const auto quad = static_cast<std::uint32_t>(i);
                if (marked.is_any_marked(cubes_of(box_of(quad)))) found[chunk].push_back(quad);
            }
        });
        for (const std::vector<std::uint32_t>& some : found) near_.insert(near_.end(), some.begin(), some.end());
    }

    // For each layer of cubes, the quadrilaterals that reach into it.
    void list_by_layer() {
        starts_.assign(static_cast<std::size_t>(grid_.points.z) + 1, 0);
        const auto layers_of = [&](std::uint32_t quad) {
            const CubeRange range = cubes_of(box_of(quad));
            return std::pair(static_cast<std::size_t>(range.low.z), static_cast<std::size_t>(range.high.z));
        };
        for (const std::uint32_t quad : near_) {
            const auto [low, high] = layers_of(quad);
            for (std::size_t k = low; k <= high; ++k) ++starts_[k + 1];
        }
        for (std::size_t k = 1; k < starts_.size(); ++k) starts_[k] += starts_[k - 1];
        in_layers_.resize(starts_.back());
        std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
        for (const std::uint32_t quad : near_) {
            const auto [low, high] = layers_of(quad);
            for (std::size_t k = low; k <= high; ++k) in_layers_[next[k]++] = quad;
        }
    }

    void examine_layer(int k, std::vector<VerticesInContact>& found) const {
        const std::size_t first = starts_[static_cast<std::size_t>(k)], last = starts_[static_cast<std::size_t>(k) + 1];
        std::vector<BoxedQuad> quads(last - first);
        std::vector<Entry> entries;
        for (std::size_t n = first; n < last; ++n) {
            BoxedQuad& q = quads[n - first];
            q.quad = in_layers_[n];
            q.box = box_of(q.quad);
            q.cubes = cubes_of(q.box);
            mesh_.for_each_triangle(q.quad, [&](const std::array<std::uint32_t, 3>& t) {
                const auto at = [&](std::size_t i) { return glm::dvec3(mesh_.vertices[t[i]]); };
                q.triangles.push_back({{t, {at(0), at(1), at(2)}}, box_of(t)});
            });
            for (int j = q.cubes.low.y; j <= q.cubes.high.y; ++j)
                for (int i = q.cubes.low.x; i <= q.cubes.high.x; ++i)
                    entries.push_back(
                        {static_cast<std::uint32_t>(j * grid_.points.x + i), static_cast<std::uint32_t>(n - first)});
        }
        std::ranges::sort(entries);
        TriangleContact contact(tolerance_);
        for (const BoxedQuad& q : quads)
            if (q.cubes.low.z == k && is_changed_[q.quad] != 0) examine(q, contact, found);
        for (std::size_t i = 0, next = 0; i < entries.size(); i = next) {
            while (next < entries.size() && entries[next].cube == entries[i].cube) ++next;
            const auto cube = static_cast<int>(entries[i].cube);
            const glm::ivec3 place(cube % grid_.points.x, cube / grid_.points.x, k);
            for (std::size_t one = i; one < next; ++one)
                for (std::size_t other = one + 1; other < next; ++other)
                    examine(quads[entries[one].quad], quads[entries[other].quad], place, contact, found);
        }
    }

    static void add(const PlacedTriangle& t, const PlacedTriangle& s, std::vector<VerticesInContact>& found) {
        const auto &a = t.vertices, &b = s.vertices;
        found.push_back({a[0], a[1], a[2], b[0], b[1], b[2]});
    }
    // The triangles of one quadrilateral.
    static void examine(const BoxedQuad& q, TriangleContact& contact, std::vector<VerticesInContact>& found) {
        for (std::size_t i = 0; i < q.triangles.size(); ++i) {
            const PlacedTriangle& t = q.triangles[i].triangle;
            if (contact.within(t)) add(t, t, found);
            for (std::size_t k = i + 1; k < q.triangles.size(); ++k) {
                const PlacedTriangle& s = q.triangles[k].triangle;
                if (!contact.between(t, s)) continue;
                add(t, s, found);
            }
        }
    }
    // The triangles of two quadrilaterals, but only in the first of the cubes that both boxes touch.
    void examine(const BoxedQuad& a, const BoxedQuad& b, const glm::ivec3& cube, TriangleContact& contact,
                 std::vector<VerticesInContact>& found) const {
        if (is_changed_[a.quad] == 0 && is_changed_[b.quad] == 0) return;
        if (glm::max(a.cubes.low, b.cubes.low) != cube || intersect(a.box, b.box).empty()) return;
        for (const BoxedTriangle& t : a.triangles) {
            if (intersect(t.box, b.box).empty()) continue;
            for (const BoxedTriangle& s : b.triangles) {
                if (intersect(t.box, s.box).empty() || !contact.between(t.triangle, s.triangle)) continue;
                add(t.triangle, s.triangle, found);
            }
        }
    }

    const Grid& grid_;
    const QuadMesh& mesh_;
    double tolerance_;
    const std::function<void()>& begin_layer_;
    std::vector<char> is_changed_;     // for each quadrilateral
    std::vector<std::uint32_t> near_;  // those that have to be examined
    std::vector<std::size_t> starts_;  // for each layer, where its part of in_layers_ begins
    std::vector<std::uint32_t> in_layers_;
};

}  // namespace

std::vector<VerticesInContact> vertices_in_contact(const Grid& grid, const QuadMesh& mesh,
                                                   std::span<const std::uint32_t> changed, double tolerance,
                                                   const std::function<void()>& begin_layer) {
    return Search(grid, mesh, tolerance, begin_layer).run(changed);
}

}  // namespace phasetree::meshing
