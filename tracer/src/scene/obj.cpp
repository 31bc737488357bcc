#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <istream>
#include <span>
#include <streambuf>

#include "parameters/text_file.hpp"
#include "phasetree_support/reading.hpp"
#include "scene/mesh_kinds.hpp"

namespace phasetree::tracer {

namespace {

constexpr std::uintmax_t max_file_bytes = std::uintmax_t{1} << 30;

// A text as a stream, which tells how far it has been read.
class ToldText : public std::streambuf {
  public:
    explicit ToldText(std::string text) : text_(std::move(text)) {}

  protected:
    int_type underflow() override {
        place_.finished(at_);
        const std::size_t next = std::min<std::size_t>(support::ReadingPlace::step, text_.size() - at_);
        setg(text_.data() + at_, text_.data() + at_, text_.data() + at_ + next);
        at_ += next;
        return next > 0 ? traits_type::to_int_type(*gptr()) : traits_type::eof();
    }

  private:
    std::string text_;
    std::size_t at_ = 0;  // up to where it has been handed out
    support::ReadingPlace place_;
};

// Normals of the vertices: those of the triangles around each, weighted by area.
void add_smooth_normals(Mesh& mesh) {
    mesh.normals.assign(mesh.vertices.size(), glm::vec3(0.0f));
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 n =
            glm::cross(mesh.vertices[t.y] - mesh.vertices[t.x], mesh.vertices[t.z] - mesh.vertices[t.x]);
        for (int i = 0; i < 3; ++i) mesh.normals[t[i]] += n;
    }
    for (glm::vec3& n : mesh.normals) {
        const float l = glm::length(n);
        n = l > 0 ? n / l : glm::vec3(0, 0, 1);
    }
}

// The texture coordinates of a triangle's corners, if it has any.
void add_uv(Mesh& mesh, const std::vector<float>& coordinates, std::span<const tinyobj::index_t> corners) {
    std::array<glm::vec2, 3> uv;
    for (std::size_t k = 0; k < 3; ++k) {
        const int index = corners[k].texcoord_index;
        const std::size_t at = 2 * static_cast<std::size_t>(std::max(index, 0));
        if (index < 0 || at + 1 >= coordinates.size()) return;
        uv[k] = {coordinates[at], coordinates[at + 1]};
        if (!std::isfinite(uv[k].x) || !std::isfinite(uv[k].y)) return;
    }
    mesh.uv.push_back(uv);
}

}  // namespace

Mesh ObjParameters::made() const {
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    std::string warning, error;
    ToldText text(read_text_file(file, max_file_bytes, "1 GiB"));
    std::istream stream(&text);
    constexpr bool as_triangles = true, with_colours = false;
    if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &stream, nullptr, as_triangles,
                          with_colours))
        throw ParameterError("file", fmt::format("{} is not a readable OBJ file: {}", file.string(), error));

    const float turn = glm::radians(rotate_z_degrees);
    Mesh mesh;
    const auto& v = attributes.vertices;
    for (std::size_t i = 0; i + 2 < v.size(); i += 3) {
        glm::vec3 p(v[i], v[i + 1], v[i + 2]);
        if (y_up) p = {p.x, -p.z, p.y};
        p *= scale;
        p = {std::cos(turn) * p.x - std::sin(turn) * p.y, std::sin(turn) * p.x + std::cos(turn) * p.y, p.z};
        mesh.vertices.push_back(p + translate);
        for (int k = 0; k < 3; ++k)
            if (!coordinate.contains(mesh.vertices.back()[k]))
                throw ParameterError(
                    "file", fmt::format("{} has a coordinate that is no number or beyond 10¹⁵", file.string()));
    }
    for (const auto& shape : shapes) {
        const auto& index = shape.mesh.indices;
        for (std::size_t i = 0; i + 2 < index.size(); i += 3) {
            glm::uvec3 triangle;
            for (int k = 0; k < 3; ++k) {
                const int vertex = index[i + static_cast<std::size_t>(k)].vertex_index;
                if (vertex < 0 || static_cast<std::size_t>(vertex) >= mesh.vertices.size())
                    throw ParameterError("file",
                                         fmt::format("{} has a face with a vertex that does not exist", file.string()));
                triangle[k] = static_cast<unsigned>(vertex);
            }
            mesh.triangles.push_back(triangle);
            add_uv(mesh, attributes.texcoords, std::span(index).subspan(i, 3));
        }
    }
    // Some faces without coordinates are as none at all.
    if (mesh.uv.size() != mesh.triangles.size()) mesh.uv.clear();
    if (mesh.triangles.empty()) throw ParameterError("file", fmt::format("{} has no faces", file.string()));
    if (smooth) add_smooth_normals(mesh);
    return mesh;
}

}  // namespace phasetree::tracer
