// Bounds on how much light lamps send, and in which directions. They estimate what several lamps give at a point
// without asking each: A. Conty Estevez, C. Kulla: Importance Sampling of Many Lights with Adaptive Tree Splitting, HPG
// 2018.
#pragma once

#include <glm/glm.hpp>

#include "lights/bounding_sphere.hpp"
#include "lights/light_receiver.hpp"

namespace phasetree::tracer {

/// The directions in which lamps send light. Each of their surfaces has a normal within the angle θo of the axis, and
/// sends light up to the angle θe, at most a right one, from its normal.
class EmissionCone {
  public:
    /// All directions.
    EmissionCone() = default;
    /// θo and θe are in radians; the axis has unit length.
    EmissionCone(const glm::dvec3& axis, double normal_angle, double emission_angle);
    /// A plane surface that sends light to one side.
    static EmissionCone of_plane(const glm::dvec3& normal);
    /// A point that sends light into a cone of this half-angle. Each direction within counts as a normal, and θe is 0.
    static EmissionCone of_point(const glm::dvec3& axis, double half_angle) { return {axis, half_angle, 0.0}; }

    /// A cone that holds both; it is not always the smallest.
    friend EmissionCone merged(const EmissionCone& a, const EmissionCone& b);

    /// The greatest cosine between a surface normal and the direction in which it sends light, over all directions in a
    /// cone. That cone is about the unit vector `towards`; its half-angle has this cosine and sine. The result is 0
    /// only if no light is sent into it.
    double greatest_cosine(const glm::dvec3& towards, double cosine, double sine) const;

    /// The measure Mω of the source: π of a plane, 4π of all directions.
    double measure() const;

  private:
    glm::dvec3 axis_{0, 0, 1};
    double cos_normals_ = -1, sin_normals_ = 0, cos_emission_ = 0;
};

struct EmissionBounds {
    BoundingSphere sphere;  ///< holds the lamps
    double intensity = 0;   ///< an upper bound of the radiant intensity of all lamps together, as luminance, in W/sr
    EmissionCone cone{};

    /// Roughly the luminance that the receiver gets from the lamps if nothing is in the way: of the irradiance with a
    /// normal, of the fluence without. It is 0 only where no light arrives. Close to one of the lamps it may be far too
    /// low.
    double received(const LightReceiver& at) const;
};

/// Roughly the mean over a sphere's solid angle of the cosine to the receiver's normal, which it must have; counted as
/// 0 below the surface. It is 0 only where the whole sphere is below. Seen from inside it is 1.
double mean_cosine(const BoundingSphere& sphere, const LightReceiver& at);

}  // namespace phasetree::tracer
