#include "view/prepared.hpp"

#include <algorithm>

#include "phasetree/nodes/phased/remove.hpp"

namespace phasetree::tracer::view {

Scene without_phases(const Scene& scene, const std::vector<std::string>& hidden) {
    PhaseSet gone;
    const std::vector<std::string>& names = scene.phases.names;
    for (std::size_t i = 1; i < names.size(); ++i)
        if (std::ranges::find(hidden, names[i]) != hidden.end())
            gone = gone | PhaseSet::of(Phase{static_cast<std::uint8_t>(i)});
    Scene result = scene;
    if (gone.bits != 0) result.object = Remove{.of = scene.object, .gone = gone};
    return result;
}

Prepared::Prepared(std::shared_ptr<const Scene> scene, const WorldOptions& options)
    : scene_(std::move(scene)), quality_(options.quality), world_(*scene_, options) {}

const InterfaceTracer& Prepared::tracer() const {
    std::call_once(once_, [&] { tracer_.emplace(scene_->object); });
    return *tracer_;
}

}  // namespace phasetree::tracer::view
