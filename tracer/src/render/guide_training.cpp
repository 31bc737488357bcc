#include "render/guide_training.hpp"

#include <tbb/parallel_for.h>

#include <atomic>
#include <bit>
#include <mutex>
#include <vector>

#include "guiding/lessons.hpp"
#include "integrator/path.hpp"
#include "phasetree/math/float_mode.hpp"
#include "sampling/shutter_time.hpp"

namespace phasetree::tracer {

namespace {

constexpr std::size_t paths_a_task = 1024;
constexpr std::size_t first_round = std::size_t{1} << 14;
// How many the last round has at least and at most. Of a room behind a door a quarter of a million paths in all leave
// 1.4 × the variance that a million leave.
constexpr std::size_t fewest = std::size_t{1} << 17, most = std::size_t{1} << 19;

// These paths have a pixel of their own, so that their random numbers are neither those of the picture's nor those of
// photons.
constexpr std::uint32_t column_of_training = 0x80000002u;

std::size_t last_round(const Scene& scene) {
    return std::clamp(std::bit_floor(2 * scene.film.whole().size()), fewest, most);
}

class Training {
  public:
    explicit Training(const GuideTraining& about)
        : about_(about), film_(about.scene.film.resolution()), last_(last_round(about.scene)) {}

    std::optional<Guide> run() {
        std::optional<Guide> guide;
        for (std::size_t paths = first_round; paths <= last_; paths *= 2, ++round_) {
            if (about_.caustics) {
                PathCounters uncounted;
                photons_ = about_.caustics->photons(round_, uncounted, about_.cancelled);
                if (!photons_) return std::nullopt;
            }
            const auto findings = found_by(paths, guide ? &*guide : nullptr);
            if (!findings) return std::nullopt;
            guide.emplace(*findings);
        }
        about_.learned(1);
        return guide;
    }

  private:
    // What a round of paths finds; nothing if it was cancelled.
    std::optional<std::vector<Finding>> found_by(std::size_t paths, const Guide* guide) {
        const std::size_t tasks = paths / paths_a_task;
        std::vector<std::vector<Finding>> parts(tasks);
        std::atomic<bool> stopped{false};
        tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
            if (stopped || about_.cancelled()) {
                stopped = true;
                return;
            }
            parts[task] = traced(task, guide);
            tell(paths_a_task);
        });
        if (stopped) return std::nullopt;
        std::size_t count = 0;
        for (const std::vector<Finding>& part : parts) count += part.size();
        std::vector<Finding> findings;
        findings.reserve(count);
        for (std::vector<Finding>& part : parts) {
            findings.insert(findings.end(), part.begin(), part.end());
            part = {};
        }
        return findings;
    }

    std::vector<Finding> traced(std::size_t task, const Guide* guide) const {
        const FlushSubnormals flush;
        const std::uint32_t seed = about_.scene.settings.seed;
        const auto row = static_cast<std::uint32_t>(round_);
        PathLessons lessons;
        PathHelp help{.guide = guide, .lessons = &lessons};
        if (photons_) help.photons = {&about_.caustics->emission(), &*photons_};
        PathCounters uncounted;
        std::vector<Finding> findings;
        for (std::size_t i = 0; i < paths_a_task; ++i) {
            const auto number = static_cast<std::uint32_t>(task * paths_a_task + i);
            Sampler sampler(column_of_training, row, number, seed);
            const glm::dvec2 on_film = glm::dvec2(sampler.next2()) * film_;
            const Ray ray = about_.cameras.first_ray(on_film, time_of(row, number), sampler);
            trace_path(about_.world, about_.scene, ray, sampler, uncounted, nullptr, help);
            lessons.finish(findings);
        }
        return findings;
    }
    // Photons and the paths that they help meet the world at the same time; rounds have those of the first passes.
    float time_of(std::uint32_t row, std::uint32_t number) const {
        if (!about_.scene.moves()) return 0.0f;
        if (about_.caustics) return about_.caustics->time(round_);
        return shutter_time(column_of_training, row, number, about_.scene.settings.seed);
    }

    void tell(std::size_t paths) {
        const std::lock_guard lock(telling_);
        done_ += paths;
        about_.learned(0.99 * static_cast<double>(done_) / static_cast<double>(2 * last_ - first_round));
    }

    const GuideTraining& about_;
    glm::dvec2 film_;
    std::optional<PhotonMap> photons_;
    std::mutex telling_;
    std::size_t last_, done_ = 0;
    int round_ = 0;
};

}  // namespace

std::optional<Guide> trained_guide(const GuideTraining& training) {
    return Training(training).run();
}

}  // namespace phasetree::tracer
