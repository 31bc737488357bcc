#include "phasetree/nodes/fields/mesh.hpp"

#include <fmt/format.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <utility>

#include "model/preparation.hpp"
#include "nodes/box_tree.hpp"
#include "nodes/mesh_repair/repair.hpp"
#include "nodes/mesh_surface.hpp"
#include "phasetree/math/portable.hpp"

namespace phasetree {

using mesh::Edge, mesh::Face, mesh::for_each_kind, mesh::PieceTree, mesh::SharedEdge, mesh::Surface, mesh::Vertex;

namespace {

constexpr std::uint32_t most_in_leaf = 4;

// The error of a product with a unit vector, relative to the length of the other factor.
constexpr double product_error = 0x1p-22;

// Limits on the cosine of half the angle between the normals of an edge's faces. Below the first, the directions of the
// edge's region are not limited. Below the second, the edge is bent, and they are limited to one side.
constexpr double least_cosine = 0x1p-6, most_cosine_of_bent_edges = 0.966;

void append(std::vector<float>& floats, const glm::dvec3& v) {
    for (int i = 0; i < 3; ++i) floats.push_back(static_cast<float>(v[i]));
}
glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : v;
}
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return portable::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// Builds the table of a mesh from its surface.
class TableWriter {
  public:
    // The wall's thickness is 0 for a solid.
    TableWriter(const Surface& s, const BoxTree& tree, float thickness)
        : s_(s), tree_(tree), half_thickness_(thickness / 2), index_(s.triangles.size()) {
        for (std::uint32_t i = 0; i < tree_.order.size(); ++i) index_[tree_.order[i]] = i;
    }

    std::vector<float> operator()() {
        prepare_vertices();
        prepare_edges();
        std::vector<float> table;
        table.reserve(mesh::PieceList::head + s_.triangles.size() * Face::floats + edges_.size() * Edge::floats +
                      vertices_.size() * Vertex::floats + 1 + tree_.nodes.size() * PieceTree::node_floats);
        for (const std::size_t count : {s_.triangles.size(), edges_.size(), vertices_.size()})
            table.push_back(static_cast<float>(count));
        const Bounds& box = tree_.nodes[0].box;
        append(table, box.centre());
        // The half extents reach the box's sides, however the centre was rounded.
        for (int i = 0; i < 3; ++i)
            table.push_back(std::max(box.high[i] - box.centre()[i], box.centre()[i] - box.low[i]));
        table.push_back(half_thickness_);
        for (const std::uint32_t t : tree_.order) append_face(t, table);
        for (const std::uint32_t e : edges_) append_edge(s_.edges[e], table);
        for (const std::uint32_t v : vertices_) append_vertex(v, table);
        append_nodes(table);
        append_corners(table);
        return table;
    }

  private:
    // An edge or a vertex belongs to the leaf of the first of its triangles.
    void prepare_vertices() {
        first_index_.assign(s_.vertices.size(), none);
        normal_.assign(s_.vertices.size(), glm::dvec3(0));
        largest_angle_.assign(s_.vertices.size(), 0);
        for (std::uint32_t t = 0; t < s_.triangles.size(); ++t)
            for (int i = 0; i < 3; ++i) {
                const std::uint32_t v = s_.triangles[t][i];
                if (first_index_[v] == none) vertices_.push_back(v);
                first_index_[v] = std::min(first_index_[v], index_[t]);
                const glm::dvec3 p = s_.at(v);
                normal_[v] +=
                    angle_between(s_.corner(t, (i + 1) % 3) - p, s_.corner(t, (i + 2) % 3) - p) * s_.normals[t];
            }
        for (glm::dvec3& n : normal_) n = unit(n);
        for (std::uint32_t t = 0; t < s_.triangles.size(); ++t)
            for (int i = 0; i < 3; ++i) {
                double& largest = largest_angle_[s_.triangles[t][i]];
                largest = std::max(largest, angle_between(normal_[s_.triangles[t][i]], s_.normals[t]));
            }
        for (const SharedEdge& e : s_.edges)
            if (e.is_rim())
                for (const std::uint32_t v : e.ends) largest_angle_[v] = std::numbers::pi;
        sort_by(vertices_, [&](std::uint32_t v) { return first_index_[v]; });
    }
    void prepare_edges() {
        edges_.resize(s_.edges.size());
        for (std::uint32_t e = 0; e < edges_.size(); ++e) edges_[e] = e;
        sort_by(edges_, [&](std::uint32_t e) { return first_index(s_.edges[e]); });
    }
    // Sorts numbers by their keys, and equal ones by themselves.
    template <class Key>
    static void sort_by(std::vector<std::uint32_t>& numbers, const Key& key) {
        std::vector<std::uint64_t> keyed(numbers.size());
        for (std::size_t i = 0; i < keyed.size(); ++i) keyed[i] = std::uint64_t{key(numbers[i])} << 32 | numbers[i];
        tbb::parallel_sort(keyed.begin(), keyed.end());
        for (std::size_t i = 0; i < keyed.size(); ++i) numbers[i] = static_cast<std::uint32_t>(keyed[i]);
    }
    std::uint32_t first_index(const SharedEdge& e) const {
        return std::min(index_[e.triangles[0]], index_[e.triangles[1]]);
    }

    // The region of a triangle without area is empty; its edges are where it is.
    void append_face(std::uint32_t t, std::vector<float>& table) const {
        const std::array<glm::dvec3, 3> p{s_.corner(t, 0), s_.corner(t, 1), s_.corner(t, 2)};
        append(table, p[0]);
        append(table, s_.normals[t]);
        std::array<glm::dvec3, 3> inward;
        for (std::size_t i = 0; i < 3; ++i) {
            inward[i] = unit(glm::cross(s_.normals[t], p[(i + 1) % 3] - p[i]));
            append(table, inward[i]);
        }
        const bool is_empty = s_.normals[t] == glm::dvec3(0);
        table.push_back(is_empty ? mesh::farthest : static_cast<float>(glm::dot(inward[1], p[1] - p[0])));
        std::size_t start = 0;
        for (std::size_t i = 1; i < 3; ++i)
            if (glm::distance(p[i], p[(i + 1) % 3]) > glm::distance(p[start], p[(start + 1) % 3])) start = i;
        const glm::dvec3 longest = p[(start + 1) % 3] - p[start], direction = unit(longest);
        const double before = glm::dot(direction, p[start] - p[0]);
        table.push_back(static_cast<float>(product_error * glm::length(longest)));
        append(table, direction);
        table.push_back(static_cast<float>(before));
        table.push_back(static_cast<float>(before + glm::length(longest)));
    }
    void append_edge(const SharedEdge& e, std::vector<float>& table) const {
        const glm::dvec3 a = s_.at(e.ends[0]), along = s_.at(e.ends[1]) - a;
        const glm::dvec3 &m = s_.normals[e.triangles[0]], &n = s_.normals[e.triangles[1]];
        append(table, a);
        append(table, along);
        table.push_back(static_cast<float>(1 / glm::dot(along, along)));
        append(table, unit(m + n));
        table.push_back(static_cast<float>(e.is_rim() ? std::numbers::pi : angle_between(m, n) / 2));
        append_limits_of_edge(e, table);
    }
    // The three numbers that limit the directions of an edge's region: see mesh_pieces.hpp.
    void append_limits_of_edge(const SharedEdge& e, std::vector<float>& table) const {
        const glm::dvec3 &m = s_.normals[e.triangles[0]], &n = s_.normals[e.triangles[1]];
        const double cosine = glm::length(m + n) / 2;
        const bool has_normals = !e.is_rim() && m != glm::dvec3(0) && n != glm::dvec3(0);
        if (!has_normals || cosine < least_cosine) {
            table.insert(table.end(), {0, 0, 0});
            return;
        }
        const glm::dvec3 along = s_.at(e.ends[1]) - s_.at(e.ends[0]);
        const bool is_bent = cosine < most_cosine_of_bent_edges;
        const double bend = !is_bent ? 0 : glm::dot(glm::cross(m, n), along) > 0 ? 1 : -1;
        const double least = (is_bent ? 2 * 0.5 : 0.9) * cosine, error = 2 * product_error * glm::length(along);
        for (const double number : {bend, least * least, is_bent ? 2 * error : error})
            table.push_back(static_cast<float>(number));
    }
    void append_vertex(std::uint32_t v, std::vector<float>& table) const {
        append(table, s_.at(v));
        append(table, normal_[v]);
        table.push_back(static_cast<float>(glm::length(normal_[v]) > 0 ? largest_angle_[v] : std::numbers::pi));
    }

    void append_nodes(std::vector<float>& table) const {
        table.push_back(static_cast<float>(tree_.nodes.size()));
        std::size_t edge = 0, vertex = 0;
        for (const BoxTree::Node& n : tree_.nodes) {
            append(table, n.box.low);
            append(table, n.box.high);
            table.push_back(static_cast<float>(n.second_child));
            const bool is_leaf = n.second_child == 0;
            const std::uint32_t end = n.first + n.count;
            const std::size_t first_edge = edge, first_vertex = vertex;
            while (is_leaf && edge < edges_.size() && first_index(s_.edges[edges_[edge]]) < end) ++edge;
            while (is_leaf && vertex < vertices_.size() && first_index_[vertices_[vertex]] < end) ++vertex;
            for (const std::size_t count : {std::size_t{n.first}, std::size_t{is_leaf ? n.count : 0}, first_edge,
                                            edge - first_edge, first_vertex, vertex - first_vertex})
                table.push_back(static_cast<float>(count));
        }
    }

    // The number of a vertex among the pieces, for each corner of each face.
    void append_corners(std::vector<float>& table) const {
        std::vector<std::uint32_t> number(s_.vertices.size());
        for (std::uint32_t i = 0; i < vertices_.size(); ++i) number[vertices_[i]] = i;
        for (const std::uint32_t t : tree_.order)
            for (int i = 0; i < 3; ++i) table.push_back(static_cast<float>(number[s_.triangles[t][i]]));
    }

    static constexpr std::uint32_t none = 0xffffffff;

    const Surface& s_;
    const BoxTree& tree_;
    float half_thickness_;
    std::vector<std::uint32_t> index_;  // of each triangle, in the order of leaves
    std::vector<std::uint32_t> first_index_, vertices_, edges_;
    std::vector<glm::dvec3> normal_;
    std::vector<double> largest_angle_;
};

using mesh::WindingRule;

WindingRule rule_of(const std::string& rule) {
    if (rule.empty() || rule == "winding_number") return WindingRule::winding_number;
    if (rule == "even_odd") return WindingRule::even_odd;
    if (rule == "non_zero") return WindingRule::non_zero;
    throw ModelError(
        fmt::format("mesh: unknown rule \"{}\": use \"winding_number\", \"even_odd\" or \"non_zero\"", rule));
}

// A surface and the tree of its triangles.
struct PreparedSurface {
    Surface surface;
    BoxTree tree;
    bool is_repaired = false;

    PreparedSurface(Surface s, bool was_repaired = false)
        : surface(std::move(s)), tree(mesh::boxes_of(surface), most_in_leaf), is_repaired(was_repaired) {}
};

// The surface of the mesh as given, or nullopt if the mesh has to be repaired.
std::optional<PreparedSurface> clean_surface(const TriangleMesh& triangles, const std::string& name,
                                             model::Preparation& work) {
    try {
        PreparedSurface clean(mesh::surface_of(triangles, name));
        work.tell(0.3f);
        mesh::require_no_crossing(clean.surface, clean.tree, name, work);
        mesh::require_outward(clean.surface, clean.tree, name, work);
        return clean;
    } catch (const mesh::UncleanMesh&) {
        return std::nullopt;
    }
}

PreparedSurface prepared_surface(const Mesh& m, const std::string& name, model::Preparation& work) {
    const WindingRule rule = rule_of(m.rule);
    if (m.thickness > 0) return PreparedSurface(mesh::sheet_of(*m.file.content, name));
    if (std::optional<PreparedSurface> clean = clean_surface(*m.file.content, name, work)) return std::move(*clean);
    return PreparedSurface(mesh::repaired(*m.file.content, rule, name, work), true);
}

}  // namespace

void Mesh::prepare() {
    const std::string name = file.path.empty() ? "it" : file.path;
    if (file.content->triangles.size() > TriangleMesh::max_triangles)
        throw ModelError(fmt::format("mesh: {} has more than {} triangles", name, TriangleMesh::max_triangles));
    constexpr std::uint64_t steps_per_triangle = 4000;
    model::Preparation work(info.name, file.content.get(), steps_per_triangle * file.content->triangles.size());
    work.tell(0);
    PreparedSurface prepared = prepared_surface(*this, name, work);
    work.tell(0.8f);
    table = TableWriter(prepared.surface, prepared.tree, thickness)();
    box = prepared.tree.nodes[0].box.inflated(thickness / 2);
    corners = prepared.is_repaired ? std::move(prepared.surface.vertices) : std::vector<glm::vec3>();
    work.tell(1);
}

double Mesh::support(const glm::dvec3& d, float level) const {
    double most = -std::numeric_limits<double>::infinity();
    for (const glm::vec3& v : corners.empty() ? file.content->vertices : corners)
        most = std::max(most, glm::dot(d, glm::dvec3(v)));
    return most + glm::length(d) * (static_cast<double>(level) + static_cast<double>(thickness) / 2);
}

const float* Mesh::few_pieces(const float* data) {
    std::size_t count = 0;
    for_each_kind([&]<class Kind>() { count += mesh::PieceList::count(data, Kind::kind); });
    if (count > max_pieces_in_shader)
        throw ModelError(
            fmt::format("mesh: a shader can hold meshes of at most {} faces, edges and vertices, but this one has {}",
                        max_pieces_in_shader, count));
    return data;
}

bool Mesh::Specialised::is_sound(std::span<const float> data) {
    if (data.size() < mesh::PieceList::head) return false;
    for (std::size_t kind = 0; kind < mesh::piece_kinds; ++kind)
        if (!(data[kind] >= 0 && data[kind] <= static_cast<float>(max_pieces_in_box)) ||
            data[kind] != std::floor(data[kind]))
            return false;
    return floats(data.data()) <= data.size();
}

}  // namespace phasetree
