#include "caustics/caustics.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "caustics/trace_photon.hpp"
#include "image/luminance.hpp"
#include "phasetree/math/float_mode.hpp"
#include "sampling/shutter_time.hpp"
#include "sampling/warps.hpp"
#include "world/chain.hpp"

namespace phasetree::tracer {

namespace {

constexpr std::size_t photons_per_task = 4096;

// The number of photons per source, and their maximum number in total, that are traced for learning before the first
// pass.
constexpr std::size_t learning_photons_per_source = 1 << 15, max_learning_photons = 1 << 18;

// Photons have pixel coordinates of their own, so that their random numbers differ from those of the picture.
constexpr std::uint32_t column_of_passes = 0x80000000u, column_of_learning = 0x80000001u;

// The size of a pixel at a distance from the camera, at the centre of the picture.
float pixel_size(const Scene& scene, float distance) {
    const Camera camera(scene.camera, scene.film.resolution());
    const glm::dvec2 middle = 0.5 * glm::dvec2(scene.film.resolution());
    const glm::vec2 lens(0.5f);
    const CameraRay a = camera.generate(middle, lens), b = camera.generate(middle + glm::dvec2(1, 0), lens);
    return glm::length((a.origin + distance * a.direction) - (b.origin + distance * b.direction));
}

// The wavelengths with which photons are emitted; null if they are emitted in red, green and blue.
const Wavelengths* spectral(const std::optional<Wavelengths>& wavelengths) {
    return wavelengths && wavelengths->is_spectral ? &*wavelengths : nullptr;
}

float distance_to_object(const World& world, const Scene& scene) {
    const Camera camera(scene.camera, scene.film.resolution());
    const CameraRay ray = camera.generate(0.5 * glm::dvec2(scene.film.resolution()), glm::vec2(0.5f));
    return glm::length(world.geometry().bounds().centre() - ray.origin);
}

}  // namespace

Caustics::Caustics(const World& world, const Scene& scene)
    : world_(world),
      scene_(scene),
      emission_(world, scene),
      photons_per_pass_(
          static_cast<std::size_t>(scene.settings.photons * static_cast<float>(scene.film.whole().size()))),
      first_radius_(scene.settings.photon_radius * pixel_size(scene, distance_to_object(world, scene))) {
    if (emission_.sources() > 0 && photons_per_pass_ > 0) learn();
}

float Caustics::radius(int pass) const {
    return first_radius_ * std::pow(1.0f + static_cast<float>(pass), -1.0f / 6.0f);
}

float Caustics::time(int pass) const {
    return scene_.moves() ? shutter_time(column_of_passes, 0, static_cast<std::uint32_t>(pass), scene_.settings.seed)
                          : 0.0f;
}

std::optional<Wavelengths> Caustics::wavelengths(int pass) const {
    if (!world_.needs_wavelengths()) return std::nullopt;
    Sampler sampler(column_of_passes, 0, static_cast<std::uint32_t>(pass), scene_.settings.seed);
    return world_.wavelengths(sampler.next_evenly());
}

// The worth of a photon is its power times its MIS weight in the first pass, on a white diffuse surface or in a medium
// that scatters isotropically. `expected` is N π r² cos θ, and `pdf` that with which a path would continue in the
// photon's direction.
double Caustics::worth_of(const Photon& photon, float expected, float pdf) const {
    const float ior = clear_at(scene_, photon.phase).ior;
    const float by_photons = expected * photon.line_density * ior * ior;
    const float weight =
        photon.weight(by_photons, pdf, [&] { return scene_.lights.pdf(photon.position, photon.direction); });
    return static_cast<double>(brightness(photon.power, scene_.settings.spectral) * weight);
}

void Caustics::learn() {
    const std::size_t count = std::min(max_learning_photons, learning_photons_per_source * emission_.sources());
    struct Worth {
        std::size_t source = 0, bin = 0;
        double worth = 0;
    };
    std::vector<Worth> found(count);
    const float expected = static_cast<float>(photons_per_pass_) * pi * first_radius_ * first_radius_;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, photons_per_task), [&](const auto& range) {
        const FlushSubnormals flush;
        PathCounters uncounted;
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            Sampler sampler(column_of_learning, 0, static_cast<std::uint32_t>(i), scene_.settings.seed);
            // Learning covers the whole shutter interval.
            const float time = scene_.moves() ? shutter_time(column_of_learning, 0, static_cast<std::uint32_t>(i),
                                                             scene_.settings.seed)
                                              : 0.0f;
            std::optional<Wavelengths> wavelengths;
            if (world_.needs_wavelengths()) wavelengths = world_.wavelengths(sampler.next());
            const std::optional<EmittedPhoton> emitted = emission_.sample(sampler, time, spectral(wavelengths));
            if (!emitted) continue;
            TracedPhotons traced;
            trace_photon(world_, scene_, *emitted, first_radius_, sampler, uncounted, traced, wavelengths);
            double worth = 0;
            for (const Photon& photon : traced.on_surfaces)
                worth += worth_of(photon, expected * 0.5f, cosine_hemisphere_pdf(0.5f));
            for (const Photon& photon : traced.on_interfaces)
                worth += worth_of(photon, expected * 0.5f, cosine_hemisphere_pdf(0.5f));
            for (const MediumPhoton& medium : traced.in_media)
                worth += worth_of(medium.photon, expected, HenyeyGreenstein().evaluate(0.0f));
            found[i] = {emitted->source, emitted->bin, worth};
        }
    });
    // Summed in order of the photons, independently of the threads that traced them.
    std::vector<std::vector<double>> worth;
    for (std::size_t i = 0; i < emission_.sources(); ++i) worth.emplace_back(emission_.bins(i), 0.0);
    for (const Worth& w : found) worth[w.source][w.bin] += w.worth;
    emission_.learn(std::move(worth));
}

TracedPhotons Caustics::traced(std::uint32_t pass, std::size_t from, std::size_t to, PathCounters& counters) const {
    const FlushSubnormals flush;
    const std::optional<Wavelengths> of_pass = wavelengths(static_cast<int>(pass));
    const float gathered_within = radius(static_cast<int>(pass));
    TracedPhotons photons;
    for (std::size_t i = from; i < to; ++i) {
        Sampler sampler(column_of_passes, pass, static_cast<std::uint32_t>(i), scene_.settings.seed);
        const std::optional<EmittedPhoton> emitted =
            emission_.sample(sampler, time(static_cast<int>(pass)), spectral(of_pass));
        if (emitted) trace_photon(world_, scene_, *emitted, gathered_within, sampler, counters, photons, of_pass);
    }
    return photons;
}

std::optional<PhotonMap> Caustics::photons(int pass, PathCounters& counters,
                                           const std::function<bool()>& cancelled) const {
    const std::size_t count = emission_.sources() > 0 ? photons_per_pass_ : 0;
    const std::size_t tasks = (count + photons_per_task - 1) / photons_per_task;
    std::vector<TracedPhotons> parts(tasks);
    std::vector<PathCounters> costs(tasks);
    std::atomic<bool> stopped{false};
    tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
        if (stopped || cancelled()) {
            stopped = true;
            return;
        }
        const std::size_t from = task * photons_per_task;
        parts[task] =
            traced(static_cast<std::uint32_t>(pass), from, std::min(from + photons_per_task, count), costs[task]);
    });
    if (stopped) return std::nullopt;
    TracedPhotons photons;
    const auto append = [](auto& all, const auto& part) { all.insert(all.end(), part.begin(), part.end()); };
    for (std::size_t task = 0; task < tasks; ++task) {
        append(photons.on_surfaces, parts[task].on_surfaces);
        append(photons.on_interfaces, parts[task].on_interfaces);
        append(photons.in_media, parts[task].in_media);
        counters += costs[task];
    }
    return PhotonMap(photons, count, radius(pass), wavelengths(pass));
}

}  // namespace phasetree::tracer
