// The parameters of "render" in a scene file: the size of the image, and how it is made.
#pragma once

#include "phasetree/io/kind.hpp"
#include "scene/scene.hpp"

namespace phasetree::tracer {

struct ImageParameters : RenderSettings {
    static constexpr KindInfo info{"render", "How large the image is, and how it is made."};

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
                    "Of a film: frame n, from 0, shows the scene as it is n over this after its beginning.",
                    Limits{.low = 0.001f, .high = 100000}, true});
        v(&P::shutter, Parameter{"shutter", "s",
                                 "When the shutter opens and closes, from the time of the picture. What moves "
                                 "meanwhile is blurred: transforms of objects and instances, and the camera.",
                                 Limits{.low = -1e6f, .high = 1e6f}, true});
        v(&P::samples, Parameter{"samples", "", "Paths of each pixel.", Limits{.low = 1, .high = 1 << 24}, true});
        v(&P::noise, Parameter{"noise", "",
                               "Pixels stop before that where their relative error is estimated to be at most this, "
                               "after 32 samples at the earliest; 0 if none is to stop.",
                               Limits{.low = 0, .high = 1}, true});
        v(&P::seed, Parameter{"seed", "", "Another whole number gives other noise.", limits::non_negative, true});
        v(&P::max_depth,
          Parameter{"max_depth", "", "The most surfaces that a path meets. One between equal indices counts, too.",
                    Limits{.low = 1, .high = 1 << 20}, true});
        v(&P::spectral,
          Parameter{"spectral", "",
                    "Whether light has wavelengths instead of red, green and blue, three on each path. "
                    "Metals, films on smooth surfaces, absorption and light then are what they are at each "
                    "wavelength; colours are spectra that look like them.",
                    limits::any, true});
        v(&P::guiding, Parameter{"guiding", "",
                                 "Whether paths learn where light comes from before the first sample, so that half "
                                 "of them go there from diffuse surfaces. It pays where most light has been scattered "
                                 "several times, as in a room that is lit through a door from the next one.",
                                 limits::any, true});
        v(&P::caustics, Parameter{"caustics", "",
                                  "Whether photons look for the light that lamps, surfaces that glow, the sun and the "
                                  "bright parts of environment images throw through clear surfaces, curved or rough, "
                                  "and by metal onto other surfaces and into media that scatter. "
                                  "They blur it by a pixel or two, less with more samples.",
                                  limits::any, true});
        v(&P::photons, Parameter{"photons", "", "For caustics: photons for each pixel and sample.",
                                 Limits{.low = 0, .high = 64}, true});
        v(&P::photon_radius,
          Parameter{"photon_radius", "pixels",
                    "For caustics: how far around a point photons count as light on it, in the first pass.",
                    Limits{.low = 0.01f, .high = 100}, true});
        v(&P::exposure_ev, Parameter{"exposure", "EV", "Brightness of pictures; one more is twice as bright.",
                                     Limits{.low = -50, .high = 50}, true});
        v(&P::view,
          Parameter{"view", "", "View of the display transform; the default one without it.", limits::any, true});
    }
};

}  // namespace phasetree::tracer
