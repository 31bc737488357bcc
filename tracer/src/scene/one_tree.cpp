#include "scene/one_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ranges>

#include "phasetree/nodes/phased/over.hpp"
#include "phasetree/nodes/warps/affine.hpp"
#include "phasetree/nodes/warps/translate.hpp"

namespace phasetree::tracer {

namespace {

Phased placed(const Phased& tree, const Transform& t) {
    if (t == Transform()) return tree;
    if (t.matrix == glm::dmat3(1)) return warped(Translate{glm::vec3(t.by)}, tree);
    return warped(
        Affine{.x = glm::vec3(t.matrix[0]), .y = glm::vec3(t.matrix[1]), .z = glm::vec3(t.matrix[2]), .by = t.by},
        tree);
}

}  // namespace

Phased as_one_tree(const PlacedObjects& all, double time) {
    if (all.copies() > most_in_one_tree)
        throw ModelError(
            fmt::format("the scene has {} copies of objects, and a single tree can have at most {}; choose one object "
                        "with --object",
                        all.copies(), most_in_one_tree));
    std::vector<Phased> copies;
    all.each_copy(
        [&](std::uint32_t, const PlacedObject& object, const Transform& to_scene) {
            copies.push_back(placed(object.tree, to_scene));
            return true;
        },
        time);
    if (copies.size() == 1) return copies.front();
    return Over{.of = std::move(copies)};
}

}  // namespace phasetree::tracer
