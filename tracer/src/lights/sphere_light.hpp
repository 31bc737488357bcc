// A sphere whose surface emits the radiance L uniformly, outwards and inwards.
//
// From outside, at distance d, it fills the cone of half-angle α = asin(r/d), which is sampled uniformly:
// p = 1/(2π(1 − cos α)). From inside it fills the whole sphere of directions: p = 1/(4π). A surface element at distance
// d that sees all of it receives E = πL (r/d)² cos θ.
//
// Directions are floats, so one that was sampled in the cone may pass the ball by a rounding error. The ball therefore
// reaches that much farther, 2·10⁻⁷ d, where it is asked what a ray meets: otherwise the light of what was sampled
// there would be lost, a hundredth of it from a ball that is seen 10⁻⁴ degrees large. What a surface receives from the
// light by sampling it is right for the smallest of balls. In a mirror they look larger than they are: one of 10⁻³
// degrees has five per cent more area there.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "lights/bounding_sphere.hpp"
#include "lights/direction_sample.hpp"
#include "lights/emission_bounds.hpp"
#include "lights/surface_point.hpp"
#include "parameters/world_limits.hpp"
#include "phasetree/io/kind.hpp"

namespace phasetree::tracer {

class SphereLight {
  public:
    SphereLight(const glm::vec3& centre, float radius, const glm::vec3& radiance, bool visible_to_camera = true);

    const glm::vec3& radiance() const { return radiance_; }
    bool visible_to_camera() const { return visible_to_camera_; }

    // Steradians seen from p.
    double solid_angle(const glm::vec3& p) const;
    double approximate_solid_angle(const glm::vec3& p) const { return solid_angle(p); }
    BoundingSphere bounding_sphere() const { return {glm::vec3(centre_), static_cast<float>(radius_)}; }
    EmissionBounds emission_bounds() const;
    // A direction from p towards the light.
    DirectionSample sample(const glm::vec3& p, const glm::vec2& u) const;
    // The density of sample() per steradian, for a direction in which the light is met, at that distance.
    float pdf_at(const glm::vec3& p, const glm::vec3& direction, float distance) const;
    // The distance at which a ray first meets the surface.
    std::optional<float> intersect(const glm::vec3& origin, const glm::vec3& direction) const;

    // As AreaLightKind has them; of the outer side.
    glm::vec3 centre() const { return centre_; }
    SurfacePoint surface_point(const glm::vec2& u) const;
    glm::vec3 normal_at(const glm::vec3& point) const;
    float area() const;

  private:
    double cap_height(const glm::dvec3& to_centre) const;

    glm::dvec3 centre_;
    double radius_;
    glm::vec3 radiance_;
    bool visible_to_camera_;
};

// What a scene file says of a ball that shines, but for where it is.
struct ShiningBallParameters {
    float radius = 1.0f;
    glm::vec3 radiance{1.0f};
    float intensity = 1.0f;
    bool visible_to_camera = true;

    template <class V>
    static void parameters(V&& v) {
        using P = ShiningBallParameters;
        v(&P::radius, Parameter{"radius", "m", "Radius of a ball.", extent});
        v(&P::radiance, ColourParameter{{"radiance", "", "Radiance of the surface.", limits::non_negative, true}});
        v(&P::intensity, Parameter{"intensity", "", "A factor of the radiance.", limits::non_negative, true});
        v(&P::visible_to_camera,
          Parameter{"visible_to_camera", "", "Whether the camera sees the light by itself.", limits::any, true});
    }
    SphereLight made_at(const glm::vec3& centre) const {
        return SphereLight(centre, radius, radiance * intensity, visible_to_camera);
    }
};

// As a scene file says it.
struct SphereLightParameters : ShiningBallParameters {
    static constexpr KindInfo info{"sphere", "A ball that shines."};

    glm::vec3 centre{0.0f};

    template <class V>
    static void parameters(V&& v) {
        v(&SphereLightParameters::centre, Parameter{"centre", "m", "Its centre.", coordinate});
        ShiningBallParameters::parameters(v);
    }
    SphereLight made() const { return made_at(centre); }
};

}  // namespace phasetree::tracer
