#include "phasetree/io/node_places.hpp"

namespace phasetree {

std::optional<NodePlace> NodePlaces::find(const void* node) const {
    const auto found = places_.find(node);
    if (found == places_.end()) return std::nullopt;
    const auto& [document, offset] = found->second;
    // An error knows how lines and columns are counted.
    const SceneError there = document.error(offset, "");
    return NodePlace{document.name(), offset, there.line(), there.column()};
}

}  // namespace phasetree
