#include "render/render.hpp"

#include <tbb/blocked_range2d.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <utility>

#include "camera/camera.hpp"
#include "caustics/caustics.hpp"
#include "phasetree/math/float_mode.hpp"

namespace phasetree::tracer {

namespace {

constexpr int tile_side = 8;  // in pixels

// The phases in which camera rays start.
class StartingPhases {
  public:
    StartingPhases(const TracedGeometry& geometry, const Camera& camera) : geometry_(geometry) {
        if (const auto origin = camera.single_origin()) single_ = geometry.inside(*origin);
    }
    TracedGeometry::Inside at(const glm::vec3& origin) const { return single_ ? *single_ : geometry_.inside(origin); }

  private:
    const TracedGeometry& geometry_;
    std::optional<TracedGeometry::Inside> single_;  // of a camera whose rays all start at one point, asked for once
};

// How many of a job's samples each pixel has when a pass over the picture is done, from how many it had.
int after_pass(int had, int in_all) {
    // The first pass is one sample, so that even an early Ctrl-C leaves a picture; later ones are larger.
    return std::min(in_all, had == 0 ? 1 : had + std::clamp(had, 1, 16));
}

class Renderer {
  public:
    Renderer(const World& world, const Scene& scene, const RenderJob& job, Film& film)
        : world_(world),
          scene_(scene),
          job_(job),
          samples_(job.samples.value_or(SampleRange{0, scene.settings.samples})),
          camera_(scene.camera, scene.film.resolution()),
          phases_(world.geometry(), camera_),
          // Of a picture alone no path need tell more.
          recording_(scene.film.planes.count() > 1),
          axis_(camera_.generate(glm::dvec2(scene.film.resolution()) * 0.5, glm::vec2(0.5f))),
          film_(film) {
        if (scene.settings.caustics) caustics_.emplace(world, scene);
    }

    // Returns how many samples each pixel has in the end, at least. A pass that is cut off leaves some pixels with
    // more; of the first pass it leaves what there is, because something beats nothing.
    int run() {
        int done = fewest_samples();
        while (done < samples_.size() && !stopped_) {
            // Each sample of a pixel sees photons of its own, so with photons a pass is one sample.
            const int next = caustics_ ? done + 1 : after_pass(done, samples_.size());
            if (caustics_) {
                photons_ = caustics_->photons(samples_.first + done, counters_.local(), job_.cancelled);
                stopped_ = !photons_;
                if (stopped_) break;
            }
            run(next);
            if (!stopped_ || done == 0) done = next;
            if (!stopped_) job_.passed(film_, done);
        }
        return done;
    }
    bool stopped() const { return stopped_; }
    PathCounters counters() const {
        PathCounters sum;
        for (const PathCounters& thread : counters_) sum += thread;
        return sum;
    }

  private:
    int fewest_samples() const {
        const PixelRange& area = film_.area();
        auto fewest = static_cast<std::uint32_t>(samples_.size());
        for (int y = area.y0; y < area.y1; ++y)
            for (int x = area.x0; x < area.x1; ++x) fewest = std::min(fewest, film_.pixels().samples(x, y));
        return static_cast<int>(fewest);
    }
    // One pass over the picture, after which each pixel has so many samples.
    void run(int wanted) {
        const PixelRange& area = film_.area();
        tbb::parallel_for(
            tbb::blocked_range2d<int>(area.y0, area.y1, tile_side, area.x0, area.x1, tile_side),
            [&](const tbb::blocked_range2d<int>& tile) {
                if (stopped_ || job_.cancelled()) {
                    stopped_ = true;
                    return;
                }
                const PixelRange part{tile.cols().begin(), tile.rows().begin(), tile.cols().end(), tile.rows().end()};
                job_.advance(run(part, wanted));
            },
            tbb::simple_partitioner());
    }
    // Adds to each pixel of a part what it lacks. Returns how many samples that were.
    std::uint64_t run(const PixelRange& part, int wanted) {
        const FlushSubnormals flush;
        PathCounters& counters = counters_.local();
        FilmTile tile = film_.tile(part);
        std::uint64_t added = 0;
        for (int y = part.y0; y < part.y1; ++y)
            for (int x = part.x0; x < part.x1; ++x)
                // Tiles of one pass do not overlap: nobody else adds to this pixel now.
                for (int s = static_cast<int>(film_.pixels().samples(x, y)); s < wanted; ++s, ++added)
                    tile.add(x, y, sample(x, y, samples_.first + s, counters));
        film_.add(tile);
        return added;
    }
    // What it refers to is good until the next sample of the same thread.
    FilmSample sample(int x, int y, int number, PathCounters& counters) {
        Sampler sampler(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                        static_cast<std::uint32_t>(number), scene_.settings.seed);
        const glm::dvec2 on_film = film_.sample_position(x, y, sampler.next2());
        const CameraRay ray = camera_.generate(on_film, sampler.next2());
        const TracedGeometry::Inside start = phases_.at(ray.origin);
        const Ray first{ray.origin, ray.direction, start.phase, {}, start.in};
        FilmSample result{.number = static_cast<std::uint32_t>(number)};
        PathRecord* record = recording_ ? &records_.local() : nullptr;
        const Photons photons = photons_ ? Photons{&caustics_->emission(), &*photons_} : Photons{};
        result.radiance = trace_path(world_, scene_, first, sampler, counters, record, photons);
        result.record = record;
        if (record && record->first) result.depth = glm::dot(record->first->position - axis_.origin, axis_.direction);
        return result;
    }

    const World& world_;
    const Scene& scene_;
    const RenderJob& job_;
    SampleRange samples_;
    Camera camera_;
    StartingPhases phases_;
    bool recording_;
    CameraRay axis_;  // through the middle of the picture
    Film& film_;
    std::optional<Caustics> caustics_;
    std::optional<PhotonMap> photons_;  // of this pass
    tbb::enumerable_thread_specific<PathCounters> counters_;
    tbb::enumerable_thread_specific<PathRecord> records_;
    std::atomic<bool> stopped_{false};
};

}  // namespace

PlaneSubjects subjects_of(const Scene& scene) {
    return {.phases = scene.phases.names, .groups = scene.lights.groups(), .objects = object_names(scene)};
}

Film film_of(const Scene& scene, const RenderJob& job) {
    return {scene.film, job.pixels, subjects_of(scene)};
}

Rendering render(const World& world, const Scene& scene, const RenderJob& job) {
    Film film = film_of(scene, job);
    return render(world, scene, job, film);
}

Rendering render(const World& world, const Scene& scene, const RenderJob& job, Film& film) {
    const auto start = std::chrono::steady_clock::now();
    Rendering result;
    result.threads = job.threads > 0 ? job.threads : tbb::this_task_arena::max_concurrency();
    Renderer renderer(world, scene, job, film);
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                        static_cast<std::size_t>(result.threads));
        tbb::task_arena arena(result.threads);
        arena.execute([&] { result.samples = renderer.run(); });
    }
    result.cancelled = renderer.stopped();
    result.image = film.image();
    result.faults = film.pixels().faults();
    result.counters = renderer.counters();
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

}  // namespace phasetree::tracer
