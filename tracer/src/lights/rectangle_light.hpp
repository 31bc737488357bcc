// A rectangle that emits the radiance L uniformly to one side, the side of its normal. From behind it does not exist:
// it neither emits nor hides anything.
//
// Sampled uniformly in the solid angle it subtends, p = 1/Ω: Ureña, Fajardo, King: An Area-Preserving Parametrization
// for Spherical Rectangles, EGSR 2013. The angles are computed by atan2 of exact sines instead of acos, which keeps
// them precise when the point is close to the rectangle's plane. If Ω < 1e-9, rounding in the parametrisation would
// dominate, so points are sampled uniformly in area instead, p = d²/(A cos θ).
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <optional>

#include "lights/bounding_sphere.hpp"
#include "lights/direction_sample.hpp"
#include "lights/emission_bounds.hpp"
#include "lights/surface_point.hpp"
#include "parameters/world_limits.hpp"
#include "phasetree/io/kind.hpp"

namespace phasetree::tracer {

class RectangleLight {
  public:
    // The full edges, perpendicular to each other; the normal is cross(edge_u, edge_v).
    RectangleLight(const glm::vec3& centre, const glm::vec3& edge_u, const glm::vec3& edge_v, const glm::vec3& radiance,
                   bool visible_to_camera = true);

    // Faces `target`, with a horizontal width (along x if it faces straight up or down).
    static RectangleLight facing(const glm::vec3& centre, const glm::vec3& target, float width, float height,
                                 const glm::vec3& radiance, bool visible_to_camera = true);

    const glm::vec3& radiance() const { return radiance_; }
    bool visible_to_camera() const { return visible_to_camera_; }
    glm::vec3 normal() const { return axis_n_; }

    // Solid angle in steradians at p; 0 from behind.
    double solid_angle(const glm::vec3& p) const;
    // Approximates solid_angle() without trigonometric functions, for a choice among lights. 0 where solid_angle() is
    // 0.
    double approximate_solid_angle(const glm::vec3& p) const;
    BoundingSphere bounding_sphere() const {
        return {glm::vec3(centre_), static_cast<float>(std::sqrt(half_u_ * half_u_ + half_v_ * half_v_))};
    }
    EmissionBounds emission_bounds() const;
    // Samples a direction from p towards the light; p must see it.
    DirectionSample sample(const glm::vec3& p, const glm::vec2& u) const;
    // The pdf of sample() per steradian, for a direction in which the light is met at that distance.
    float pdf_at(const glm::vec3& p, const glm::vec3& direction, float distance) const;
    // The distance at which a ray meets the emitting side.
    std::optional<float> intersect(const glm::vec3& origin, const glm::vec3& direction) const;

    // See AreaLightKind.
    SurfacePoint surface_point(const glm::vec2& u) const;
    glm::vec3 normal_at(const glm::vec3& /*point*/) const { return normal(); }
    float area() const { return static_cast<float>(area_); }

  private:
    struct View;
    View seen_from(const glm::vec3& p) const;
    double density(const View& view, double distance, double cosine) const;

    glm::dvec3 centre_;
    glm::dvec3 axis_u_, axis_v_, axis_n_;  // orthonormal
    double half_u_, half_v_;
    double area_, disk_radius_;  // of a disk of the same area
    glm::vec3 radiance_;
    bool visible_to_camera_;
};

// Parameters in a scene file.
struct RectangleLightParameters {
    static constexpr KindInfo info{"rectangle", "A rectangle that emits on one side and is invisible from behind."};

    glm::vec3 centre{0.0f};
    glm::vec3 target{0.0f};
    float width = 1.0f;
    float height = 1.0f;
    glm::vec3 radiance{1.0f};
    float intensity = 1.0f;
    bool visible_to_camera = true;

    template <class V>
    static void parameters(V&& v) {
        using P = RectangleLightParameters;
        v(&P::centre, Parameter{"centre", "m", "Its centre.", coordinate});
        v(&P::target, Parameter{"target", "m", "Point that the light faces.", coordinate});
        v(&P::width,
          Parameter{"width", "m", "Length of the horizontal edge; along x if the light faces up or down.", extent});
        v(&P::height, Parameter{"height", "m", "Length of the other edge.", extent});
        v(&P::radiance,
          ColourParameter{{"radiance", "", "Radiance of the emitting side.", limits::non_negative, true}});
        v(&P::intensity, Parameter{"intensity", "", "Factor applied to the radiance.", limits::non_negative, true});
        v(&P::visible_to_camera,
          Parameter{"visible_to_camera", "", "Whether the camera sees the light directly.", limits::any, true});
    }
    RectangleLight made() const {
        if (!(glm::length(target - centre) > 0))
            throw ParameterError("target", "\"target\" must differ from the light's centre");
        return RectangleLight::facing(centre, target, width, height, radiance * intensity, visible_to_camera);
    }
};

}  // namespace phasetree::tracer
