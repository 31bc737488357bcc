#include "view/prepared.hpp"

namespace phasetree::tracer::view {

Prepared::Prepared(std::shared_ptr<const Scene> scene, const WorldOptions& options)
    : scene_(std::move(scene)), is_first_look_(options.is_first_look), world_(*scene_, options) {}

const InterfaceTracer& Prepared::tracer() const {
    std::call_once(once_, [&] { tracer_.emplace(scene_->object); });
    return *tracer_;
}

}  // namespace phasetree::tracer::view
