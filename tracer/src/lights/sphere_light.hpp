// A sphere whose surface emits the radiance L uniformly, outwards and inwards.
//
// From outside, at distance d, it subtends the cone of half-angle α = asin(r/d), which is sampled uniformly: p =
// 1/(2π(1 − cos α)). From inside it subtends the whole sphere of directions: p = 1/(4π). A surface element at distance
// d that sees all of it receives E = πL (r/d)² cos θ.
//
// Directions are floats, so one that was sampled in the cone may miss the ball by a rounding error. Intersections
// therefore use a radius that is larger by 2·10⁻⁷ d. Otherwise samples would be lost: a hundredth of the light from a
// ball with an angular diameter of 10⁻⁴ degrees. Sampled light is right even for the smallest balls. In a mirror, they
// look larger than they are: one of 10⁻³ degrees has five per cent more area there.
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

    // Solid angle in steradians at p.
    double solid_angle(const glm::vec3& p) const;
    double approximate_solid_angle(const glm::vec3& p) const { return solid_angle(p); }
    BoundingSphere bounding_sphere() const { return {glm::vec3(centre_), static_cast<float>(radius_)}; }
    EmissionBounds emission_bounds() const;
    // Samples a direction from p towards the light.
    DirectionSample sample(const glm::vec3& p, const glm::vec2& u) const;
    // The pdf of sample() per steradian, for a direction in which the light is met at that distance.
    float pdf_at(const glm::vec3& p, const glm::vec3& direction, float distance) const;
    // The distance at which a ray first meets the surface.
    std::optional<float> intersect(const glm::vec3& origin, const glm::vec3& direction) const;

    // See AreaLightKind; these refer to the outer side.
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

// Parameters of an emissive ball in a scene file, except its position.
struct SphereEmissionParameters {
    float radius = 1.0f;
    glm::vec3 radiance{1.0f};
    float intensity = 1.0f;
    bool visible_to_camera = true;

    template <class V>
    static void parameters(V&& v) {
        using P = SphereEmissionParameters;
        v(&P::radius, Parameter{"radius", "m", "Radius of a sphere.", extent});
        v(&P::radiance, ColourParameter{{"radiance", "", "Radiance of the surface.", limits::non_negative, true}});
        v(&P::intensity, Parameter{"intensity", "", "Factor applied to the radiance.", limits::non_negative, true});
        v(&P::visible_to_camera,
          Parameter{"visible_to_camera", "", "Whether the camera sees the light directly.", limits::any, true});
    }
    SphereLight made_at(const glm::vec3& centre) const {
        return SphereLight(centre, radius, radiance * intensity, visible_to_camera);
    }
};

// Parameters in a scene file.
struct SphereLightParameters : SphereEmissionParameters {
    static constexpr KindInfo info{"sphere", "A sphere that emits light."};

    glm::vec3 centre{0.0f};

    template <class V>
    static void parameters(V&& v) {
        v(&SphereLightParameters::centre, Parameter{"centre", "m", "Its centre.", coordinate});
        SphereEmissionParameters::parameters(v);
    }
    SphereLight made() const { return made_at(centre); }
};

}  // namespace phasetree::tracer
