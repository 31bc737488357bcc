#include "render/guide_training.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <mutex>
#include <vector>

#include "guiding/path_guide_samples.hpp"
#include "integrator/path.hpp"
#include "phasetree/math/float_mode.hpp"
#include "sampling/shutter_time.hpp"

namespace phasetree::tracer {

namespace {

constexpr std::size_t paths_a_task = 1024;
constexpr std::size_t paths_of_first_round = std::size_t{1} << 14;
// For a room behind a door, a quarter of a million paths in all rounds result in 1.4 × the variance of a million.
constexpr std::size_t least_paths_of_last_round = std::size_t{1} << 17, most_paths_of_last_round = std::size_t{1} << 19;

// These paths have pixel coordinates of their own, so that their random numbers differ from those of the picture and of
// photons (caustics/caustics.cpp uses the two previous columns).
constexpr std::uint32_t column_of_training = 0x80000002u;

std::size_t paths_of_last_round(const Scene& scene) {
    return std::clamp(std::bit_floor(2 * scene.film.whole().size()), least_paths_of_last_round,
                      most_paths_of_last_round);
}

class Training {
  public:
    explicit Training(const GuideTraining& training)
        : training_(training),
          film_(training.scene.film.resolution()),
          paths_of_last_round_(paths_of_last_round(training.scene)) {}

    std::optional<Guide> run() {
        std::optional<Guide> guide;
        for (std::size_t paths = paths_of_first_round; paths <= paths_of_last_round_; paths *= 2, ++round_) {
            if (training_.caustics) {
                PathCounters uncounted;
                photons_ = training_.caustics->photons(round_, uncounted, training_.cancelled);
                if (!photons_) return std::nullopt;
            }
            const auto samples = found_by(paths, guide ? &*guide : nullptr);
            if (!samples) return std::nullopt;
            guide.emplace(*samples);
        }
        training_.learned(1);
        return guide;
    }

  private:
    // The samples of a round of paths; nullopt if cancelled.
    std::optional<std::vector<GuideSample>> found_by(std::size_t paths, const Guide* guide) {
        const std::size_t tasks = paths / paths_a_task;
        std::vector<std::vector<GuideSample>> parts(tasks);
        std::atomic<bool> stopped{false};
        tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
            if (stopped || training_.cancelled()) {
                stopped = true;
                return;
            }
            parts[task] = traced(task, guide);
            report(paths_a_task);
        });
        if (stopped) return std::nullopt;
        std::size_t count = 0;
        for (const std::vector<GuideSample>& part : parts) count += part.size();
        std::vector<GuideSample> samples;
        samples.reserve(count);
        for (std::vector<GuideSample>& part : parts) {
            samples.insert(samples.end(), part.begin(), part.end());
            part = {};
        }
        return samples;
    }

    std::vector<GuideSample> traced(std::size_t task, const Guide* guide) const {
        const FlushSubnormals flush;
        const std::uint32_t seed = training_.scene.settings.seed;
        const auto row = static_cast<std::uint32_t>(round_);
        PathGuideSamples of_path;
        PathHelp help{.guide = guide, .guide_samples = &of_path};
        if (photons_) help.photons = {&training_.caustics->emission(), &*photons_};
        PathCounters uncounted;
        std::vector<GuideSample> samples;
        for (std::size_t i = 0; i < paths_a_task; ++i) {
            const auto number = static_cast<std::uint32_t>(task * paths_a_task + i);
            Sampler sampler(column_of_training, row, number, seed);
            const glm::dvec2 on_film = glm::dvec2(sampler.next2()) * film_;
            const Ray ray = training_.cameras.first_ray(on_film, time_of(row, number), sampler);
            trace_path(training_.world, training_.scene, ray, sampler, uncounted, nullptr, help);
            of_path.take(samples);
        }
        return samples;
    }
    // Photons and the paths that gather them have the same time.
    float time_of(std::uint32_t row, std::uint32_t number) const {
        if (!training_.scene.moves()) return 0.0f;
        if (training_.caustics) return training_.caustics->time(round_);
        return shutter_time(column_of_training, row, number, training_.scene.settings.seed);
    }

    // The last hundredth is reserved for making the final guide.
    void report(std::size_t paths) {
        const std::lock_guard lock(reporting_);
        done_ += paths;
        const std::size_t in_all = 2 * paths_of_last_round_ - paths_of_first_round;
        training_.learned(0.99 * static_cast<double>(done_) / static_cast<double>(in_all));
    }

    const GuideTraining& training_;
    glm::dvec2 film_;
    std::optional<PhotonMap> photons_;
    std::mutex reporting_;
    std::size_t paths_of_last_round_, done_ = 0;
    int round_ = 0;
};

}  // namespace

std::optional<Guide> trained_guide(const GuideTraining& training) {
    return Training(training).run();
}

}  // namespace phasetree::tracer
