#include "mesh_file/stl.hpp"

#include <glm/geometric.hpp>

#include "mesh_file/bytes_as_text.hpp"

namespace phasetree::tracer {

std::string stl_of(const ClosedMesh& mesh) {
    // Must not begin with "solid", which identifies a text file.
    std::string head = "phasetree: binary STL";
    head.resize(80, ' ');
    ByteWriter out;
    append_text(out, head);
    out.number(static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const auto& t : mesh.triangles) {
        const glm::vec3 p[3] = {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
        const glm::dvec3 normal = glm::cross(glm::dvec3(p[1]) - glm::dvec3(p[0]), glm::dvec3(p[2]) - glm::dvec3(p[0]));
        const double length = glm::length(normal);
        const glm::vec3 unit = length > 0 ? glm::vec3(normal / length) : glm::vec3(0);
        for (const glm::vec3& v : {unit, p[0], p[1], p[2]})
            for (int i = 0; i < 3; ++i) out.number(v[i]);
        out.number(std::uint16_t{0});
    }
    return bytes_as_text(out);
}

}  // namespace phasetree::tracer
