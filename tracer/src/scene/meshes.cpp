#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "scene/parts.hpp"

namespace phasetree::tracer {

namespace {

constexpr std::string_view kinds[] = {"obj", "floor", "backdrop"};
constexpr std::uintmax_t max_file_bytes = std::uintmax_t{1} << 30;

// Normals of the vertices: those of the triangles around each, weighted by area.
void smooth(Mesh& mesh) {
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

void add_quad(Mesh& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
    const auto first = static_cast<unsigned>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {a, b, c, d});
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first, first + 2, first + 3);
}

// A square on the plane z = height.
Mesh read_floor(ObjectReader& reader) {
    const float z = reader.optional("height", 0.0f, coordinate);
    const float half = 0.5f * reader.optional("size", 1000.0f, size_of_thing);
    Mesh mesh;
    add_quad(mesh, {-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z});
    return mesh;
}

// A photographer's sweep: a floor at z = height that curves up into a wall at y = distance, without an edge.
Mesh read_backdrop(ObjectReader& reader) {
    const float z = reader.optional("height", 0.0f, coordinate);
    const float distance = reader.optional("distance", 5.0f, size_of_thing);
    const float radius = reader.optional("radius", 2.0f, size_of_thing);
    const float half = 0.5f * reader.optional("width", 100.0f, size_of_thing);
    const float front = reader.optional("front", 50.0f, size_of_thing);
    const float wall = reader.optional("wall", 50.0f, size_of_thing);
    constexpr int steps = 64;
    std::vector<std::pair<glm::vec2, glm::vec2>> profile;  // (y, z) and the normal in that plane
    profile.push_back({{-front, z}, {0, 1}});
    for (int i = 0; i <= steps; ++i) {
        const float a = 0.5f * 3.14159265f * static_cast<float>(i) / steps;
        const glm::vec2 n{-std::sin(a), std::cos(a)};
        profile.push_back({glm::vec2(distance - radius, z + radius) - radius * n, n});
    }
    profile.push_back({{distance, z + radius + wall}, {-1, 0}});
    Mesh mesh;
    for (const auto& [p, n] : profile) {
        for (const float x : {-half, half}) {
            mesh.vertices.emplace_back(x, p.x, p.y);
            mesh.normals.emplace_back(0.0f, n.x, n.y);
        }
    }
    for (unsigned i = 0; i + 1 < profile.size(); ++i) {
        mesh.triangles.emplace_back(2 * i, 2 * i + 1, 2 * i + 3);
        mesh.triangles.emplace_back(2 * i, 2 * i + 3, 2 * i + 2);
    }
    return mesh;
}

std::string read_text(const Document& document, Value file, const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored))
        throw document.error(file, fmt::format("there is no file {}", path.string()));
    if (!std::filesystem::is_regular_file(path, ignored))
        throw document.error(file, fmt::format("{} is not a regular file", path.string()));
    if (std::filesystem::file_size(path, ignored) > max_file_bytes)
        throw document.error(file, fmt::format("{} is larger than 1 GiB", path.string()));
    std::ifstream stream(path, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream) throw document.error(file, fmt::format("{} cannot be read", path.string()));
    return text.str();
}

// A Wavefront OBJ file; of its contents the faces, their materials not.
Mesh read_obj(ObjectReader& reader) {
    const Document& document = reader.document();
    const Value file = reader.required_value("file");
    (void)as<std::string>(document, file, "\"file\"");
    const std::filesystem::path path = document.file(file);
    tinyobj::ObjReader obj;
    tinyobj::ObjReaderConfig config;
    config.triangulate = true;
    config.vertex_color = false;
    if (!obj.ParseFromString(read_text(document, file, path), "", config))
        throw document.error(file, fmt::format("{} is not a readable OBJ file: {}", path.string(), obj.Error()));

    const float scale = reader.optional("scale", 1.0f, Range::positive());
    const float turn = glm::radians(reader.optional("rotate_z", 0.0f));
    const bool y_up = reader.optional("y_up", false);
    const glm::vec3 move = reader.optional("translate", glm::vec3(0.0f));
    Mesh mesh;
    const auto& v = obj.GetAttrib().vertices;
    for (std::size_t i = 0; i + 2 < v.size(); i += 3) {
        glm::vec3 p(v[i], v[i + 1], v[i + 2]);
        if (y_up) p = {p.x, -p.z, p.y};
        p *= scale;
        p = {std::cos(turn) * p.x - std::sin(turn) * p.y, std::sin(turn) * p.x + std::cos(turn) * p.y, p.z};
        mesh.vertices.push_back(p + move);
        for (int k = 0; k < 3; ++k)
            if (!coordinate.contains(static_cast<double>(mesh.vertices.back()[k])))
                throw document.error(
                    file, fmt::format("{} has a coordinate that is no number or beyond 10¹⁵", path.string()));
    }
    for (const auto& shape : obj.GetShapes()) {
        const auto& index = shape.mesh.indices;
        for (std::size_t i = 0; i + 2 < index.size(); i += 3) {
            glm::uvec3 triangle;
            for (int k = 0; k < 3; ++k) {
                const int vertex = index[i + static_cast<std::size_t>(k)].vertex_index;
                if (vertex < 0 || static_cast<std::size_t>(vertex) >= mesh.vertices.size())
                    throw document.error(file,
                                         fmt::format("{} has a face with a vertex that does not exist", path.string()));
                triangle[k] = static_cast<unsigned>(vertex);
            }
            mesh.triangles.push_back(triangle);
        }
    }
    if (mesh.triangles.empty()) throw document.error(file, fmt::format("{} has no faces", path.string()));
    if (reader.optional("smooth", true)) smooth(mesh);
    return mesh;
}

}  // namespace

std::vector<Mesh> read_meshes(const Document& document, Value list) {
    if (!list.is_array())
        throw document.error(list, fmt::format("\"meshes\" must be a list, but is {}", name_of(list.kind())));
    std::vector<Mesh> meshes;
    for (const Value value : list) {
        const Value member = chosen(document, value, "a mesh", kinds);
        ObjectReader reader(document, member, fmt::format("the {}", member.key()));
        const Material material = read_opaque_material(document, reader.required_value("material"));
        Mesh mesh = member.key() == "obj"     ? read_obj(reader)
                    : member.key() == "floor" ? read_floor(reader)
                                              : read_backdrop(reader);
        mesh.material = material;
        reader.finish();
        meshes.push_back(std::move(mesh));
    }
    return meshes;
}

}  // namespace phasetree::tracer
