// The parameters of "render" in a scene file: the size of the image, and how it is made.
#pragma once

#include "phasetree/io/kind.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

struct ImageParameters : RenderSettings {
    static constexpr KindInfo info{"render", "Size of the image and settings of the renderer."};

    int width = 1024;
    int height = 768;
    double frames_per_second = 24;

    template <class V>
    static void parameters(V&& v) {
        using P = ImageParameters;
        v(&P::width, Parameter{"width", "pixels", "Width of the image.", Limits{.low = 1, .high = 32768}, true});
        v(&P::height, Parameter{"height", "pixels", "Height of the image.", Limits{.low = 1, .high = 32768}, true});
        v(&P::frames_per_second,
          Parameter{"frames_per_second", "1/s",
                    "Frame rate of an animation: frame n, counted from 0, shows the time n / frames_per_second.",
                    Limits{.low = 0.001f, .high = 100000}, true});
        v(&P::shutter, Parameter{"shutter", "s",
                                 "Times at which the shutter opens and closes, relative to the time of the picture. "
                                 "Motion in between is blurred: transforms of objects and instances, the placements of "
                                 "meshes, and the camera.",
                                 Limits{.low = -1e6f, .high = 1e6f}, true});
        v(&P::samples, Parameter{"samples", "", "Samples per pixel.", Limits{.low = 1, .high = 1 << 24}, true});
        v(&P::noise, Parameter{"noise", "",
                               "Noise limit: blocks of 8×8 pixels stop early, after at least 32 samples per pixel, "
                               "once their estimated relative error is at most this; 0 turns this off.",
                               Limits{.low = 0, .high = 1}, true});
        v(&P::seed, Parameter{"seed", "", "Seed of the random numbers; a different seed gives different noise.",
                              limits::non_negative, true});
        v(&P::max_depth, Parameter{"max_depth", "",
                                   "Maximum number of interactions per path: surfaces, including interfaces between "
                                   "equal refractive indices, and scattering events in media.",
                                   Limits{.low = 1, .high = 1 << 20}, true});
        v(&P::spectral, Parameter{"spectral", "",
                                  "Whether to render with wavelengths, three per path, instead of red, green and blue. "
                                  "Metals, films on smooth surfaces, absorption and light then have their values at "
                                  "each wavelength; colours are replaced by spectra that look the same.",
                                  limits::any, true});
        v(&P::guiding, Parameter{"guiding", "",
                                 "Path guiding: whether to learn, before the first sample, where light comes from, and "
                                 "to send half of the paths from diffuse surfaces there. It pays off where most light "
                                 "is indirect, as in a room lit through the door of the next one.",
                                 limits::any, true});
        v(&P::caustics,
          Parameter{"caustics", "",
                    "Whether to use photons for caustics: light from lamps, glowing surfaces, the sun and bright parts "
                    "of environment maps that reaches surfaces and scattering media through clear materials or by "
                    "reflection from metal. Photons blur caustics by a pixel or two, less with more samples.",
                    limits::any, true});
        v(&P::photons,
          Parameter{"photons", "", "For caustics: photons per pixel and sample.", Limits{.low = 0, .high = 64}, true});
        v(&P::photon_radius,
          Parameter{"photon_radius", "pixels",
                    "For caustics: radius within which photons count for a point, in the first pass.",
                    Limits{.low = 0.01f, .high = 100}, true});
        v(&P::exposure_ev, Parameter{"exposure", "EV", "Exposure of display images; one stop more is twice as bright.",
                                     Limits{.low = -50, .high = 50}, true});
        v(&P::view, Parameter{"view", "", "OpenColorIO view of display images; by default that of the configuration.",
                              limits::any, true});
    }
};

}  // namespace phasetree::tracer
