// From a scene to an image, on all cores.
#pragma once

#include <functional>
#include <optional>

#include "film/film.hpp"
#include "film/image.hpp"
#include "film/sample_range.hpp"
#include "integrator/path.hpp"

namespace phasetree::tracer {

struct RenderJob {
    PixelRange pixels;
    /// Which of a pixel's samples, by their numbers: [first, last). All of the scene's if it is not said.
    std::optional<SampleRange> samples = std::nullopt;
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

/// Adds to the film what its pixels lack of the job's samples. It has the scene's settings and the job's pixels, and
/// none but samples of the job, of each pixel those of the lowest numbers: nothing, or what a rendering has left that
/// was cancelled. While this runs, others may write the film's rows.
///
/// Gives the same film for any number of threads and whatever the film had: a pixel's samples are numbered and seeded
/// by pixel and number, and the film's sums do not depend on their order. Works in passes over the whole image, so that
/// a cancelled one is evenly done: no pixel is further ahead than by one pass.
Rendering render(const World& world, const Scene& scene, const RenderJob& job, Film& film);
/// The same from the beginning.
Rendering render(const World& world, const Scene& scene, const RenderJob& job);

/// What the planes of a scene's film name their channels after.
PlaneSubjects subjects_of(const Scene& scene);
/// The film for a job on a scene, without samples.
Film film_of(const Scene& scene, const RenderJob& job);

}  // namespace phasetree::tracer
