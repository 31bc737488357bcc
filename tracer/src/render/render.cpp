#include "render/render.hpp"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <utility>

#include "caustics/caustics.hpp"
#include "phasetree/math/float_mode.hpp"
#include "render/camera_paths.hpp"
#include "render/guide_training.hpp"
#include "render/noise_limit.hpp"
#include "sampling/shutter_time.hpp"

namespace phasetree::tracer {

namespace {

// The number of a job's samples per pixel after the next pass over the picture, given the current number.
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
          cameras_(world, scene),
          // A picture without further planes needs no path records.
          recording_(scene.film.planes.count() > 1),
          axis_{position_of(scene.camera), glm::normalize(look_at_of(scene.camera) - position_of(scene.camera))},
          film_(film),
          noise_(NoiseLimit::of(scene.settings)),
          blocks_(blocks_of(film.area())) {
        if (scene.settings.caustics) caustics_.emplace(world, scene);
    }

    // Returns the minimum number of samples per pixel at the end, not counting blocks that stopped by their noise. A
    // pass that is cut off leaves some pixels with more. If the first pass is cut off, its samples are kept, because an
    // incomplete picture is better than none.
    int run() {
        leave_out_quiet_blocks();
        int done = fewest_samples();
        // A resumed render whose time has run out needs no guide.
        const bool is_late = job_.deadline && done > 0 && Clock::now() >= *job_.deadline;
        if (scene_.settings.guiding && done < samples_.size() && !blocks_.empty() && !is_late) {
            guide_ = trained_guide(
                {world_, scene_, cameras_, caustics_ ? &*caustics_ : nullptr, job_.learned, job_.cancelled});
            stopped_ = !guide_;
        }
        while (done < samples_.size() && !stopped_ && !blocks_.empty()) {
            // A new guide is used for at least one pass, or a render that is resumed repeatedly would train forever.
            const bool is_first_with_guide = guide_ && seconds_of_sample_ == 0;
            const int next = is_first_with_guide ? done + 1 : after_next_pass(done);
            if (next == done) break;
            const Clock::time_point start = Clock::now();
            if (caustics_) {
                photons_ = caustics_->photons(samples_.first + done, counters_.local(), job_.cancelled);
                stopped_ = !photons_;
                if (stopped_) break;
            }
            run(next);
            seconds_of_sample_ = std::chrono::duration<double>(Clock::now() - start).count() / (next - done);
            if (!stopped_ || done == 0) done = next;
            if (!stopped_ && NoiseLimit::is_look(done)) leave_out_quiet_blocks();
            if (!stopped_) job_.passed(film_, done);
        }
        return done;
    }
    bool stopped() const { return stopped_; }
    bool is_out_of_time() const { return is_out_of_time_; }
    std::size_t blocks_left() const { return noise_ ? blocks_.size() : 0; }
    PathCounters counters() const {
        PathCounters sum;
        for (const PathCounters& thread : counters_) sum += thread;
        return sum;
    }

  private:
    using Clock = std::chrono::steady_clock;

    // The smallest number of samples of any pixel in the blocks that continue.
    int fewest_samples() const {
        auto fewest = static_cast<std::uint32_t>(samples_.size());
        for (const PixelRange& block : blocks_)
            for (int y = block.y0; y < block.y1; ++y)
                for (int x = block.x0; x < block.x1; ++x) fewest = std::min(fewest, film_.pixels().samples(x, y));
        return static_cast<int>(fewest);
    }
    // The number of samples per pixel after the next pass, for the blocks that continue. Returns `done` if there is no
    // time for another pass.
    int after_next_pass(int done) {
        // Each sample of a pixel gathers photons of its own, so with photons a pass is one sample.
        int next = caustics_ ? done + 1 : after_pass(done, samples_.size());
        if (noise_) next = std::min(next, NoiseLimit::next_look(done));
        if (job_.deadline && done > 0) {
            const double left = std::chrono::duration<double>(*job_.deadline - Clock::now()).count();
            is_out_of_time_ = left <= 0 || left < seconds_of_sample_;
            if (is_out_of_time_) return done;
            // A resumed render has not measured the time per sample yet.
            if (seconds_of_sample_ == 0)
                next = done + 1;
            else if (left < (next - done) * seconds_of_sample_)
                next = done + static_cast<int>(left / seconds_of_sample_);
        }
        return next;
    }
    // Stops blocks that meet the limit. A block is tested when all its pixels have the same number of samples, which
    // they may not have if a pass was cut off in them.
    void leave_out_quiet_blocks() {
        if (!noise_) return;
        std::uint64_t spared = 0;
        std::erase_if(blocks_, [&](const PixelRange& block) {
            if (!noise_->is_met(film_.pixels(), block)) return false;
            const auto had = static_cast<int>(film_.pixels().samples(block.x0, block.y0));
            spared += static_cast<std::uint64_t>(samples_.size() - had) * block.size();
            return true;
        });
        job_.advance(spared);
    }
    // Runs one pass over the picture, after which each pixel has this many samples.
    void run(int wanted) {
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(0, blocks_.size(), 1),
            [&](const tbb::blocked_range<std::size_t>& range) {
                for (std::size_t i = range.begin(); i < range.end(); ++i) {
                    if (stopped_ || job_.cancelled()) {
                        stopped_ = true;
                        return;
                    }
                    job_.advance(run(blocks_[i], wanted));
                }
            },
            tbb::simple_partitioner());
    }
    // Adds the missing samples of each pixel of a part. Returns their number.
    std::uint64_t run(const PixelRange& part, int wanted) {
        const FlushSubnormals flush;
        PathCounters& counters = counters_.local();
        FilmTile tile = film_.tile(part);
        std::uint64_t added = 0;
        for (int y = part.y0; y < part.y1; ++y)
            for (int x = part.x0; x < part.x1; ++x)
                // Tiles of one pass do not overlap: no other thread adds to this pixel now.
                for (int s = static_cast<int>(film_.pixels().samples(x, y)); s < wanted; ++s, ++added)
                    tile.add(x, y, sample(x, y, samples_.first + s, counters));
        film_.add(tile);
        return added;
    }
    // The result refers to data that is valid until the next sample of the same thread.
    FilmSample sample(int x, int y, int number, PathCounters& counters) {
        Sampler sampler(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                        static_cast<std::uint32_t>(number), scene_.settings.seed);
        const glm::dvec2 on_film = film_.sample_position(x, y, sampler.next2());
        const float time = scene_.moves() ? time_of(x, y, number) : 0.0f;
        const Ray first = cameras_.first_ray(on_film, time, sampler);
        FilmSample result{.number = static_cast<std::uint32_t>(number)};
        PathRecord* record = recording_ ? &records_.local() : nullptr;
        PathHelp help{.guide = guide_ ? &*guide_ : nullptr};
        if (photons_) help.photons = {&caustics_->emission(), &*photons_};
        result.radiance = trace_path(world_, scene_, first, sampler, counters, record, help);
        result.record = record;
        if (record && record->first) result.depth = glm::dot(record->first->position - axis_.origin, axis_.direction);
        return result;
    }

    // Photons and paths of a pass have the same time.
    float time_of(int x, int y, int number) const {
        if (caustics_) return caustics_->time(number);
        return shutter_time(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                            static_cast<std::uint32_t>(number), scene_.settings.seed);
    }

    const World& world_;
    const Scene& scene_;
    const RenderJob& job_;
    SampleRange samples_;
    CameraPaths cameras_;
    bool recording_;
    CameraRay axis_;  // from the camera towards its target, as the shutter opens
    Film& film_;
    std::optional<NoiseLimit> noise_;
    std::vector<PixelRange> blocks_;  // tiles of the film, without those that have stopped
    double seconds_of_sample_ = 0;    // for all pixels, in the last pass
    bool is_out_of_time_ = false;
    std::optional<Caustics> caustics_;
    std::optional<PhotonMap> photons_;  // of this pass
    std::optional<Guide> guide_;        // if the scene requests guiding
    tbb::enumerable_thread_specific<PathCounters> counters_;
    tbb::enumerable_thread_specific<PathRecord> records_;
    std::atomic<bool> stopped_{false};
};

}  // namespace

SceneNames scene_names_of(const Scene& scene) {
    return {.phases = scene.phases.names, .groups = scene.lights.groups(), .objects = object_names(scene)};
}

FilmSettings film_settings(const Scene& scene) {
    FilmSettings settings = scene.film;
    if (NoiseLimit::of(scene.settings))
        for (const std::size_t plane : {Planes::index_of<NoisePlane>(), Planes::index_of<SamplesPlane>()})
            settings.planes[plane] = true;
    return settings;
}

PixelRange film_area(const Scene& scene, const RenderJob& job) {
    return NoiseLimit::of(scene.settings) ? whole_blocks(job.pixels, scene.film) : job.pixels;
}

Film film_of(const Scene& scene, const RenderJob& job) {
    return {film_settings(scene), film_area(scene, job), scene_names_of(scene)};
}

namespace {

int mean_samples(const FilmTile& pixels, const PixelRange& area) {
    std::uint64_t sum = 0;
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) sum += pixels.samples(x, y);
    return static_cast<int>(sum / area.size());
}

}  // namespace

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
    result.is_out_of_time = renderer.is_out_of_time();
    result.blocks = blocks_of(film.area()).size();
    result.noisy_blocks = renderer.blocks_left();
    if (NoiseLimit::of(scene.settings)) result.samples = mean_samples(film.pixels(), job.pixels);
    result.image = film.image();
    const PixelRange &all = film.area(), &part = job.pixels;
    if (part.size() != all.size())
        result.image = part_of(result.image, part.x0 - all.x0, part.y0 - all.y0, part.width(), part.height());
    result.faults = film.pixels().faults();
    result.counters = renderer.counters();
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

}  // namespace phasetree::tracer
