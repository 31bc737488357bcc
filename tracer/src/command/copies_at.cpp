#include "command/copies_at.hpp"

#include <fmt/format.h>

#include "command/numbers.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/program/program.hpp"

namespace phasetree::tracer {

CopiesAt::CopiesAt(const PlacedObjects& placed) : placed_(placed) {
    std::vector<Bounds> boxes;
    for (const PlacedObject& object : placed.objects) {
        boxes.push_back(phasetree::bounds(object.tree));
        evaluators_.emplace_back(record(object.tree));
    }
    placed.each_copy([&](std::uint32_t, const PlacedObject& object, const Transform& to_scene) {
        const auto number = static_cast<std::size_t>(&object - placed.objects.data());
        copies_.push_back({to_scene.image(boxes[number]), to_scene.inverse(), static_cast<std::uint32_t>(number)});
        return true;
    });
}

std::string CopiesAt::columns(const glm::vec3& p) const {
    for (std::size_t number = 0; number < copies_.size(); ++number) {
        const Copy& copy = copies_[number];
        if (copy.bounds.contains(p) &&
            evaluators_[copy.object].label(glm::vec3(copy.to_object(p)), Evaluator::thread_workspace()) !=
                phasetree::vacuum)
            return fmt::format(",{},{}", csv_cell(placed_.objects[copy.object].name), number);
    }
    return ",,";
}

}  // namespace phasetree::tracer
