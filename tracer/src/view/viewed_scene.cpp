#include "view/viewed_scene.hpp"

namespace phasetree::tracer::view {

std::optional<NodePlace> ViewedScene::place_of(const void* node) const {
    std::optional<NodePlace> place = places.find(node);
    if (!place || !file || place->file != file->name()) return place;
    place->offset = offset_in_original(*file, edits, place->offset);
    const SceneError there = file->error(place->offset, "");
    place->line = there.line();
    place->column = there.column();
    return place;
}

}  // namespace phasetree::tracer::view
