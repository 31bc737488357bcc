#include "command/meshes_report.hpp"

#include <nlohmann/json.hpp>

#include "command/numbers.hpp"
#include "command/streams.hpp"
#include "scene/meshes_alone.hpp"

namespace phasetree::tracer {

namespace {

// The bounding box, with −0 replaced by 0 for printing.
Bounds printed_bounds(const Mesh& mesh) {
    const Bounds b = bounds_of(std::span(&mesh, 1));
    return {b.low + 0.0f, b.high + 0.0f};
}

}  // namespace

nlohmann::ordered_json meshes_as_json(std::span<const Mesh> meshes) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Mesh& mesh : meshes) {
        const Bounds b = printed_bounds(mesh);
        list.push_back({{"name", mesh.name},
                        {"triangles", mesh.triangles.size()},
                        {"vertices", mesh.vertices.size()},
                        {"bounds", {{b.low.x, b.low.y, b.low.z}, {b.high.x, b.high.y, b.high.z}}}});
    }
    return list;
}

void print_meshes(std::span<const Mesh> meshes) {
    for (const Mesh& mesh : meshes) {
        const Bounds b = printed_bounds(mesh);
        put("{:<14}{}: {} triangles, {} vertices, [{}, {}, {}] to [{}, {}, {}]\n", "mesh", mesh.name,
            mesh.triangles.size(), mesh.vertices.size(), b.low.x, b.low.y, b.low.z, b.high.x, b.high.y, b.high.z);
    }
}

}  // namespace phasetree::tracer
