// From a scene to an image, on all cores.
#pragma once

#include <functional>

#include "film/film.hpp"
#include "film/image.hpp"
#include "integrator/path.hpp"

namespace phasetree::tracer {

struct RenderJob {
    PixelRange pixels;
    int threads = 0;  ///< 0: as many as there are cores
    /// Called with the samples done since the last call, from any thread.
    std::function<void(std::uint64_t)> advance = [](std::uint64_t) {};
    std::function<bool()> cancelled = [] { return false; };
    /// Called after each whole pass with how many samples each pixel has by then; nothing is added meanwhile.
    std::function<void(const Film&, int)> passed = [](const Film&, int) {};
};

struct Rendering {
    Image image;
    int samples = 0;  ///< in each pixel of the image at least: fewer than asked if the rendering was cancelled
    FilmFaults faults;
    bool cancelled = false;
    double seconds = 0;
    int threads = 0;
    PathCounters counters;
};

/// Gives the same image bit for bit for any number of threads: a pixel's samples are numbered and seeded by pixel and
/// number, and the film's sums do not depend on their order. Works in passes over the whole image, so that a cancelled
/// one is evenly done: no pixel is further ahead than by one pass.
Rendering render(const World& world, const Scene& scene, const RenderJob& job);

}  // namespace phasetree::tracer
