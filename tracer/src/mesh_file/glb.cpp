#include "mesh_file/glb.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <utility>

#include "mesh_file/bytes_as_text.hpp"
#include "mesh_file/corner_normals.hpp"
#include "phasetree/math/portable.hpp"

namespace phasetree::tracer {

namespace {

using Json = nlohmann::ordered_json;

constexpr int float_type = 5126, uint32_type = 5125, vertex_data = 34962, index_data = 34963;

Json as_list(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

// A mesh with a single index per corner for both position and normal, as glTF requires.
struct Corners {
    std::vector<glm::vec3> places, normals;
    std::vector<std::uint32_t> numbers;

    explicit Corners(const ClosedMesh& mesh) {
        const CornerNormals of = corner_normals(mesh);
        // A normal belongs to one vertex, so its index also identifies the vertex.
        normals = of.normals;
        places.resize(normals.size());
        numbers.reserve(3 * mesh.triangles.size());
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c) {
                places[of.of[i][c]] = mesh.vertices[mesh.triangles[i][c]];
                numbers.push_back(of.of[i][c]);
            }
    }
};

class GltfDocument {
  public:
    GltfDocument() {
        json_["asset"] = {{"version", "2.0"}, {"generator", "phasetree"}};
        json_["scene"] = 0;
        // Rotates z up to y up.
        const double half = std::sqrt(0.5);
        json_["nodes"] =
            Json::array({{{"name", "object"}, {"rotation", {-half, 0, 0, half}}, {"children", Json::array()}}});
        json_["scenes"] = Json::array({{{"nodes", {0}}}});
        for (const char* part : {"meshes", "materials", "accessors", "bufferViews"}) json_[part] = Json::array();
    }

    void add(const Look& look, const ClosedMesh& mesh, float scale) {
        const Corners corners(mesh);
        json_["nodes"][0]["children"].push_back(json_["nodes"].size());
        json_["nodes"].push_back({{"name", look.name}, {"mesh", json_["meshes"].size()}});
        const std::size_t place = add_vectors(corners.places, true), normal = add_vectors(corners.normals, false);
        const Json primitive{{"attributes", {{"POSITION", place}, {"NORMAL", normal}}},
                             {"indices", add_numbers(corners.numbers)},
                             {"material", json_["materials"].size()}};
        json_["meshes"].push_back({{"name", look.name}, {"primitives", Json::array({primitive})}});
        add_material(look, portable::cbrt(std::abs(mesh.volume())), scale);
    }

    std::string bytes() {
        for (const std::string& extension : extensions_) json_["extensionsUsed"].push_back(extension);
        json_["buffers"] = Json::array({{{"byteLength", data_.bytes().size()}}});
        std::string text = json_.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const std::size_t size = 12 + 8 + text.size() + 8 + data_.bytes().size();
        if (size > std::numeric_limits<std::uint32_t>::max())
            throw std::length_error("a .glb file cannot be larger than 4 GB; use a larger --spacing");
        ByteWriter out;
        append_text(out, "glTF");
        out.number(std::uint32_t{2});
        out.number(static_cast<std::uint32_t>(size));
        out.number(static_cast<std::uint32_t>(text.size()));
        append_text(out, "JSON");
        append_text(out, text);
        out.number(static_cast<std::uint32_t>(data_.bytes().size()));
        append_text(out, std::string_view("BIN\0", 4));
        out.append(data_.bytes());
        return bytes_as_text(out);
    }

  private:
    std::size_t add_view(std::size_t start, int target) {
        json_["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", start}, {"byteLength", data_.bytes().size() - start}, {"target", target}});
        return json_["bufferViews"].size() - 1;
    }
    std::size_t add_vectors(const std::vector<glm::vec3>& vectors, bool with_bounds) {
        const std::size_t start = data_.bytes().size();
        Bounds bounds;
        for (const glm::vec3& v : vectors) {
            for (int i = 0; i < 3; ++i) data_.number(v[i]);
            bounds = unite(bounds, {v, v});
        }
        Json accessor{{"bufferView", add_view(start, vertex_data)},
                      {"componentType", float_type},
                      {"count", vectors.size()},
                      {"type", "VEC3"}};
        if (with_bounds) {
            accessor["min"] = as_list(bounds.low);
            accessor["max"] = as_list(bounds.high);
        }
        json_["accessors"].push_back(accessor);
        return json_["accessors"].size() - 1;
    }
    std::size_t add_numbers(const std::vector<std::uint32_t>& numbers) {
        const std::size_t start = data_.bytes().size();
        for (const std::uint32_t n : numbers) data_.number(n);
        json_["accessors"].push_back({{"bufferView", add_view(start, index_data)},
                                      {"componentType", uint32_type},
                                      {"count", numbers.size()},
                                      {"type", "SCALAR"}});
        return json_["accessors"].size() - 1;
    }

    void add_material(const Look& look, double thickness, float scale) {
        const bool is_glowing = look.kind == Look::glowing;
        const glm::vec3 color = look.kind == Look::clear ? glm::vec3(1)
                                : is_glowing             ? glm::vec3(0)
                                                         : glm::clamp(look.color, 0.f, 1.f);
        const bool is_rough = look.kind == Look::diffuse || is_glowing, is_metal = look.kind == Look::metal;
        Json material{{"name", look.name},
                      {"pbrMetallicRoughness",
                       {{"baseColorFactor", {color.x, color.y, color.z, 1}},
                        {"metallicFactor", is_metal ? 1 : 0},
                        {"roughnessFactor", is_rough                    ? 1.0
                                            : is_metal                  ? 0.2
                                            : look.kind == Look::coated ? 0.3
                                                                        : 0.0}}}};
        if (is_glowing) {
            const float most = std::max({look.color.x, look.color.y, look.color.z, 1.f});
            material["emissiveFactor"] = as_list(glm::clamp(look.color / most, 0.f, 1.f));
            extend(material, "KHR_materials_emissive_strength", {{"emissiveStrength", most}});
        }
        if (look.kind == Look::clear) {
            extend(material, "KHR_materials_transmission", {{"transmissionFactor", 1}});
            extend(material, "KHR_materials_ior", {{"ior", std::max(look.ior, 1.f)}});
            Json volume{{"thicknessFactor", thickness}};
            const float most = std::max({look.absorption.x, look.absorption.y, look.absorption.z});
            if (most > 0) {
                volume["attenuationDistance"] = scale / most;
                volume["attenuationColor"] = as_list(glm::exp(-look.absorption / most));
            }
            extend(material, "KHR_materials_volume", volume);
        }
        json_["materials"].push_back(material);
    }
    void extend(Json& material, const std::string& extension, const Json& parameters) {
        material["extensions"][extension] = parameters;
        extensions_.insert(extension);
    }

    Json json_;
    ByteWriter data_;
    std::set<std::string> extensions_;
};

}  // namespace

std::string glb_of(const MeshedObject& object) {
    GltfDocument document;
    for (const Phase phase : object.phases())
        document.add(object.look(phase), surface_of(object.mesh, PhaseSet::of(phase)), object.scale);
    return document.bytes();
}

}  // namespace phasetree::tracer
