#include "gltf/read_gltf.hpp"

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
#include <variant>
#include <vector>

#include "gltf/accessor.hpp"
#include "gltf/accessors.hpp"
#include "gltf/cameras_and_lights.hpp"
#include "gltf/extensions.hpp"
#include "gltf/material.hpp"
#include "gltf/names.hpp"
#include "gltf/placed_meshes.hpp"

namespace phasetree::tracer::gltf {

namespace {

enum Mode : std::size_t { triangles = 4, strip = 5, fan = 6 };

// The matrix that transforms normals of a surface to normals, of any length, of the surface transformed by m. m need
// not have an inverse.
glm::dmat3 cofactors(const glm::dmat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

// The accessors of a primitive's vertices by their names in the file. Those in `decoded` were compressed.
struct Attributes {
    Accessors& accessors;
    Item item;
    std::map<std::string, Accessor> decoded{};

    std::optional<Accessor> find(const std::string& name) const {
        if (const auto found = decoded.find(name); found != decoded.end()) return found->second;
        if (!item.has(name)) return std::nullopt;
        return accessors.read(item.needed_index(name), item);
    }
};

std::optional<Accessor> attribute(const Attributes& attributes, const std::string& name, const Accessor& positions,
                                  std::size_t least_columns) {
    std::optional<Accessor> found = attributes.find(name);
    if (!found) return found;
    if (found->rows() != positions.rows()) found->fail("has a different number of rows than the positions");
    if (found->columns() < least_columns) found->fail("has too few numbers per row");
    return found;
}

// How a morph target moves the vertices, and its weight.
struct MorphTarget {
    double weight;
    std::optional<Accessor> positions, normals, tangents;
};

class Reader {
  public:
    Reader(std::string_view content, const ReadOptions& options, const ReadFile& read_file)
        : document_(content, read_file),
          accessors_(document_, options.limits.triangles),
          materials_(document_, options.limits.pixels, options.panes, options.clear == ReadClear::as_solids),
          has_materials_(options.materials == ReadMaterials::all),
          clear_(options.clear),
          limits_(options.limits) {}

    GltfFile read() {
        check_required_extensions(document_, has_materials_, clear_ != ReadClear::warn);
        if (document_.count("animations") > 0) say("has animations, which are ignored");
        const PlacedMeshes all = placed_meshes(accessors_, limits_.primitives);
        for (const PlacedMesh& placed : all.meshes) {
            ++placed_number_;
            const Item mesh = document_.element("meshes", placed.mesh, document_.root());
            primitives_ += mesh.count("primitives");
            if (primitives_ > limits_.primitives)
                throw GltfError(fmt::format("it has more than {} primitives", limits_.primitives));
            for (const Item& primitive : mesh.items("primitives")) add(primitive, placed);
        }
        for (auto& [key, begun] : parts_) finish(begun);
        if (clear_ == ReadClear::as_solids) {
            std::ranges::stable_sort(file_.solids, {}, &ClearSolid::placed_mesh);
            CamerasAndLights seen = cameras_and_lights(document_, all);
            file_.camera = std::move(seen.camera);
            file_.lights = std::move(seen.lights);
            for (const std::string& sentence : seen.not_shown) say(sentence);
        }
        if (file_.parts.empty() && file_.solids.empty()) throw GltfError(why_there_is_nothing(all));
        say_which_extensions_are_not_read();
        return std::move(file_);
    }

  private:
    // Primitives of the same material form one part, except that those with vertex colours form another. Primitives of
    // a clear material form a solid for each placed mesh, whose number counts from 1.
    struct Key {
        std::optional<std::size_t> material;
        bool by_vertices = false;
        std::size_t placed_mesh = 0;
        auto operator<=>(const Key&) const = default;
    };

    struct PartBeingRead {
        Part part{};
        Coordinates coordinates{};
        bool has_images = false;
        bool lacks_texture = false;  // whether some of it has no texture coordinates
        std::optional<std::size_t> second_set{};
        // Whether the file's tangents are dropped: some are missing, the images use other coordinates, or there is no
        // map of normals.
        bool drops_tangents = false;
        std::optional<ClearSolid> solid{};
    };

    // The sources of a primitive's vertices, and their transforms.
    struct Source {
        Accessor positions;
        std::optional<Accessor> normals, texture, second_texture, colors, tangents, joints, weights, indices;
        PlacedMesh placed;
        std::size_t mode;
        std::vector<MorphTarget> targets{};
    };

    std::string why_there_is_nothing(const PlacedMeshes& placed) const {
        if (!clear_materials_.empty() && !has_empty_)
            return "all its materials are clear, but meshes must be opaque; give it a \"material\", or use "
                   "\"phasetree import\" to make its objects phases";
        if (placed.meshes.empty() && placed.has_hidden)
            return "all of its meshes are hidden (KHR_node_visibility); make some visible and export it again";
        return "its scene has no triangles";
    }

    // Whether something that the file uses is not read.
    bool is_lost(const std::string& extension) const {
        if (clear_ == ReadClear::warn) return true;
        // Opaque materials report their own, and clear ones are phases.
        const bool is_of_one_material =
            extension.find("_materials_") != std::string::npos && extension != "KHR_materials_variants";
        return extension != "KHR_lights_punctual" && !is_of_one_material;
    }

    void say_which_extensions_are_not_read() {
        for (const std::string& name : document_.root().texts("extensionsUsed"))
            if (is_lost(name)) extensions_.insert(name);
        if (const auto of_root = document_.root().item("extensions"))
            for (const std::string& name : of_root->keys())
                if (is_lost(name)) extensions_.insert(name);
        const std::string sentence = sentence_about_unread(extensions_, has_materials_);
        if (!sentence.empty()) say(sentence);
    }

    void add(const Item& primitive, const PlacedMesh& placed) {
        std::size_t mode = primitive.index("mode").value_or(triangles);
        if (mode < triangles) return say("has points or lines, which are ignored");
        if (mode > fan) primitive.fail("has an unknown \"mode\"");
        const auto item = primitive.item("attributes");
        if (!item || !item->has("POSITION")) primitive.fail("has no positions");
        Attributes attributes{accessors_, *item, accessors_.decoded(primitive, *item)};
        // Compressed strips are decoded to triangles.
        if (!attributes.decoded.empty()) mode = triangles;
        const Accessor positions = attributes.find("POSITION").value();
        if (positions.columns() != 3) positions.fail("has positions that do not have three numbers");

        PartBeingRead* const part = part_of(primitive, placed, has_materials_ && item->has("COLOR_0"));
        if (!part) return;
        PartBeingRead& begun = *part;
        const auto of = [&](const std::string& name, std::size_t columns) {
            return attribute(attributes, name, positions, columns);
        };
        const auto coordinates = [&](const std::optional<std::size_t>& set) {
            return set ? of(fmt::format("TEXCOORD_{}", *set), 2) : std::nullopt;
        };
        Source source{positions,
                      of("NORMAL", 3),
                      coordinates(begun.coordinates.set),
                      coordinates(begun.second_set),
                      of("COLOR_0", 3),
                      of("TANGENT", 4),
                      placed.joints ? of("JOINTS_0", 4) : std::nullopt,
                      placed.joints ? of("WEIGHTS_0", 4) : std::nullopt,
                      std::nullopt,
                      placed,
                      mode};
        if (source.joints && item->has("JOINTS_1")) say("has vertices with more than four joints; only four are used");
        // Tangents are meaningless without normals.
        begun.drops_tangents = begun.drops_tangents || !source.tangents || !source.normals;
        if (const auto decoded = attributes.decoded.find("indices"); decoded != attributes.decoded.end())
            source.indices.emplace(decoded->second);
        else if (primitive.has("indices"))
            source.indices.emplace(accessors_.read(primitive.needed_index("indices"), primitive));
        if ((!source.texture || (begun.second_set && !source.second_texture)) && begun.has_images &&
            !begun.lacks_texture)
            say(fmt::format("\"{}\" needs texture coordinates, which some of its meshes lack", begun.part.name));
        begun.lacks_texture = begun.lacks_texture || !source.texture;
        if (placed.weights) add_targets(primitive, source);
        add_triangles(primitive, source, begun);
    }

    // The morph targets whose weights are not 0.
    void add_targets(const Item& primitive, Source& source) {
        const auto count_moves = [&](std::size_t moves) {
            moves_ += moves;
            if (moves_ > limits_.moves)
                throw GltfError(
                    fmt::format("its morph targets move more than {} million vertices", limits_.moves / 1'000'000));
        };
        // Targets with the weight 0 take time, too.
        count_moves(primitive.count("targets"));
        const std::vector<Item> targets = primitive.items("targets");
        const std::vector<float>& weights = *source.placed.weights;
        for (std::size_t i = 0; i < std::min(targets.size(), weights.size()); ++i) {
            if (weights[i] == 0.0f) continue;
            count_moves(source.positions.rows());
            const Attributes attributes{accessors_, targets[i]};
            const auto of = [&](const char* name) { return attribute(attributes, name, source.positions, 3); };
            source.targets.push_back({static_cast<double>(weights[i]), of("POSITION"), of("NORMAL"), of("TANGENT")});
        }
    }

    // The part to which a primitive belongs; null if it is left out.
    PartBeingRead* part_of(const Item& primitive, const PlacedMesh& placed, bool by_vertices) {
        const Key key{has_materials_ ? primitive.index("material") : std::nullopt, by_vertices};
        const auto clear = clear_materials_.find(key.material);
        const bool is_opaque = clear == clear_materials_.end() && (parts_.contains(key) || begin(key, primitive));
        if (is_opaque) return &parts_.at(key);
        if (clear_ != ReadClear::as_solids) return nullptr;
        const Key of_solid{.material = key.material, .placed_mesh = placed_number_};
        if (!parts_.contains(of_solid)) begin_solid(of_solid, placed);
        return &parts_.at(of_solid);
    }

    void begin_solid(const Key& key, const PlacedMesh& placed) {
        if (++solids_ > limits_.solids)
            throw GltfError(fmt::format("it has more than {} clear objects", limits_.solids));
        const Item node = document_.element("nodes", placed.node, document_.root());
        const Item mesh = document_.element("meshes", placed.mesh, node);
        std::string name = clean_name(node.text("name"));
        if (name.empty()) name = clean_name(mesh.text("name"));
        if (name.empty()) name = fmt::format("node {}", placed.node);
        const std::size_t material = clear_materials_.at(key.material);
        const gltf::ClearMaterial& of_material = file_.clear_materials[material].material;
        const auto own = priority_of(node);
        std::string matter = matter_of(node);
        parts_[key].drops_tangents = true;
        parts_[key].solid = {.name = std::move(name),
                             .placed_mesh = placed_number_,
                             .material = material,
                             .priority = own ? own : of_material.priority,
                             .matter = matter.empty() ? of_material.matter : std::move(matter)};
    }

    // False if the material is clear.
    bool begin(const Key& key, const Item& primitive) {
        if (parts_.size() - solids_ + clear_materials_.size() >= limits_.materials)
            throw GltfError(fmt::format("it has more than {} materials", limits_.materials));
        if (!has_materials_) {
            parts_[key].part.name = "all";
            return true;
        }
        NamedMaterial made = materials_.make(key.material, key.by_vertices, primitive);
        extensions_.insert(made.extensions.begin(), made.extensions.end());
        for (const std::string& sentence : made.not_shown) say(fmt::format("\"{}\" {}", made.name, sentence));
        if (made.is_clear) {
            begin_clear(key.material, std::move(made));
            return false;
        }
        file_.has_panes = file_.has_panes || made.is_pane;
        const bool has_tangents = needs_tangents(made.material);
        parts_[key] = {
            .part = {.name = std::move(made.name),
                     .material = std::move(made.material),
                     .opacity = std::move(made.opacity)},
            .coordinates = made.coordinates.value_or(Coordinates()),
            .has_images = made.coordinates.has_value(),
            .second_set = made.second_set,
            // The file's tangents are those of its own coordinates, and only normal maps and anisotropy need them.
            .drops_tangents = !has_tangents || made.coordinates != Coordinates()};
        return true;
    }

    void begin_clear(const std::optional<std::size_t>& number, NamedMaterial made) {
        clear_materials_[number] = file_.clear_materials.size();
        if (clear_ == ReadClear::warn)
            say(
                fmt::format("\"{}\" is clear and therefore ignored, because meshes have no interior; use \"phasetree "
                            "import\" to make it a phase",
                            made.name));
        if (clear_ == ReadClear::as_solids)
            file_.clear_materials.push_back({unlike(clear_names_, made.name), made.clear.value()});
    }

    // The name, with a number appended if it is taken.
    static std::string unlike(std::set<std::string>& taken, const std::string& name) {
        std::string unique = name;
        for (int same = 2; !taken.insert(unique).second; ++same) unique = fmt::format("{} {}", name, same);
        return unique;
    }

    void finish(PartBeingRead& begun) {
        Part& part = begun.part;
        if (part.mesh.triangles.empty()) {
            has_empty_ = has_empty_ || !begun.solid;
            return;
        }
        if (begun.solid) {
            begun.solid->mesh = std::move(part.mesh);
            file_.solids.push_back(std::move(*begun.solid));
            return;
        }
        const auto is_zero = [](const glm::vec3& n) { return n == glm::vec3(0); };
        if (std::ranges::all_of(part.normals.values, is_zero)) part.normals = {};
        if (!part.colors.empty()) part.colors.values.resize(part.mesh.vertices.size(), glm::vec3(1));
        drop_useless_opacity(part);
        if (begun.drops_tangents) part.tangents = {};
        // If there are images, triangles without coordinates have the same coordinates at all corners, so they show a
        // single pixel.
        if (begun.lacks_texture && !begun.has_images) part.texture = {};
        part.name = unlike(names_, part.name);
        file_.parts.push_back(std::move(part));
    }

    // Vertices' alpha of 1 everywhere changes nothing, and an opacity costs time.
    static void drop_useless_opacity(Part& part) {
        if (!part.opacity || !part.opacity->by_vertices) return;
        if (std::ranges::any_of(part.alphas.values, [](float alpha) { return alpha < 1; })) return;
        part.alphas = {};
        part.opacity->by_vertices = false;
        if (part.opacity->least() >= part.opacity->cutoff.value_or(1)) part.opacity.reset();
    }

    void add_triangles(const Item& primitive, const Source& source, PartBeingRead& begun) {
        const std::size_t corners = source.indices ? source.indices->rows() : source.positions.rows();
        const std::size_t count = source.mode == triangles ? corners / 3 : corners - std::min<std::size_t>(corners, 2);
        triangles_ += count;
        if (triangles_ > limits_.triangles)
            throw GltfError(fmt::format("it has more than {} million triangles", limits_.triangles / 1'000'000));
        ++primitive_number_;
        if (vertices_in_part_.size() < source.positions.rows()) vertices_in_part_.resize(source.positions.rows());
        // Only vertices of triangles are kept, because primitives may share one list of positions.
        const auto vertex_of = [&](std::size_t corner) -> std::size_t {
            return source.indices ? source.indices->index(corner) : corner;
        };
        const auto vertex = [&](std::size_t corner) {
            const std::size_t i = vertex_of(corner);
            if (i >= source.positions.rows()) primitive.fail("has an index beyond the last vertex");
            if (vertices_in_part_[i].primitive != primitive_number_) {
                vertices_in_part_[i] = {primitive_number_, static_cast<std::uint32_t>(begun.part.mesh.vertices.size()),
                                        is_mirrored(placement_of_vertex(i, source))};
                add_vertex(i, source, begun);
            }
            return vertices_in_part_[i].number;
        };
        for (std::size_t i = 0; i < count; ++i) {
            // Every second triangle of a strip has the opposite orientation.
            const std::array<std::size_t, 3> of = source.mode == triangles ? std::array{3 * i, 3 * i + 1, 3 * i + 2}
                                                  : source.mode == fan     ? std::array{i + 1, i + 2, std::size_t{0}}
                                                                       : std::array{i, i + 1 + i % 2, i + 2 - i % 2};
            const std::uint32_t a = vertex(of[0]), b = vertex(of[1]), c = vertex(of[2]);
            if (vertices_in_part_[vertex_of(of[0])].is_mirrored)
                begun.part.mesh.triangles.emplace_back(a, c, b);
            else
                begun.part.mesh.triangles.emplace_back(a, b, c);
        }
    }

    static void add_vertex(std::size_t i, const Source& source, PartBeingRead& begun) {
        Part& part = begun.part;
        const glm::dmat4 placement = placement_of_vertex(i, source);
        const glm::dvec3 position = moved<&MorphTarget::positions>(row<3>(source.positions, i), i, source);
        part.mesh.vertices.push_back(finite(glm::dvec3(placement * glm::dvec4(position, 1)), source.positions));
        // Mirrored triangles get their corners in reverse order. Cofactors flip their normals, so they are flipped
        // back.
        const double side = is_mirrored(placement) ? -1 : 1;
        part.normals.values.push_back(
            source.normals ? unit(side * (cofactors(glm::dmat3(placement)) *
                                          moved<&MorphTarget::normals>(row<3>(*source.normals, i), i, source)))
                           : glm::vec3(0));
        const auto uv = [&](const std::optional<Accessor>& texture, const glm::mat3& transform) {
            const glm::dvec3 in_file(texture ? row<2>(*texture, i) : glm::dvec2(0), 1);
            return finite(glm::dvec2(glm::dmat3(transform) * in_file), texture ? *texture : source.positions);
        };
        part.texture.values.push_back(uv(source.texture, begun.coordinates.transform));
        if (begun.second_set)
            part.second_texture.values.push_back(uv(source.second_texture, Coordinates::from_upper_left()));
        if (source.colors) {
            // Earlier vertices without colours are white.
            part.colors.values.resize(part.mesh.vertices.size() - 1, glm::vec3(1));
            part.colors.values.push_back(glm::clamp(finite(row<3>(*source.colors, i), *source.colors), 0.0f, 1.0f));
        }
        if (part.opacity && part.opacity->by_vertices) {
            const bool has_alpha = source.colors && source.colors->columns() == 4;
            const double alpha = has_alpha ? source.colors->finite_number(i, 3) : 1.0;
            part.alphas.values.push_back(std::clamp(static_cast<float>(alpha), 0.0f, 1.0f));
        }
        if (begun.drops_tangents) return;
        const glm::dvec4 tangent = row<4>(*source.tangents, i);
        const glm::dvec3 direction = moved<&MorphTarget::tangents>(glm::dvec3(tangent), i, source);
        part.tangents.values.emplace_back(unit(glm::dmat3(placement) * direction),
                                          std::copysign(1.0f, static_cast<float>(side * tangent.w)));
    }

    // A vector of a vertex after applying the morph targets.
    template <std::optional<Accessor> MorphTarget::*vectors>
    static glm::dvec3 moved(glm::dvec3 v, std::size_t i, const Source& source) {
        for (const MorphTarget& target : source.targets)
            if (target.*vectors) v += target.weight * row<3>(*(target.*vectors), i);
        return v;
    }

    static bool is_mirrored(const glm::dmat4& placement) { return glm::determinant(glm::dmat3(placement)) < 0; }

    // A vertex with joints has the mean of their matrices.
    static glm::dmat4 placement_of_vertex(std::size_t i, const Source& source) {
        if (!source.joints || !source.weights) return source.placed.placement;
        glm::dmat4 sum(0);
        double weights = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const double joint = source.joints->number(i, k), weight = source.weights->number(i, k);
            if (weight == 0) continue;
            if (!(weight > 0 && weight <= 1e6))
                source.weights->fail("has a weight that is negative, not a number, or beyond 10⁶");
            if (!(joint < static_cast<double>(source.placed.joints->size())))
                source.joints->fail("refers to a joint that its skin does not have");
            sum += weight * (*source.placed.joints)[static_cast<std::size_t>(std::max(joint, 0.0))];
            weights += weight;
        }
        return weights > 0 ? sum / weights : source.placed.placement;
    }

    // Normalises v; returns 0 if its length is 0 or not finite.
    static glm::vec3 unit(const glm::dvec3& v) {
        const double length = glm::length(v);
        return length > 0 && std::isfinite(length) ? glm::vec3(v / length) : glm::vec3(0);
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
            if (!(std::abs(v[k]) <= most_magnitude)) accessor.fail("has a value that is not a number, or beyond 10¹⁵");
        return glm::vec<count, float>(v);
    }

    void say(const std::string& sentence) {
        if (said_.insert(sentence).second) file_.not_shown.push_back(sentence);
    }

    // A vertex's number in its part; it is valid only while primitive_number_ is `primitive`.
    struct VertexInPart {
        std::uint32_t primitive = 0, number = 0;
        bool is_mirrored = false;
    };

    Document document_;
    Accessors accessors_;
    Materials materials_;
    bool has_materials_;
    ReadClear clear_;
    Limits limits_;
    std::size_t triangles_ = 0, primitives_ = 0, moves_ = 0, solids_ = 0;
    std::size_t placed_number_ = 0;               // of the placed mesh that is read, from 1
    std::uint32_t primitive_number_ = 0;          // of the primitive that is read
    std::vector<VertexInPart> vertices_in_part_;  // of the vertices of the primitive that is read
    std::map<Key, PartBeingRead> parts_;
    std::map<std::optional<std::size_t>, std::size_t> clear_materials_;  // their numbers in the file_
    bool has_empty_ = false;                                             // whether something opaque has no triangles
    std::set<std::string> said_, names_, clear_names_, extensions_;
    GltfFile file_;
};

}  // namespace

GltfFile read_gltf(std::string_view content, const ReadOptions& options, const ReadFile& read_file) {
    return Reader(content, options, read_file).read();
}

}  // namespace phasetree::tracer::gltf
