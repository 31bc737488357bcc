#include "gltf/placed_meshes.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <utility>

namespace phasetree::tracer::gltf {

namespace {

glm::dmat4 placement_of(const Item& node) {
    glm::dmat4 m(1);
    if (const auto numbers = node.numbers("matrix", 16)) {
        for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = static_cast<double>((*numbers)[static_cast<std::size_t>(i)]);
        return m;
    }
    m = glm::translate(m, glm::dvec3(node.vec3("translation", glm::vec3(0))));
    if (const auto q = node.numbers("rotation", 4)) {
        // x, y, z, w; glm has w first.
        const glm::dquat rotation((*q)[3], (*q)[0], (*q)[1], (*q)[2]);
        if (!(glm::length(rotation) > 0)) node.fail("has a rotation of length 0");
        m = m * glm::mat4_cast(glm::normalize(rotation));
    }
    return glm::scale(m, glm::dvec3(node.vec3("scale", glm::vec3(1))));
}

}  // namespace

std::vector<PlacedMesh> placed_meshes(const Document& document) {
    const Item root = document.root();
    std::vector<PlacedMesh> placed;
    if (document.count("scenes") == 0) return placed;
    const Item scene = document.element("scenes", root.index("scene").value_or(0), root);

    struct Next {
        Item node;
        glm::dmat4 placement;
    };
    std::vector<Next> next;
    // Nodes are trees, so each is met once. Without that a small file could hold endlessly many.
    std::vector<bool> is_met(document.count("nodes"), false);
    const auto add = [&](const Item& parent, std::string_view list, const glm::dmat4& placement) {
        const std::vector<std::size_t> children = parent.indices(list);
        for (auto child = children.rbegin(); child != children.rend(); ++child) {
            const Item node = document.element("nodes", *child, parent);
            if (is_met[*child]) node.fail("is at two places of the tree of nodes");
            is_met[*child] = true;
            next.push_back({node, placement});
        }
    };
    add(scene, "nodes", glm::dmat4(1));
    while (!next.empty()) {
        const Next n = std::move(next.back());
        next.pop_back();
        const Item& node = n.node;
        const glm::dmat4 placement = n.placement * placement_of(node);
        if (const auto mesh = node.index("mesh")) {
            (void)document.element("meshes", *mesh, node);
            const bool is_skinned = node.has("skin");
            placed.push_back({*mesh, is_skinned ? glm::dmat4(1) : placement, is_skinned});
        }
        add(node, "children", placement);
    }
    return placed;
}

}  // namespace phasetree::tracer::gltf
