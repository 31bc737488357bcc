#include "scene/meshes_alone.hpp"

#include "scene/nothing_left.hpp"

namespace phasetree::tracer {

bool has_meshes_alone(const Document& document) {
    const Value root = document.root();
    if (!root.is_object() || has_objects(document)) return false;
    const auto meshes = root.find("meshes"), phases = root.find("phases"), tree = root.find("tree");
    if (!meshes || !meshes->is_array() || meshes->size() == 0) return false;
    const auto needs = [&](Value part, const char* there, const char* missing) {
        return document.error(part.key_offset(), std::string("the scene has \"") + there + "\", but no \"" + missing +
                                                     "\"; add it, or remove \"" + there +
                                                     "\" to show the meshes alone");
    };
    if (tree && !phases) throw needs(*tree, "tree", "phases");
    if (phases && !tree) throw needs(*phases, "phases", "tree");
    return !tree;
}

bool has_meshes_alone(const Scene& scene) {
    return scene.placed.empty() && scene.phases.size() == 0 && !scene.meshes.empty();
}

Phased object_beside_meshes_alone() {
    // Rays that leave a mesh start at an offset from it, which grows with the object's diagonal once that exceeds a
    // metre (world/traced_geometry.cpp). This object is too small to matter.
    constexpr float size = 0.25f;
    return nothing_of_size(size);
}

void refuse_meshes_alone(const Document& document) {
    if (has_meshes_alone(document))
        throw document.error(
            document.root().find("meshes")->key_offset(),
            "the scene has only meshes, but this command needs an object: \"phases\" and \"tree\", or \"objects\"");
}

Bounds bounds_of(std::span<const Mesh> meshes) {
    Bounds box;
    for (const Mesh& mesh : meshes)
        for (const glm::vec3& v : mesh.vertices) box = unite(box, {v, v});
    return box;
}

}  // namespace phasetree::tracer
