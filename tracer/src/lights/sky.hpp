// Daylight in a scene file: the light of the sky and, optionally, of the sun if it is above the horizon.
#pragma once

#include <vector>

#include "lights/daylight.hpp"
#include "lights/lights.hpp"
#include "phasetree/io/kind.hpp"

namespace phasetree::tracer {

struct SkyParameters : DaylightParameters {
    static constexpr KindInfo info{"sky",
                                   "A clear sky with its sun and the ground below, from a model of the atmosphere. "
                                   "White level ground has luminance 1 with the sun 45° high and turbidity 3."};

    bool sun = true;

    template <class V>
    static void parameters(V&& v) {
        using P = SkyParameters;
        v(&P::sun_elevation_degrees,
          Parameter{"sun_elevation", "degrees", "Elevation of the sun above the horizon; there is twilight down to −8.",
                    Limits{.low = -90, .high = 90}, true});
        v(&P::sun_azimuth_degrees, Parameter{"sun_azimuth", "degrees", "Direction of the sun, clockwise from +y.",
                                             Limits{.low = -1e6f, .high = 1e6f}, true});
        v(&P::sun_angular_diameter_degrees, Parameter{"sun_diameter", "degrees", "Angular diameter of the sun.",
                                                      Limits{.low = 0, .high = 90, .low_open = true}, true});
        v(&P::turbidity,
          Parameter{"turbidity", "", "Haze: 2 is very clear, 3 clear, 6 hazy.", Limits{.low = 1, .high = 10}, true});
        v(&P::ground_albedo,
          ColourParameter{{"ground", "", "Reflectance of the ground, which is diffuse.", limits::fraction, true}});
        v(&P::intensity,
          Parameter{"intensity", "", "Factor applied to sky, sun and ground.", Limits{.low = 0, .high = 1e30f}, true});
        v(&P::sun, Parameter{"sun", "", "Whether to include the sun itself.", limits::any, true});
    }
    std::vector<InfiniteLight> made() const {
        Daylight daylight = make_daylight(*this);
        std::vector<InfiniteLight> lights{std::move(daylight.sky)};
        if (sun && sun_elevation_degrees > -sun_angular_diameter_degrees) lights.emplace_back(daylight.sun);
        return lights;
    }
};

}  // namespace phasetree::tracer
