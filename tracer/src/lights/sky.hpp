// Daylight in a scene file: the light of the sky and, optionally, of the sun if it is above the horizon.
#pragma once

#include <vector>

#include "lights/daylight.hpp"
#include "lights/lights.hpp"
#include "phasetree/io/kind.hpp"

namespace phasetree::tracer {

struct SkyParameters : DaylightParameters {
    static constexpr KindInfo info{
        "sky",
        "A clear sky, its sun, and the ground below, by a model of the atmosphere. White level ground has the "
        "luminance 1 under a sun 45° high at turbidity 3."};

    bool sun = true;

    template <class V>
    static void parameters(V&& v) {
        using P = SkyParameters;
        v(&P::sun_elevation_degrees,
          Parameter{"sun_elevation", "degrees", "Height of the sun above the horizon; down to −8 there is twilight.",
                    Limits{.low = -90, .high = 90}, true});
        v(&P::sun_azimuth_degrees, Parameter{"sun_azimuth", "degrees", "Direction of the sun, clockwise from +y.",
                                             Limits{.low = -1e6f, .high = 1e6f}, true});
        v(&P::sun_angular_diameter_degrees, Parameter{"sun_diameter", "degrees", "Angular diameter of the sun.",
                                                      Limits{.low = 0, .high = 90, .low_open = true}, true});
        v(&P::turbidity,
          Parameter{"turbidity", "", "Haze: 2 is very clear, 3 clear, 6 hazy.", Limits{.low = 1, .high = 10}, true});
        v(&P::ground_albedo,
          ColourParameter{{"ground", "", "Reflectance of the ground, which is diffuse.", limits::fraction, true}});
        v(&P::intensity, Parameter{"intensity", "", "A factor of all of it.", Limits{.low = 0, .high = 1e30f}, true});
        v(&P::sun, Parameter{"sun", "", "Whether the sun itself shines, too.", limits::any, true});
    }
    std::vector<InfiniteLight> made() const {
        Daylight daylight = make_daylight(*this);
        std::vector<InfiniteLight> lights{std::move(daylight.sky)};
        if (sun && sun_elevation_degrees > -sun_angular_diameter_degrees) lights.emplace_back(daylight.sun);
        return lights;
    }
};

}  // namespace phasetree::tracer
