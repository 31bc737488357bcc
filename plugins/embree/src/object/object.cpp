#include "object/object.hpp"

namespace phasetree::embree {

Object::Object(RTCDevice device, std::shared_ptr<const InterfaceCells> cells, SceneWithin when)
    : device_(device), cells_(std::move(cells)) {
    if (when == SceneWithin::at_once) build();
}

Object::~Object() = default;

const CellScene& Object::build() const {
    const std::lock_guard lock(building_);
    if (!owned_) {
        owned_ = std::make_unique<const CellScene>(device_, cells_);
        scene_.store(owned_.get(), std::memory_order_release);
    }
    return *owned_;
}

}  // namespace phasetree::embree
