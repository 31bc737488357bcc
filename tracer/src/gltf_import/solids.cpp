#include "gltf_import/solids.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <set>
#include <utility>

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/joined_vertices.hpp"

namespace phasetree::tracer::gltf_import {

namespace {

// The number of edges that belong to an odd number of triangles.
std::size_t open_edges(const TriangleMesh& mesh) {
    const JoinedVertices joined = join_vertices(mesh.vertices, mesh.triangles);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const glm::uvec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t a = joined.of[t[i]], b = joined.of[t[(i + 1) % 3]];
            if (a != b) edges.emplace_back(std::min(a, b), std::max(a, b));
        }
    std::ranges::sort(edges);
    std::size_t open = 0;
    for (std::size_t i = 0, next = 0; i < edges.size(); i = next) {
        while (next < edges.size() && edges[next] == edges[i]) ++next;
        open += (next - i) % 2;
    }
    return open;
}

double area_of(const TriangleMesh& mesh) {
    double area = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.vertices[t.x]), b(mesh.vertices[t.y]), c(mesh.vertices[t.z]);
        area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return area;
}

double volume_of(const TriangleMesh& mesh) {
    double volume = 0;
    const glm::dvec3 origin(mesh.vertices.front());
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a = glm::dvec3(mesh.vertices[t.x]) - origin, b = glm::dvec3(mesh.vertices[t.y]) - origin,
                         c = glm::dvec3(mesh.vertices[t.z]) - origin;
        volume += glm::dot(a, glm::cross(b, c)) / 6;
    }
    return std::abs(volume);
}

void append(TriangleMesh& mesh, const TriangleMesh& more) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
    for (const glm::uvec3& t : more.triangles) mesh.triangles.push_back(t + first);
}

class Maker {
  public:
    explicit Maker(const gltf::GltfFile& file) : file_(file) {}

    Solids make() {
        std::vector<const gltf::ClearSolid*> of_one_mesh;
        for (const gltf::ClearSolid& read : file_.solids) {
            if (!of_one_mesh.empty() && of_one_mesh.front()->placed_mesh != read.placed_mesh) add_all(of_one_mesh);
            of_one_mesh.push_back(&read);
        }
        add_all(of_one_mesh);
        return std::move(made_);
    }

  private:
    // Adds the solids of one placed mesh, and empties the list.
    void add_all(std::vector<const gltf::ClearSolid*>& parts) {
        TriangleMesh all;
        bool are_closed = true;
        for (const gltf::ClearSolid* part : parts) {
            append(all, part->mesh);
            are_closed = are_closed && open_edges(part->mesh) == 0;
        }
        if (parts.size() > 1 && !are_closed && open_edges(all) == 0) {
            const auto by_area = [](const gltf::ClearSolid* a, const gltf::ClearSolid* b) {
                return area_of(a->mesh) < area_of(b->mesh);
            };
            const gltf::ClearSolid& largest = **std::ranges::max_element(parts, by_area);
            warn("\"{}\" has {} clear materials on one surface; all of it becomes \"{}\"", largest.name, parts.size(),
                 file_.clear_materials[largest.material].name);
            add(largest, std::move(all));
        } else {
            for (const gltf::ClearSolid* part : parts) add(*part, part->mesh);
        }
        parts.clear();
    }

    void add(const gltf::ClearSolid& read, TriangleMesh mesh) {
        Solid solid{.name = unique_name(read.name),
                    .material = read.material,
                    .priority = read.priority,
                    .matter = read.matter};
        for (glm::vec3& p : mesh.vertices) p = z_up(p);
        solid.mesh = mesh;
        solid.field.file = {.path = fmt::format("\"{}\"", solid.name),
                            .content = std::make_shared<const TriangleMesh>(std::move(mesh))};
        try {
            solid.field.prepare();
        } catch (const ModelError& e) {
            return warn("{}; it is left out", e.what());
        }
        if (const std::size_t open = open_edges(solid.mesh); open > 0)
            warn("\"{}\" is not closed: {} edges belong to an odd number of triangles; its holes have been filled",
                 solid.name, open);
        for (const glm::vec3& p : solid.mesh.vertices) solid.bounds = unite(solid.bounds, {p, p});
        solid.volume = volume_of(solid.mesh);
        solid.area = area_of(solid.mesh);
        made_.solids.push_back(std::move(solid));
    }

    std::string unique_name(const std::string& name) {
        std::string unique = name;
        for (int same = 2; !names_.insert(unique).second; ++same) unique = fmt::format("{} {}", name, same);
        return unique;
    }

    template <class... T>
    void warn(fmt::format_string<T...> format, T&&... values) {
        made_.warnings.push_back(fmt::format(format, std::forward<T>(values)...));
    }

    const gltf::GltfFile& file_;
    Solids made_;
    std::set<std::string> names_;
};

}  // namespace

Solids solids_of(const gltf::GltfFile& file) {
    return Maker(file).make();
}

}  // namespace phasetree::tracer::gltf_import
