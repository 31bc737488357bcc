// Placement of a file's content in the scene: it is scaled first, then rotated, then translated.
#pragma once

#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>

#include "phasetree/model/parameter.hpp"

namespace phasetree::tracer {

template <class P, class V>
void placement_parameters(V&& v) {
    v(&P::scale, Parameter{"scale", "", "Scale factor.", limits::positive, true});
    v(&P::rotate_z_degrees,
      Parameter{"rotate_z", "degrees", "Rotation about the z axis, anticlockwise as seen from above.", limits::any,
                true});
    v(&P::translate, Parameter{"translate", "m", "Translation: the image of the origin.", limits::any, true});
}
inline constexpr Parameter y_up_parameter{
    "y_up", "", "Whether y, and not z, is up in the file. This is converted first.", limits::any, true};

class Placement {
  public:
    Placement(float scale, float rotate_z_degrees, const glm::vec3& translate, bool y_up)
        : scale_(scale),
          translate_(translate),
          y_up_(y_up),
          cosine_(std::cos(glm::radians(rotate_z_degrees))),
          sine_(std::sin(glm::radians(rotate_z_degrees))) {}

    /// Rotates a direction, preserving its length.
    glm::vec3 turned(glm::vec3 p) const {
        if (y_up_) p = {p.x, -p.z, p.y};
        return {cosine_ * p.x - sine_ * p.y, sine_ * p.x + cosine_ * p.y, p.z};
    }
    glm::vec3 operator()(const glm::vec3& p) const { return turned(scale_ * p) + translate_; }
    /// The matrix of scaling and rotation, without the translation.
    glm::mat3 linear() const { return {turned({scale_, 0, 0}), turned({0, scale_, 0}), turned({0, 0, scale_})}; }
    const glm::vec3& translate() const { return translate_; }

  private:
    float scale_;
    glm::vec3 translate_;
    bool y_up_;
    float cosine_, sine_;
};

}  // namespace phasetree::tracer
