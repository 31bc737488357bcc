// Bounds on the emission of lamps and on its directions. They estimate the light of several lamps at a point without
// evaluating each: A. Conty Estevez, C. Kulla: Importance Sampling of Many Lights with Adaptive Tree Splitting, HPG
// 2018.
#pragma once

#include <glm/glm.hpp>

#include "lights/bounding_sphere.hpp"
#include "lights/light_receiver.hpp"

namespace phasetree::tracer {

/// The directions in which lamps emit. Each of their surfaces has a normal within the angle θo of the axis, and emits
/// up to the angle θe from its normal, which is at most a right angle.
class EmissionCone {
  public:
    /// All directions.
    EmissionCone() = default;
    /// θo and θe are in radians; the axis has unit length.
    EmissionCone(const glm::dvec3& axis, double normal_angle, double emission_angle);
    /// A plane surface that emits to one side.
    static EmissionCone of_plane(const glm::dvec3& normal);
    /// A point that emits into a cone of this half-angle. Each direction inside counts as a normal, and θe is 0.
    static EmissionCone of_point(const glm::dvec3& axis, double half_angle) { return {axis, half_angle, 0.0}; }

    /// A cone that contains both; not always the smallest.
    friend EmissionCone merged(const EmissionCone& a, const EmissionCone& b);

    /// The greatest cosine between a surface normal and a direction of emission within another cone. That cone has the
    /// axis `towards` (a unit vector) and a half-angle given by its `cosine` and `sine`. The result is 0 only if no
    /// light is emitted into it.
    double greatest_cosine(const glm::dvec3& towards, double cosine, double sine) const;

    /// The measure Mω of the reference: π for a plane, 4π for all directions.
    double measure() const;

  private:
    glm::dvec3 axis_{0, 0, 1};
    double cos_normals_ = -1, sin_normals_ = 0, cos_emission_ = 0;
};

struct EmissionBounds {
    BoundingSphere sphere;  ///< contains the lamps
    double intensity = 0;   ///< an upper bound on the radiant intensity of all lamps together, as luminance, in W/sr
    EmissionCone cone{};

    /// Approximately the luminance that the receiver gets from the lamps without occlusion: irradiance if it has a
    /// normal, otherwise fluence. It is 0 only where no light arrives. Close to one of the lamps it may be far too low.
    double received(const LightReceiver& at) const;
};

/// Approximately the mean, over the solid angle of a sphere, of the cosine to the receiver's normal, clamped at 0. The
/// receiver must have a normal. The result is 0 only if the whole sphere is below the surface, and 1 inside the sphere.
double mean_cosine(const BoundingSphere& sphere, const LightReceiver& at);

}  // namespace phasetree::tracer
