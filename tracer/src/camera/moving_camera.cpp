#include "camera/moving_camera.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace phasetree::tracer {

MovingCamera::MovingCamera(const AnyCameraParameters& still, std::span<const CameraMoment> moments,
                           const glm::ivec2& resolution)
    : still_(still, resolution) {
    for (const CameraMoment& moment : moments) moments_.push_back({moment.time, Camera(moment.camera, resolution)});
}

CameraRay MovingCamera::generate_between(const glm::dvec2& film, const glm::vec2& lens, double time) const {
    const auto found = std::ranges::upper_bound(moments_, time, {}, &Moment::time);
    const auto after = std::clamp(found, moments_.begin() + 1, moments_.end() - 1);
    const Moment& before = *(after - 1);
    const double share = std::clamp((time - before.time) / (after->time - before.time), 0.0, 1.0);
    const CameraRay a = before.camera.generate(film, lens), b = after->camera.generate(film, lens);
    const auto between = [&](const glm::vec3& from, const glm::vec3& to) {
        return glm::mix(glm::dvec3(from), glm::dvec3(to), share);
    };
    return {glm::vec3(between(a.origin, b.origin)), glm::vec3(glm::normalize(between(a.direction, b.direction)))};
}

}  // namespace phasetree::tracer
