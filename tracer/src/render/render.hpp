// From a scene to an image, on all cores.
#pragma once

#include <functional>

#include "camera/thin_lens.hpp"
#include "integrator/path.hpp"
#include "output/image.hpp"

namespace phasetree::tracer {

// Pixels [x0, x1) × [y0, y1) of the picture.
struct PixelRange {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
};

struct RenderJob {
    PixelRange pixels;
    int threads = 0;  // 0: as many as there are cores
    // Called with the samples done since the last call, from any thread.
    std::function<void(std::uint64_t)> advance = [](std::uint64_t) {};
    std::function<bool()> cancelled = [] { return false; };
};

struct Rendering {
    Image image;
    int samples = 0;  // per pixel that the image holds: fewer than asked if cancelled
    bool cancelled = false;
    double seconds = 0;
    int threads = 0;
    PathCounters counters;
};

// The same image bit for bit for any number of threads: a pixel's samples are numbered, seeded by pixel and number, and
// added in order. Works in passes over the whole image, so that a cancelled one is evenly done.
Rendering render(const World& world, const Scene& scene, const RenderJob& job);

}  // namespace phasetree::tracer
