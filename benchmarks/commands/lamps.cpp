// Many lamps: compares choosing one of them by the light tree with evaluating each, by time and variance.
//
// Clusters of small glowing balls hang in a hall. At some points of the floor, the irradiance is estimated many times,
// each time from one sample of the lights, without occlusion. The relative variance of these estimates is averaged over
// the points. The time to reach a given error is proportional to variance times time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "commands/commands.hpp"
#include "image/luminance.hpp"
#include "lights/lights.hpp"
#include "rays/random.hpp"

namespace phasetree::bench {

namespace {

tracer::Lights hall(int count) {
    tracer::Lights lights;
    Random random(11);
    glm::vec3 bunch(0);
    for (int i = 0; i < count; ++i) {
        if (i % 25 == 0) bunch = random.in_cube() * glm::vec3(20, 20, 3) + glm::vec3(-10, -10, 1);
        const glm::vec3 centre = bunch + (random.in_cube() - 0.5f) * glm::vec3(2, 2, 1);
        lights.add(tracer::SphereLight(centre, 0.02f, glm::vec3(std::exp(3 * random.next()))));
    }
    return lights;
}

// Takes this many samples of the lights at each of this many points of the floor.
class Floor {
  public:
    Floor(int points, int samples, std::uint32_t seed) : points_(points), samples_(samples), seed_(seed) {}

    struct Found {
        double mean = 0, relative_variance = 0;
        std::size_t lit = 0;
    };
    Found sample(const tracer::Lights& lights) const {
        Random random(seed_);
        Found found;
        for (int i = 0; i < points_; ++i) {
            const tracer::LightReceiver at((random.in_cube() - 0.5f) * glm::vec3(24, 24, 0), {0, 0, 1});
            double sum = 0, squares = 0;
            for (int k = 0; k < samples_; ++k) {
                const float u = random.next();
                const auto s = lights.sample(at, {u, random.next()});
                const double value =
                    s ? static_cast<double>(tracer::luminance(s->radiance) * std::max(s->wi.z, 0.0f) / s->pdf) : 0.0;
                sum += value;
                squares += value * value;
                found.lit += value > 0;
            }
            const double mean = sum / samples_;
            found.mean += mean / points_;
            found.relative_variance += (squares / samples_ / (mean * mean) - 1) / points_;
        }
        return found;
    }

    int count() const { return points_ * samples_; }

  private:
    int points_, samples_;
    std::uint32_t seed_;
};

}  // namespace

Report lamps(const Settings& settings) {
    Report report("lamps", "choosing one of many lamps: by a tree of clusters or by evaluating each lamp");
    const Floor floor(settings.quick ? 40 : 200, settings.quick ? 100 : 400, settings.seed);
    report.say(
        "clusters of small balls above a floor; the irradiance at points of the floor is estimated from one sample of "
        "the lights, without occlusion; variance: of a sample, relative to the squared mean; 1 thread");
    Table table({{"lamps", "lamps", "{:.0f}"},
                 {"each_seconds", "each lamp, µs", "{:.2f}", 1e6},
                 {"tree_seconds", "tree, µs", "{:.2f}", 1e6},
                 {"speedup", "faster", "{:.2f} ×"},
                 {"each_variance", "variance, each lamp", "{:.3f}"},
                 {"tree_variance", "tree", "{:.3f}"},
                 {"gain", "variance × time, ratio", "{:.2f} ×"}});
    // 32 lamps are not clustered, so both methods should take the same time.
    for (const int count : settings.quick ? std::vector{32, 1000} : std::vector{32, 100, 1000, 10000}) {
        const tracer::Lights each = hall(count);
        tracer::Lights clustered = each;
        clustered.cluster_lamps();
        const Floor::Found a = floor.sample(each), b = floor.sample(clustered);
        const Turns turns = in_turn({{"each",
                                      [&] {
                                          return Checksum{floor.sample(each).lit, 0, 0};
                                      }},
                                     {"tree",
                                      [&] {
                                          return Checksum{floor.sample(clustered).lit, 0, 0};
                                      }}},
                                    settings.timing_of_one_thread());
        const double samples = floor.count();
        const double speedup = turns.ratio(0, 1).median;
        table.row({double(count), turns.seconds(0).median / samples, turns.seconds(1).median / samples, speedup,
                   a.relative_variance, b.relative_variance, speedup * a.relative_variance / b.relative_variance});
        report.check(fmt::format("{} lamps: the same brightness", count), std::abs(b.mean / a.mean - 1) < 0.02,
                     fmt::format("{:.4f}", b.mean / a.mean));
    }
    report.table("lamps", table);
    return report;
}

}  // namespace phasetree::bench
