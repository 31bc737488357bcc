#include "gltf/accessors.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "gltf/meshopt.hpp"

namespace phasetree::tracer::gltf {

namespace {

constexpr const char* meshopt_name = "EXT_meshopt_compression";

MeshoptLayout layout_of(const Item& compressed) {
    MeshoptLayout layout{.count = compressed.needed_index("count"), .stride = compressed.needed_index("byteStride")};
    const std::string mode = compressed.text("mode"), filter = compressed.text("filter");
    if (mode == "ATTRIBUTES")
        layout.mode = MeshoptMode::attributes;
    else if (mode == "TRIANGLES")
        layout.mode = MeshoptMode::triangles;
    else if (mode == "INDICES")
        layout.mode = MeshoptMode::indices;
    else
        compressed.fail("has a \"mode\" other than ATTRIBUTES, TRIANGLES and INDICES");
    if (filter == "OCTAHEDRAL")
        layout.filter = MeshoptFilter::octahedral;
    else if (filter == "QUATERNION")
        layout.filter = MeshoptFilter::quaternion;
    else if (filter == "EXPONENTIAL")
        layout.filter = MeshoptFilter::exponential;
    else if (!filter.empty() && filter != "NONE")
        compressed.fail("has a \"filter\" other than NONE, OCTAHEDRAL, QUATERNION and EXPONENTIAL");
    if (!layout.is_allowed())
        compressed.fail("has a \"byteStride\", \"count\" or \"filter\" that its \"mode\" does not allow");
    return layout;
}

// The attributes of vertices that are read. Files have at most a few sets of texture coordinates.
constexpr std::array attribute_names{"POSITION",   "NORMAL",     "TANGENT",    "COLOR_0",    "JOINTS_0",
                                     "WEIGHTS_0",  "TEXCOORD_0", "TEXCOORD_1", "TEXCOORD_2", "TEXCOORD_3",
                                     "TEXCOORD_4", "TEXCOORD_5", "TEXCOORD_6", "TEXCOORD_7"};

}  // namespace

void Accessors::count(std::size_t bytes) {
    if (bytes > bytes_left_) throw GltfError("its compressed data exceed 1 GiB in total");
    bytes_left_ -= bytes;
}

bool Accessors::must_check(std::size_t accessor, std::size_t indices) {
    if (!checked_.insert(accessor).second) return false;
    if (indices > indices_left_) throw GltfError("its sparse accessors replace more than 200 million rows in total");
    indices_left_ -= indices;
    return true;
}

std::string_view Accessors::bytes_of_view(std::size_t index, const Item& from) {
    const Item view = document_.element("bufferViews", index, from);
    const auto compressed = view.extension(meshopt_name);
    if (!compressed) return document_.view(index, from);
    if (!has_meshopt()) {
        // A file that does not require the extension also has the uncompressed bytes.
        const Item buffer = document_.element("buffers", view.needed_index("buffer"), view);
        const auto fallback = buffer.extension(meshopt_name);
        if (buffer.has("uri") || !fallback || !fallback->flag("fallback")) return document_.view(index, from);
        view.fail(
            "is compressed with EXT_meshopt_compression, which this build cannot read; export it without meshopt "
            "compression, or install libmeshoptimizer-dev and rebuild");
    }
    const auto known = views_.find(index);
    if (known != views_.end()) return known->second;
    const MeshoptLayout layout = layout_of(*compressed);
    const std::string_view bytes = document_.bytes_in_buffer(*compressed);
    count(bytes.size());
    std::optional<std::string> decoded = decode_meshopt(bytes, layout);
    if (!decoded) compressed->fail("contains invalid data; export the file again, or without meshopt compression");
    count(decoded->size());
    if (view.needed_index("byteLength") != decoded->size())
        view.fail(fmt::format("has a \"byteLength\" other than the {} bytes of its compressed data", decoded->size()));
    return views_.emplace(index, std::move(*decoded)).first->second;
}

std::map<std::string, Accessor> Accessors::decoded(const Item& primitive, const Item& attributes) {
    std::map<std::string, Accessor> all;
    const auto compressed = primitive.extension("KHR_draco_mesh_compression");
    if (!compressed) return all;
    const auto element = [&](std::size_t index) { return document_.element("accessors", index, attributes); };
    const std::size_t positions = attributes.needed_index("POSITION");
    if (!has_draco() && element(positions).has("bufferView")) return all;
    const auto ids = compressed->item("attributes");
    if (!ids || !ids->has("POSITION")) compressed->fail("has no positions");
    std::vector<std::string> names;
    std::vector<DracoAttribute> wanted;
    for (const char* const name : attribute_names)
        if (ids->has(name) && attributes.has(name)) {
            const Item accessor = element(attributes.needed_index(name));
            names.emplace_back(name);
            wanted.push_back(
                {ids->needed_index(name), accessor.needed_index("componentType"), Accessor::columns_of(accessor)});
        }
    const std::size_t view = compressed->needed_index("bufferView");
    const DracoKey key(view, wanted);
    auto known = primitives_.find(key);
    if (known == primitives_.end()) {
        const std::string_view bytes = document_.view(view, *compressed);
        count(bytes.size());
        const std::size_t vertices = element(positions).needed_index("count");
        for (const DracoAttribute& attribute : wanted) count(vertices * attribute.columns * sizeof(float));
        const DracoLimits limits{.triangles = most_triangles_, .vertices = vertices, .bytes = bytes_left_};
        try {
            known = primitives_.emplace(key, decode_draco(bytes, wanted, limits)).first;
        } catch (const GltfError& e) {
            compressed->fail(e.what());
        }
        count(known->second.indices.size() * sizeof(std::uint32_t));
    }
    const DracoMesh& mesh = known->second;
    const std::size_t vertices = element(positions).needed_index("count"),
                      indices = element(primitive.needed_index("indices")).needed_index("count");
    if (mesh.vertices != vertices || mesh.indices.size() != indices)
        compressed->fail(fmt::format("has {} vertices and {} indices, but its accessors declare {} and {}",
                                     mesh.vertices, mesh.indices.size(), vertices, indices));
    for (std::size_t i = 0; i < names.size(); ++i)
        all.emplace(names[i], Accessor(document_, attributes.needed_index(names[i]), attributes, mesh.attributes[i]));
    const std::string_view bytes_of_indices(reinterpret_cast<const char*>(mesh.indices.data()),
                                            mesh.indices.size() * sizeof(std::uint32_t));
    all.emplace("indices", Accessor(document_, primitive.needed_index("indices"), primitive, bytes_of_indices, true));
    return all;
}

}  // namespace phasetree::tracer::gltf
