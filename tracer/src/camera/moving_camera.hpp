// A camera that may move while the shutter is open.
#pragma once

#include <span>
#include <vector>

#include "camera/camera.hpp"

namespace phasetree::tracer {

/// The parameters of a camera at a share of the shutter interval.
struct CameraMoment {
    double time = 0;
    AnyCameraParameters camera{};
};

/// Between two moments, origin and direction of a ray are interpolated between those of the two rays for the same point
/// of the film and of the lens. Moments are close enough to each other for that (scene/shutter.hpp).
class MovingCamera {
  public:
    /// `moments` is empty for a camera that does not move. Otherwise it has at least two, at increasing times from 0 to
    /// 1.
    MovingCamera(const AnyCameraParameters& still, std::span<const CameraMoment> moments, const glm::ivec2& resolution);

    CameraRay generate(const glm::dvec2& film, const glm::vec2& lens, double time = 0) const {
        return moments_.empty() ? still_.generate(film, lens) : generate_between(film, lens, time);
    }
    /// The point from which all rays start at any time, if there is one.
    std::optional<glm::vec3> single_origin() const { return moments_.empty() ? still_.single_origin() : std::nullopt; }

  private:
    CameraRay generate_between(const glm::dvec2& film, const glm::vec2& lens, double time) const;

    struct Moment {
        double time;
        Camera camera;
    };
    Camera still_;
    std::vector<Moment> moments_;
};

}  // namespace phasetree::tracer
