// Generates the camera rays of a picture's paths.
#pragma once

#include <optional>

#include "camera/moving_camera.hpp"
#include "sampling/sobol.hpp"
#include "world/world.hpp"

namespace phasetree::tracer {

class CameraPaths {
  public:
    /// Refers to the world and the scene.
    CameraPaths(const World& world, const Scene& scene)
        : geometry_(world.geometry()), camera_(scene.camera, scene.camera_moments, scene.film.resolution()) {
        const auto origin = camera_.single_origin();
        if (origin && !scene.moves()) single_ = geometry_.inside(*origin);
    }

    /// The first ray of a path through a point of the film, in pixels, at a time from 0 to 1 of the shutter interval.
    Ray first_ray(const glm::dvec2& on_film, float time, Sampler& sampler) const {
        const CameraRay ray = camera_.generate(on_film, sampler.next2(), static_cast<double>(time));
        const TracedGeometry::Inside start = single_ ? *single_ : geometry_.inside(ray.origin, time);
        return {ray.origin, ray.direction, start.phase, {}, start.in};
    }

  private:
    const TracedGeometry& geometry_;
    MovingCamera camera_;
    // What contains a camera whose rays all start at one point, computed once.
    std::optional<TracedGeometry::Inside> single_;
};

}  // namespace phasetree::tracer
