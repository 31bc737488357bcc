// A procedural sky and its sun, from an atmospheric model (atmosphere.hpp).
//
// The sky is tabulated once as a lat-long image and is an image environment from then on, so radiance and sampling use
// the same table. Its lower half is diffuse ground of the given albedo in the same light, with haze towards the
// horizon.
//
// The unit is relative. One constant scales sun and sky such that white, diffuse, level ground has the luminance 1
// under a sun 45° high at turbidity 3. A lower sun is darker, as in reality. The sun above the atmosphere is white, so
// that full daylight is close to neutral and a low sun is warm.
#pragma once

#include <glm/glm.hpp>

#include "lights/image_environment.hpp"
#include "lights/sun.hpp"

namespace phasetree::tracer {

struct DaylightParameters {
    float sun_elevation_degrees = 45.0f;  ///< above the horizon, -90 to 90; down to about -8 there is twilight
    float sun_azimuth_degrees = 0.0f;     ///< clockwise from +y, see lat_long.hpp
    float sun_angular_diameter_degrees = Sun::real_angular_diameter_degrees;
    float turbidity = 3.0f;  ///< 1 to 10: 2 very clear, 3 clear, 6 hazy
    glm::vec3 ground_albedo{0.3f};
    float intensity = 1.0f;
};

struct Daylight {
    ImageEnvironment sky;
    Sun sun;  ///< black below the horizon
};

Daylight make_daylight(const DaylightParameters& parameters);

}  // namespace phasetree::tracer
