#include "phasetree/io/node_places.hpp"

namespace phasetree {

namespace {

const void* address_of(const NodePlaces::Node& node) {
    return std::visit([](const auto& handle) -> const void* { return handle.node(); }, node);
}

}  // namespace

void NodePlaces::add(const Node& node, const Document& document, std::size_t offset) {
    places_.insert_or_assign(address_of(node), Place{node, document, offset});
}

void NodePlaces::add_copy(const void* of, const Node& copy) {
    const auto found = places_.find(of);
    if (found == places_.end()) return;
    const Place place = found->second;
    add(copy, place.document, place.offset);
}

std::optional<NodePlace> NodePlaces::find(const void* node) const {
    const auto found = places_.find(node);
    if (found == places_.end()) return std::nullopt;
    const Place& place = found->second;
    // SceneError computes lines and columns.
    const SceneError there = place.document.error(place.offset, "");
    return NodePlace{place.document.name(), place.offset, there.line(), there.column()};
}

}  // namespace phasetree
