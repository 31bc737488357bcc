// How much error is left in a picture after a second of processor time: for each technique of finding light, and
// against another build.
//
// The error is the variance of a pixel's luminance, relative to the square of its mean (plus a hundredth of the square
// of the picture's mean, so that black pixels do not decide), averaged over the pixels. It needs no reference: it is
// half the squared difference of two pictures with different seeds. The benchmark compares error times processor time,
// which does not depend on the number of samples as long as the error is inversely proportional to it.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "commands/commands.hpp"
#include "image/luminance.hpp"
#include "image/read_image.hpp"
#include "measure/clock.hpp"
#include "objects/scene_file.hpp"
#include "render/render.hpp"
#include "world/world.hpp"

namespace phasetree::bench {

namespace {

struct Picture {
    std::vector<double> luminances;
    double seconds = 0;  // of processor time, without preparing the scene
};

// Renders one picture per seed.
struct Painter {
    std::string name;
    std::function<Picture(std::uint32_t seed)> paint;
};

Picture painted_here(const tracer::World& world, tracer::Scene& scene, tracer::Techniques techniques, int threads,
                     std::uint32_t seed) {
    scene.settings.techniques = techniques;
    scene.settings.seed = seed;
    tracer::RenderJob job;
    job.pixels = scene.film.whole();
    job.threads = threads;
    const double start = seconds(Clock::process);
    const tracer::Image image = tracer::render(world, scene, job).image;
    Picture picture;
    picture.seconds = seconds(Clock::process) - start;
    for (const glm::vec3& p : image.pixels) picture.luminances.push_back(static_cast<double>(tracer::luminance(p)));
    return picture;
}

// A folder that is removed together with this object.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "phasetree-bench-XXXXXX").string();
        if (!::mkdtemp(name.data())) throw std::runtime_error("cannot create a folder for pictures");
        path_ = name;
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

// Runs a program and returns its processor time.
double run(const std::vector<std::string>& arguments) {
    std::vector<char*> argv;
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const pid_t child = ::fork();
    if (child < 0) throw std::runtime_error("cannot start " + arguments[0]);
    if (child == 0) {
        ::execv(argv[0], argv.data());
        ::_exit(127);
    }
    int status = 0;
    rusage usage{};
    if (::wait4(child, &status, 0, &usage) < 0 || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw std::runtime_error(arguments[0] + " failed");
    const auto in_seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return in_seconds(usage.ru_utime) + in_seconds(usage.ru_stime);
}

// The command of another build. The time to prepare the scene is taken to be the time of one sample of one pixel.
class OtherBuild {
  public:
    OtherBuild(std::string command, std::string scene, glm::ivec2 size, int samples, int threads)
        : command_(std::move(command)),
          scene_(std::string(PHASETREE_SCENES "/") + scene + ".json"),
          size_(fmt::format("{}x{}", size.x, size.y)),
          samples_(samples),
          threads_(threads) {
        (void)render(0, 1, true);  // writes the file of cells
        preparing_ = render(0, 1, true);
    }
    Picture paint(std::uint32_t seed) const {
        Picture picture;
        picture.seconds = render(seed, samples_, false) - preparing_;
        tracer::read_image(
            file("picture.exr"), "picture", [](const tracer::ImageHeader&) { return 3; },
            [&](std::span<const float> values) {
                for (std::size_t i = 0; i + 2 < values.size(); i += 3)
                    picture.luminances.push_back(
                        static_cast<double>(tracer::luminance({values[i], values[i + 1], values[i + 2]})));
            });
        return picture;
    }

  private:
    std::string file(const char* name) const { return (folder_.path() / name).string(); }
    double render(std::uint32_t seed, int samples, bool one_pixel) const {
        std::vector<std::string> arguments{command_,    "render",
                                           scene_,      "--quiet",
                                           "--size",    size_,
                                           "--spp",     std::to_string(samples),
                                           "--seed",    std::to_string(seed),
                                           "--threads", std::to_string(threads_),
                                           "--cells",   file("cells"),
                                           "-o",        file("picture.exr")};
        if (one_pixel) arguments.insert(arguments.end(), {"--crop", "0,0,1,1"});
        return run(arguments);
    }

    std::string command_, scene_, size_;
    int samples_, threads_;
    TemporaryFolder folder_;
    double preparing_ = 0;
};

// The results of one painter: pairs of pictures, each with its time.
class Measured {
  public:
    void add(const Picture& a, const Picture& b) {
        if (sums_.empty()) sums_.resize(a.luminances.size()), variances_.resize(a.luminances.size());
        if (a.luminances.size() != sums_.size() || b.luminances.size() != sums_.size())
            throw std::runtime_error("pictures of the same scene differ in size");
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            const double x = a.luminances[i], y = b.luminances[i];
            sums_[i] += x + y;
            variances_[i] += 0.5 * (x - y) * (x - y);
        }
        seconds_.push_back((a.seconds + b.seconds) / 2);
        ++pairs_;
    }
    std::vector<double> means() const { return scaled(sums_, 2 * pairs_); }
    // The mean over the picture, and its variance.
    double mean() const { return sum(sums_) / (2.0 * pairs_ * static_cast<double>(sums_.size())); }
    double variance_of_mean() const {
        const auto n = static_cast<double>(sums_.size());
        return sum(variances_) / pairs_ / (2.0 * pairs_) / (n * n);
    }
    // The error of one picture, relative to these means.
    double error(const std::vector<double>& means) const {
        const double average = sum(means) / static_cast<double>(means.size());
        double total = 0;
        for (std::size_t i = 0; i < means.size(); ++i)
            total += variances_[i] / pairs_ / (means[i] * means[i] + 0.01 * average * average);
        return total / static_cast<double>(means.size());
    }
    double seconds() const { return spread_of(seconds_).median; }

  private:
    static double sum(const std::vector<double>& values) {
        double total = 0;
        for (const double v : values) total += v;
        return total;
    }
    static std::vector<double> scaled(std::vector<double> values, int by) {
        for (double& v : values) v /= by;
        return values;
    }

    std::vector<double> sums_, variances_;
    std::vector<double> seconds_;
    int pairs_ = 0;
};

// Runs all painters alternately. The others are compared with the first one.
std::vector<Measured> measure(const std::vector<Painter>& painters, int rounds, std::uint32_t seed) {
    std::vector<Measured> measured(painters.size());
    for (int round = 0; round < rounds; ++round)
        for (std::size_t i = 0; i < painters.size(); ++i) {
            // Alternately forwards and backwards, each painter with its own seeds.
            const std::size_t k = round % 2 == 0 ? i : painters.size() - 1 - i;
            const auto first = seed + 2 * static_cast<std::uint32_t>(round) + 1000 * static_cast<std::uint32_t>(k);
            const Picture a = painters[k].paint(first), b = painters[k].paint(first + 1);
            measured[k].add(a, b);
        }
    return measured;
}

}  // namespace

Report light(const Settings& settings) {
    Report report("light", "noise per second of processor time: pictures of the gallery");
    const std::vector<std::string> names =
        !settings.scenes.empty() ? settings.scenes
        : settings.quick         ? std::vector<std::string>{"hourglass", "drinks"}
                                 : std::vector<std::string>{"hourglass",  "drinks",   "ice_cup",  "jelly_contact",
                                                            "land_block", "kintsugi", "soap_film"};
    const int rounds = settings.quick ? 2 : 4;
    const int longest = std::max(settings.width / 4, 1);  // of a picture's sides, in pixels
    report.say(fmt::format(
        "{} samples per pixel, {} pairs of pictures rendered alternately, longer side {} pixels, {} thread(s)",
        settings.samples, rounds, longest, settings.threads));
    report.say("error: relative variance of a picture's pixels; seconds: processor time of all threads for a picture");
    report.say("gain: error times seconds of a line, relative to the first line; above 1 is better for this build");
    Table table({{"scene", "scene", ""},
                 {"painter", "light by", ""},
                 {"mean", "mean", "{:.4f}"},
                 {"error", "error", "{:.5f}"},
                 {"seconds", "s", "{:.2f}"},
                 {"error_seconds", "error · s", "{:.5f}"},
                 {"gain", "gain ×", "{:.2f}"}});
    double logarithms = 0;
    int compared = 0;
    for (const std::string& name : names) {
        tracer::Scene scene = scene_file(name);
        const int larger = std::max(scene.film.width, scene.film.height);
        scene.film.width = std::max(1, scene.film.width * longest / larger);
        scene.film.height = std::max(1, scene.film.height * longest / larger);
        scene.settings.samples = settings.samples;
        const tracer::World world(scene);
        std::vector<Painter> painters;
        const auto add = [&](const char* what, tracer::Techniques techniques) {
            painters.push_back({what, [&, techniques](std::uint32_t seed) {
                                    return painted_here(world, scene, techniques, settings.threads, seed);
                                }});
        };
        add("all", tracer::Techniques::all);
        std::optional<OtherBuild> other;
        if (settings.against) {
            other.emplace(*settings.against, name, scene.film.resolution(), settings.samples, settings.threads);
            painters.push_back({"the other build", [&](std::uint32_t seed) { return other->paint(seed); }});
        } else {
            add("shadow rays alone", tracer::Techniques::shadow_rays_alone);
            add("directions alone", tracer::Techniques::directions_alone);
        }
        const std::vector<Measured> measured = measure(painters, rounds, settings.seed);
        const std::vector<double> means = measured[0].means();
        for (std::size_t i = 0; i < painters.size(); ++i) {
            const Measured& m = measured[i];
            const double error = m.error(means);
            const double gain = error * m.seconds() / (measured[0].error(means) * measured[0].seconds());
            table.row({name, painters[i].name, m.mean(), error, m.seconds(), error * m.seconds(), gain});
            if (i == 0 || !settings.against) continue;
            logarithms += std::log(gain);
            ++compared;
            // Both builds must show the same picture. The limit is wide, because the noise is not normally distributed.
            const double sigma = std::sqrt(m.variance_of_mean() + measured[0].variance_of_mean());
            const double off = (m.mean() - measured[0].mean()) / sigma;
            report.check(
                name + ": both builds have the same mean", std::abs(off) < 5,
                fmt::format("{:.5f} and {:.5f}, {:.1f} standard errors apart", measured[0].mean(), m.mean(), off));
        }
    }
    report.table("pictures", table);
    if (compared > 0) report.at_least("gain, geometric mean", std::exp(logarithms / compared), 1);
    return report;
}

}  // namespace phasetree::bench
