#include "render/render.hpp"

#include <tbb/blocked_range2d.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <chrono>

#include "phasetree/math/float_mode.hpp"

namespace phasetree::tracer {

Rendering render(const World& world, const Scene& scene, const RenderJob& job) {
    const auto start = std::chrono::steady_clock::now();
    const ThinLens camera(scene.camera);
    const PixelRange range = job.pixels;
    const int samples = scene.settings.samples;
    Rendering result;
    result.threads = job.threads > 0 ? job.threads : tbb::this_task_arena::max_concurrency();

    std::vector<glm::dvec3> sum(static_cast<std::size_t>(range.width()) * static_cast<std::size_t>(range.height()),
                                glm::dvec3(0.0));
    tbb::enumerable_thread_specific<PathCounters> counters;
    std::atomic<bool> stopped{false};

    // A pinhole in one place sees one phase; the label is asked for once.
    const bool pinhole = scene.camera.lens_radius == 0;
    const Phase camera_phase = world.geometry().label(scene.camera.position);
    const bool near_object =
        world.geometry().object().bounds().inflated(scene.camera.lens_radius).contains(scene.camera.position);

    const auto add_samples = [&](int x, int y, int first, int last, PathCounters& counter) {
        glm::dvec3& pixel = sum[static_cast<std::size_t>(y - range.y0) * static_cast<std::size_t>(range.width()) +
                                static_cast<std::size_t>(x - range.x0)];
        for (int s = first; s < last; ++s) {
            Sampler sampler(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(s),
                            scene.settings.seed);
            const glm::vec2 on_pixel = sampler.next2();
            const CameraRay ray = camera.generate(x, y, on_pixel, sampler.next2());
            const Phase phase = pinhole       ? camera_phase
                                : near_object ? world.geometry().label(ray.origin)
                                              : phasetree::vacuum;
            pixel += glm::dvec3(trace_path(world, scene, {ray.origin, ray.direction, phase, {}}, sampler, counter));
        }
    };

    const auto run_passes = [&] {
        // The first pass is one sample, so that even an early Ctrl-C leaves a picture; later ones are larger.
        for (int first = 0; first < samples && !stopped;) {
            const int last = std::min(samples, first == 0 ? 1 : first + std::clamp(first, 1, 16));
            const tbb::blocked_range2d<int> tiles(range.y0, range.y1, 8, range.x0, range.x1, 8);
            std::vector<glm::dvec3> before;
            if (first > 0) before = sum;
            tbb::parallel_for(
                tiles,
                [&](const tbb::blocked_range2d<int>& tile) {
                    if (stopped || job.cancelled()) {
                        stopped = true;
                        return;
                    }
                    const FlushSubnormals flush;
                    PathCounters& counter = counters.local();
                    for (int y = tile.rows().begin(); y < tile.rows().end(); ++y)
                        for (int x = tile.cols().begin(); x < tile.cols().end(); ++x)
                            add_samples(x, y, first, last, counter);
                    job.advance(tile.rows().size() * tile.cols().size() * static_cast<std::size_t>(last - first));
                },
                tbb::simple_partitioner());
            // A pass that was cut off is dropped, so that every pixel has as many samples; but something beats nothing.
            if (stopped && first > 0) {
                sum = std::move(before);
                break;
            }
            first = last;
            result.samples = last;
        }
    };
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                        static_cast<std::size_t>(result.threads));
        tbb::task_arena arena(result.threads);
        arena.execute(run_passes);
    }

    result.cancelled = stopped;
    result.image.width = range.width();
    result.image.height = range.height();
    result.image.pixels.reserve(sum.size());
    for (const glm::dvec3& s : sum)
        result.image.pixels.emplace_back(s / static_cast<double>(std::max(result.samples, 1)));
    if (range.width() != scene.camera.width || range.height() != scene.camera.height)
        result.image.crop = Crop{range.x0, range.y0, scene.camera.width, scene.camera.height};
    for (const PathCounters& c : counters) result.counters += c;
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

}  // namespace phasetree::tracer
