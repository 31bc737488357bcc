// From a scene to an image, on all cores.
#pragma once

#include <chrono>
#include <functional>
#include <optional>

#include "film/faults.hpp"
#include "film/film_settings.hpp"
#include "film/image.hpp"
#include "film/sample_range.hpp"
#include "integrator/path.hpp"

namespace phasetree::tracer {

class Film;

struct RenderJob {
    PixelRange pixels;
    /// Which of a pixel's samples, by their numbers: [first, last). All of the scene's if it is not said.
    std::optional<SampleRange> samples = std::nullopt;
    int threads = 0;  ///< 0: as many as there are cores
    /// No pass begins that would not end by then, as far as the last one tells; the first one is always done, and one
    /// after a guide was learned.
    std::optional<std::chrono::steady_clock::time_point> deadline = std::nullopt;
    /// Called with the samples done since the last call, from any thread; those that a block need not have, because it
    /// has little noise, count as done.
    std::function<void(std::uint64_t)> advance = [](std::uint64_t) {};
    /// Called with how much is done, from 0 to 1, of what is learned before the first pass if the scene asks for
    /// guiding; by one thread at a time. Not called without.
    std::function<void(double)> learned = [](double) {};
    std::function<bool()> cancelled = [] { return false; };
    /// Called after each whole pass with how many samples each pixel has by then; nothing is added meanwhile.
    std::function<void(const Film&, int)> passed = [](const Film&, int) {};
};

struct Rendering {
    Image image;
    /// In each pixel of the image at least: fewer than asked if the rendering was cancelled or its time was over. Where
    /// pixels stop by their noise it is their mean, rounded down.
    int samples = 0;
    std::size_t blocks = 0;        ///< those of noise_limit.hpp
    std::size_t noisy_blocks = 0;  ///< which have not stopped by their noise; 0 if none is to
    bool is_out_of_time = false;
    FilmFaults faults;
    bool cancelled = false;
    double seconds = 0;
    int threads = 0;
    PathCounters counters;
};

/// Adds to the film what its pixels lack of the job's samples. The film comes from film_of(). It is empty, or was left
/// by a cancelled render() of the same job: each pixel then has the job's samples from the lowest number on, without
/// gaps. While this runs, others may write the film's rows to a file.
///
/// Gives the same film for any number of threads and whatever the film had: a pixel's samples are numbered and seeded
/// by pixel and number, and the film's sums do not depend on their order. Works in passes over the whole image, so that
/// a cancelled one is evenly done: no pixel is further ahead than by one pass. Where the scene has a limit of noise, a
/// block stops early that meets it; the image is of the job's pixels, and the film of all blocks that these touch.
Rendering render(const World& world, const Scene& scene, const RenderJob& job, Film& film);
/// The same from the beginning.
Rendering render(const World& world, const Scene& scene, const RenderJob& job);

/// What the planes of a scene's film name their channels after.
PlaneSubjects subjects_of(const Scene& scene);
/// What a scene's film keeps: beside its planes those of the noise and of the numbers of samples, if pixels stop by it.
FilmSettings film_settings(const Scene& scene);
/// The pixels of the film for a job: the job's own, or all blocks that these touch, if those may stop by their noise.
PixelRange film_area(const Scene& scene, const RenderJob& job);
/// The film for a job on a scene, without samples.
Film film_of(const Scene& scene, const RenderJob& job);

}  // namespace phasetree::tracer
