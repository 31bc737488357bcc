// The list of all cameras, and a camera of any kind by value.
#pragma once

#include <variant>

#include "camera/contract.hpp"
#include "camera/dome.hpp"
#include "camera/orthographic.hpp"
#include "camera/panorama.hpp"
#include "camera/thin_lens.hpp"
#include "camera/tilt_shift.hpp"

namespace phasetree::tracer {

template <CameraKind... Kinds>
struct CameraList {
    using Any = std::variant<Kinds...>;
    using AnyParameters = std::variant<typename Kinds::Parameters...>;
};

/// Every kind of camera.
using Cameras = CameraList<ThinLens, Orthographic, TiltShift, Panorama, Dome>;

/// The description of a camera in a scene.
using AnyCameraParameters = Cameras::AnyParameters;

glm::vec3 position_of(const AnyCameraParameters& parameters);
glm::vec3 look_at_of(const AnyCameraParameters& parameters);

/// See CameraKind for the members.
class Camera {
  public:
    Camera(const AnyCameraParameters& parameters, const glm::ivec2& resolution);

    CameraRay generate(const glm::dvec2& film, const glm::vec2& lens) const {
        return std::visit([&](const auto& kind) { return kind.generate(film, lens); }, kind_);
    }
    std::optional<glm::vec3> single_origin() const {
        return std::visit([](const auto& kind) { return kind.single_origin(); }, kind_);
    }

  private:
    Cameras::Any kind_;
};

}  // namespace phasetree::tracer
