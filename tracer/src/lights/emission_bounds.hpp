// What a lamp sends at most, and where to. Of several lamps together this tells roughly how much light they give at a
// point, without asking each: A. Conty Estevez, C. Kulla: Importance Sampling of Many Lights with Adaptive Tree
// Splitting, HPG 2018.
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
    /// Angles are in radians; the axis has unit length.
    EmissionCone(const glm::dvec3& axis, double normals, double edge);
    /// A plane surface that sends light to one side.
    static EmissionCone of_plane(const glm::dvec3& normal);
    /// A point that sends light into a cone of this half-angle, as if each direction within were a normal, θe = 0.
    static EmissionCone of_point(const glm::dvec3& axis, double half_angle) { return {axis, half_angle, 0.0}; }

    /// Holds both.
    friend EmissionCone merged(const EmissionCone& a, const EmissionCone& b);

    /// The greatest cosine between a normal and a direction in which light is sent, of all directions within a cone:
    /// that about the unit vector `towards` whose half-angle has this cosine and sine. It is 0 only if no light is
    /// sent there.
    double greatest_cosine(const glm::dvec3& towards, double cosine, double sine) const;

    /// How wide it is: Mω of the source, π of a plane and 4π of all directions.
    double measure() const;

  private:
    glm::dvec3 axis_{0, 0, 1};
    double cos_normals_ = -1, sin_normals_ = 0, cos_edge_ = 0;
};

struct EmissionBounds {
    BoundingSphere sphere;  ///< is around the lamps
    double intensity = 0;   ///< the luminance of the greatest radiant intensity that they send together, in W/sr
    EmissionCone cone{};

    /// Roughly the luminance that a receiver gets of the lamps if nothing is in the way: with its normal the
    /// irradiance, without it the fluence. It is 0 only where it gets nothing. Of a lamp that is much nearer than the
    /// others it knows nothing, so it may be far too low.
    double received(const LightReceiver& at) const;
};

/// Roughly the mean over a sphere's solid angle of the cosine to the normal, counted as 0 below the surface. It is 0
/// only where the whole sphere is below; seen from inside it is 1. The receiver has a normal.
double mean_cosine(const BoundingSphere& sphere, const LightReceiver& at);

}  // namespace phasetree::tracer
