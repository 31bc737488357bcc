#include "gltf/read_glb.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "gltf/accessor.hpp"
#include "gltf/material.hpp"
#include "gltf/placed_meshes.hpp"

namespace phasetree::tracer::gltf {

namespace {

enum Mode : std::size_t { triangles = 4, strip = 5, fan = 6 };

// The matrix whose product with a normal is normal to the surface that the other matrix has moved, of any length; also
// of a matrix without an inverse.
glm::dmat3 cofactors(const glm::dmat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

class Reader {
  public:
    Reader(std::string_view content, const Limits& limits)
        : document_(content), materials_(document_, limits.pixels), limits_(limits) {}

    GlbFile read() {
        for (const PlacedMesh& placed : placed_meshes(document_)) {
            const Item mesh = document_.element("meshes", placed.mesh, document_.root());
            for (const Item& primitive : mesh.items("primitives")) add(primitive, placed.placement);
        }
        for (auto& [key, begun] : parts_) {
            Part& part = begun.part;
            if (part.mesh.triangles.empty()) continue;
            const auto is_zero = [](const glm::vec3& n) { return n == glm::vec3(0); };
            if (std::ranges::all_of(part.normals.values, is_zero)) part.normals = {};
            // Where there are images, what has no coordinates has the corner of the image everywhere.
            if (begun.lacks_texture && !begun.has_images) part.texture = {};
            file_.parts.push_back(std::move(part));
        }
        return std::move(file_);
    }

  private:
    // Primitives of one material are one part, those with colours of vertices another.
    struct Key {
        std::optional<std::size_t> material;
        bool by_vertices;
        auto operator<=>(const Key&) const = default;
    };

    struct Begun {
        Part part;
        Coordinates coordinates;
        bool has_images = false;
        bool lacks_texture = false;  // whether some of it has no texture coordinates
    };

    void add(const Item& primitive, const glm::dmat4& placement) {
        const std::size_t mode = primitive.index("mode").value_or(triangles);
        if (mode < triangles) return say("points and lines are not shown");
        if (mode > fan) primitive.fail("has a mode that there is not");
        const auto attributes = primitive.item("attributes");
        if (!attributes || !attributes->has("POSITION")) primitive.fail("has no positions");
        const Accessor positions(document_, attributes->needed_index("POSITION"), *attributes);
        if (positions.columns() != 3) positions.fail("has positions that are not of three numbers");

        const Key key{primitive.index("material"), attributes->has("COLOR_0")};
        if (is_clear_.contains(key.material)) return;
        if (!parts_.contains(key) && !begin(key, primitive)) return;
        // Nodes may place one mesh as often as there are nodes.
        vertices_ += positions.rows();
        if (vertices_ > 3 * limits_.triangles)
            throw GltfError(fmt::format("there are more vertices than {} million", 3 * limits_.triangles / 1'000'000));
        Begun& begun = parts_.at(key);
        Part& part = begun.part;
        const auto first = static_cast<std::uint32_t>(part.mesh.vertices.size());
        for (std::size_t i = 0; i < positions.rows(); ++i)
            part.mesh.vertices.push_back(
                finite(glm::dvec3(placement * glm::dvec4(row<3>(positions, i), 1)), positions));

        const auto attribute = [&](const std::string& name, std::size_t least_columns) {
            std::optional<Accessor> found;
            if (!attributes->has(name)) return found;
            found.emplace(document_, attributes->needed_index(name), *attributes);
            if (found->rows() != positions.rows()) found->fail("has not as many rows as the positions");
            if (found->columns() < least_columns) found->fail("has rows of too few numbers");
            return found;
        };
        const glm::dmat3 turn = cofactors(glm::dmat3(placement));
        const auto normals = attribute("NORMAL", 3);
        const auto texture = attribute(fmt::format("TEXCOORD_{}", begun.coordinates.set), 2);
        begun.lacks_texture = begun.lacks_texture || !texture;
        const auto colors = attribute("COLOR_0", 3);
        for (std::size_t i = 0; i < positions.rows(); ++i) {
            const glm::dvec3 n = normals ? turn * row<3>(*normals, i) : glm::dvec3(0);
            const double length = glm::length(n);
            part.normals.values.push_back(length > 0 && std::isfinite(length) ? glm::vec3(n / length) : glm::vec3(0));
            const glm::dvec3 uv(texture ? row<2>(*texture, i) : glm::dvec2(0), 1);
            part.texture.values.push_back(
                finite(glm::dvec2(glm::dmat3(begun.coordinates.transform) * uv), texture ? *texture : positions));
            if (colors) part.colors.values.push_back(glm::clamp(finite(row<3>(*colors, i), *colors), 0.0f, 1.0f));
        }
        add_triangles(primitive, mode, positions, first, part);
    }

    // False if the material is clear.
    bool begin(const Key& key, const Item& primitive) {
        if (parts_.size() + is_clear_.size() >= limits_.materials)
            throw GltfError(fmt::format("there are more materials than {}", limits_.materials));
        NamedMaterial made = materials_.make(key.material, key.by_vertices, primitive);
        for (const std::string& sentence : made.not_shown) say(fmt::format("\"{}\" {}", made.name, sentence));
        if (made.is_clear) {
            say(fmt::format(
                "\"{}\" is clear, and is left out: meshes are opaque, and what is clear belongs into the tree",
                made.name));
            is_clear_.insert(key.material);
            return false;
        }
        parts_[key] = {.part = {std::move(made.name), std::move(made.material), {}, {}, {}, {}},
                       .coordinates = made.coordinates.value_or(Coordinates()),
                       .has_images = made.coordinates.has_value()};
        return true;
    }

    void add_triangles(const Item& primitive, std::size_t mode, const Accessor& positions, std::uint32_t first,
                       Part& part) {
        std::optional<Accessor> indices;
        if (primitive.has("indices")) indices.emplace(document_, primitive.needed_index("indices"), primitive);
        const std::size_t corners = indices ? indices->rows() : positions.rows();
        const std::size_t count = mode == triangles ? corners / 3 : corners - std::min<std::size_t>(corners, 2);
        triangles_ += count;
        if (triangles_ > limits_.triangles)
            throw GltfError(fmt::format("there are more triangles than {} million", limits_.triangles / 1'000'000));
        const auto vertex = [&](std::size_t corner) {
            const std::size_t i = indices ? indices->index(corner) : corner;
            if (i >= positions.rows()) primitive.fail("has a triangle with a vertex that there is not");
            return first + static_cast<std::uint32_t>(i);
        };
        for (std::size_t i = 0; i < count; ++i) {
            // Every second triangle of a strip is the other way round.
            const std::array<std::size_t, 3> of = mode == triangles ? std::array{3 * i, 3 * i + 1, 3 * i + 2}
                                                  : mode == fan     ? std::array{i + 1, i + 2, std::size_t{0}}
                                                                    : std::array{i, i + 1 + i % 2, i + 2 - i % 2};
            part.mesh.triangles.emplace_back(vertex(of[0]), vertex(of[1]), vertex(of[2]));
        }
    }

    template <int count>
    static glm::vec<count, double> row(const Accessor& accessor, std::size_t i) {
        glm::vec<count, double> v;
        for (int k = 0; k < count; ++k) v[k] = accessor.number(i, static_cast<std::size_t>(k));
        return v;
    }

    template <int count>
    static glm::vec<count, float> finite(const glm::vec<count, double>& v, const Accessor& accessor) {
        for (int k = 0; k < count; ++k)
            if (!(std::abs(v[k]) <= 1e15)) accessor.fail("has something that is no number, or is beyond 10¹⁵");
        return glm::vec<count, float>(v);
    }

    void say(const std::string& sentence) {
        if (said_.insert(sentence).second) file_.not_shown.push_back(sentence);
    }

    Document document_;
    Materials materials_;
    Limits limits_;
    std::size_t vertices_ = 0, triangles_ = 0;
    std::map<Key, Begun> parts_;
    std::set<std::optional<std::size_t>> is_clear_;
    std::set<std::string> said_;
    GlbFile file_;
};

}  // namespace

GlbFile read_glb(std::string_view content, const Limits& limits) {
    return Reader(content, limits).read();
}

}  // namespace phasetree::tracer::gltf
