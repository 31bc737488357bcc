#include "scene/unbounded_error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "phasetree/io/tree.hpp"
#include "phasetree/tree/unbounded.hpp"
#include "scene/read_parts.hpp"

namespace phasetree::tracer {

SceneError unbounded_error(const Document& document, const Phased& tree, const NodePlaces& places,
                           std::string_view before) {
    const std::vector<UnboundedPart> parts = unbounded_parts(tree);
    std::size_t offset = document.root().offset();
    std::vector<std::string> others;
    for (const UnboundedPart& part : parts) {
        const void* const node = std::visit([](const auto& n) -> const void* { return n.node(); }, part.node);
        const std::optional<NodePlace> place = places.find(node);
        if (!place) continue;
        if (&part == &parts.front())
            offset = place->offset;
        else
            others.push_back(fmt::format("\"{}\" at {}:{}", part.kind, place->line, place->column));
    }
    if (parts.empty()) return document.error(offset, fmt::format("{}the object is unbounded", before));
    const std::string also =
        others.empty() ? ""
                       : fmt::format(" (as {} {})", others.size() == 1 ? "does" : "do", fmt::join(others, " and "));
    return document.error(offset, fmt::format("{}this \"{}\" makes the object unbounded{}; {}", before,
                                              parts.front().kind, also, how_to_bound(parts.front())));
}

SceneError unbounded_error(const Document& document) {
    NodePlaces places;
    const SceneTree again = read_tree(document, file_readers(), &places);
    return unbounded_error(document, again.object, places);
}

SceneError object_error(const Document& document, Value value, const ModelError& error) {
    const bool is_unbounded = dynamic_cast<const UnboundedError*>(&error) != nullptr;
    if (is_unbounded && !document.root().find("objects") && document.root().find("tree"))
        return unbounded_error(document);
    return document.error(value, error.what());
}

}  // namespace phasetree::tracer
