#include "gltf/placed_meshes.hpp"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <optional>
#include <utility>

#include "gltf/accessor.hpp"

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

// A matrix for each instance of a node (EXT_mesh_gpu_instancing), or a single identity matrix.
class Instances {
  public:
    Instances(Accessors& accessors, const Item& node) {
        const auto instancing = node.extension("EXT_mesh_gpu_instancing");
        const auto attributes = instancing ? instancing->item("attributes") : std::nullopt;
        if (!attributes) return;
        const auto find = [&](const char* name, std::size_t columns) {
            std::optional<Accessor> found;
            if (!attributes->has(name)) return found;
            found.emplace(accessors.read(attributes->needed_index(name), *attributes));
            if (found->columns() != columns) found->fail("has rows of the wrong length for instances");
            if (count_ && *count_ != found->rows())
                found->fail("has a different number of rows than the other attributes of the instances");
            count_ = found->rows();
            return found;
        };
        translations_ = find("TRANSLATION", 3);
        rotations_ = find("ROTATION", 4);
        scales_ = find("SCALE", 3);
    }

    std::size_t count() const { return count_.value_or(1); }
    glm::dmat4 placement(std::size_t i) const {
        const auto of = [&](const std::optional<Accessor>& numbers, std::size_t column, double otherwise) {
            return numbers ? numbers->finite_number(i, column) : otherwise;
        };
        const auto vector = [&](const std::optional<Accessor>& numbers, double otherwise) {
            return glm::dvec3(of(numbers, 0, otherwise), of(numbers, 1, otherwise), of(numbers, 2, otherwise));
        };
        glm::dmat4 m = glm::translate(glm::dmat4(1), vector(translations_, 0));
        const glm::dquat rotation(of(rotations_, 3, 1), of(rotations_, 0, 0), of(rotations_, 1, 0),
                                  of(rotations_, 2, 0));
        if (glm::length(rotation) > 0) m = m * glm::mat4_cast(glm::normalize(rotation));
        return glm::scale(m, vector(scales_, 1));
    }

  private:
    std::optional<Accessor> translations_, rotations_, scales_;
    std::optional<std::size_t> count_;
};

constexpr std::size_t most_lights = 1000;

class Scene {
  public:
    Scene(Accessors& accessors, std::size_t most)
        : accessors_(accessors), document_(accessors.document()), most_(most), placements_(document_.count("nodes")) {}

    PlacedMeshes read() {
        const Item root = document_.root();
        if (document_.count("scenes") == 0) return {};
        add_nodes(document_.element("scenes", root.index("scene").value_or(0), root), "nodes", glm::dmat4(1), true);
        while (!next_.empty()) {
            const Next n = std::move(next_.back());
            next_.pop_back();
            const glm::dmat4 placement = n.placement * placement_of(n.node);
            placements_[n.number] = placement;
            // Hidden nodes are still placed, because they may be joints of skins.
            const auto visibility = n.node.extension("KHR_node_visibility");
            const bool is_visible = n.is_visible && (!visibility || visibility->flag("visible", true));
            const auto mesh = n.node.index("mesh");
            if (mesh && is_visible) add_mesh(*mesh, n.number, n.node, placement);
            if (const auto camera = n.node.index("camera")) placed_.cameras.push_back({*camera, placement});
            const auto light = n.node.extension("KHR_lights_punctual");
            if (light && is_visible && placed_.lights.size() < most_lights)
                placed_.lights.push_back({light->needed_index("light"), placement});
            placed_.has_hidden = placed_.has_hidden || (mesh && !is_visible);
            add_nodes(n.node, "children", placement, is_visible);
        }
        // A joint may come after the mesh.
        for (const auto& [placed, node] : with_skins_)
            placed_.meshes[placed].joints = joints(node.needed_index("skin"), node);
        return std::move(placed_);
    }

  private:
    struct Next {
        std::size_t number;
        Item node;
        glm::dmat4 placement;
        bool is_visible;
    };

    void add_nodes(const Item& parent, std::string_view list, const glm::dmat4& placement, bool is_visible) {
        const std::vector<std::size_t> children = parent.indices(list);
        for (auto child = children.rbegin(); child != children.rend(); ++child) {
            const Item node = document_.element("nodes", *child, parent);
            // Nodes must form trees, so each may occur only once. Otherwise a small file could contain any number of
            // meshes.
            if (placements_[*child]) node.fail("occurs twice in the node hierarchy");
            placements_[*child] = placement;
            next_.push_back({*child, node, placement, is_visible});
        }
    }

    void add_mesh(std::size_t mesh, std::size_t number, const Item& node, const glm::dmat4& placement) {
        const Item item = document_.element("meshes", mesh, node);
        const auto weights = weights_of(node.has("weights") ? node : item);
        const Instances instances(accessors_, node);
        for (std::size_t i = 0; i < instances.count(); ++i) {
            if (placed_.meshes.size() == most_) throw GltfError("it has too many meshes");
            if (node.has("skin")) with_skins_.emplace_back(placed_.meshes.size(), node);
            placed_.meshes.push_back({mesh, number, placement * instances.placement(i), nullptr, weights});
        }
    }

    static std::shared_ptr<const std::vector<float>> weights_of(const Item& item) {
        const auto weights = item.numbers("weights", item.count("weights"));
        if (!weights || std::ranges::all_of(*weights, [](float w) { return w == 0.0f; })) return nullptr;
        return std::make_shared<const std::vector<float>>(*weights);
    }

    std::shared_ptr<const Joints> joints(std::size_t skin, const Item& node) {
        std::shared_ptr<const Joints>& known = joints_[skin];
        if (known) return known;
        const Item item = document_.element("skins", skin, node);
        std::optional<Accessor> inverses;
        if (item.has("inverseBindMatrices"))
            inverses.emplace(accessors_.read(item.needed_index("inverseBindMatrices"), item));
        Joints joints;
        for (const std::size_t joint : item.indices("joints")) {
            if (joint >= placements_.size() || !placements_[joint]) item.fail("has a joint that is not in the scene");
            joints.push_back(*placements_[joint] * (inverses ? matrix(*inverses, joints.size()) : glm::dmat4(1)));
        }
        return known = std::make_shared<const Joints>(std::move(joints));
    }

    static glm::dmat4 matrix(const Accessor& accessor, std::size_t row) {
        if (accessor.columns() != 16) accessor.fail("has no matrices");
        if (row >= accessor.rows()) accessor.fail("has fewer matrices than joints");
        glm::dmat4 m;
        for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = accessor.number(row, static_cast<std::size_t>(i));
        return m;
    }

    Accessors& accessors_;
    const Document& document_;
    std::size_t most_;
    std::vector<std::optional<glm::dmat4>> placements_;  // of the nodes that were met
    std::vector<Next> next_;
    PlacedMeshes placed_;
    std::vector<std::pair<std::size_t, Item>> with_skins_;
    std::map<std::size_t, std::shared_ptr<const Joints>> joints_;
};

}  // namespace

PlacedMeshes placed_meshes(Accessors& accessors, std::size_t most) {
    return Scene(accessors, most).read();
}

}  // namespace phasetree::tracer::gltf
