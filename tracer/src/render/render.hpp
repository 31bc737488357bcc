// Renders a scene to an image, on all cores.
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
    /// Range of sample numbers of each pixel: [first, last). nullopt for all samples of the scene.
    std::optional<SampleRange> samples = std::nullopt;
    int threads = 0;  ///< 0: as many as there are cores
    /// A pass starts only if it will probably end by then, judging by the previous one. The first pass, and the first
    /// after training a guide, always start.
    std::optional<std::chrono::steady_clock::time_point> deadline = std::nullopt;
    /// Called with the number of samples done since the last call, from any thread. Samples that a block omits because
    /// it has little noise count as done.
    std::function<void(std::uint64_t)> advance = [](std::uint64_t) {};
    /// Called with the progress of training the guide before the first pass, from 0 to 1, by one thread at a time. Not
    /// called without guiding.
    std::function<void(double)> learned = [](double) {};
    std::function<bool()> cancelled = [] { return false; };
    /// Called after each complete pass with the number of samples per pixel. The film does not change meanwhile.
    std::function<void(const Film&, int)> passed = [](const Film&, int) {};
};

struct Rendering {
    Image image;
    /// Minimum samples per pixel of the image: fewer than requested if the rendering was cancelled or ran out of time.
    /// If pixels may stop early because they have little noise, it is the mean, rounded down.
    int samples = 0;
    std::size_t blocks = 0;        ///< number of blocks, see noise_limit.hpp
    std::size_t noisy_blocks = 0;  ///< blocks that have not stopped by their noise; 0 without a limit
    bool is_out_of_time = false;
    FilmFaults faults;
    bool cancelled = false;
    double seconds = 0;
    int threads = 0;
    PathCounters counters;
};

/// Adds the missing samples of the job to the film. The film comes from film_of(). It must be empty, or the result of a
/// cancelled render() of the same job, in which each pixel has the job's samples from the lowest number on, without
/// gaps. While this runs, other threads may write the film's rows to a file.
///
/// The resulting film does not depend on the number of threads, nor on interruptions: samples are numbered and seeded
/// by pixel and number, and the film's sums do not depend on their order. Rendering proceeds in passes over the whole
/// image, so that a cancelled one is even: pixels differ by at most one pass. If the scene has a noise limit, blocks
/// that meet it stop early; the image then contains the job's pixels, and the film all blocks that overlap them.
Rendering render(const World& world, const Scene& scene, const RenderJob& job, Film& film);
/// As above, starting with an empty film.
Rendering render(const World& world, const Scene& scene, const RenderJob& job);

/// The names of the scene's phases, light groups and objects. The film's planes, its layers of output, name their
/// channels after them.
SceneNames scene_names_of(const Scene& scene);
/// The settings of a scene's film. If pixels stop by their noise, they include the planes of noise and of sample
/// numbers.
FilmSettings film_settings(const Scene& scene);
/// The pixels of the film for a job: the job's own, or all blocks that overlap them if those may stop by their noise.
PixelRange film_area(const Scene& scene, const RenderJob& job);
/// An empty film for a job on a scene.
Film film_of(const Scene& scene, const RenderJob& job);

}  // namespace phasetree::tracer
