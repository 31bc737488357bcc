#include "render/render.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>

#include "command/cells_report.hpp"
#include "command/checkpoints.hpp"
#include "command/commands.hpp"
#include "command/empty_object.hpp"
#include "command/load.hpp"
#include "command/pictures.hpp"
#include "command/render_options.hpp"
#include "film_file/read.hpp"
#include "output/cell_progress.hpp"
#include "output/interrupt.hpp"
#include "output/progress.hpp"
#include "phasetree/cells/file.hpp"
#include "phasetree/version.hpp"
#include "render/threads.hpp"
#include "scene/fingerprint.hpp"

namespace phasetree::tracer {

namespace {

void write_stats(const std::string& path, const RenderOptions& options, const World& world, const Rendering& r) {
    const auto per_ray = [&](std::uint64_t n) {
        return r.counters.rays ? static_cast<double>(n) / static_cast<double>(r.counters.rays) : 0.0;
    };
    nlohmann::ordered_json json;
    json["scene"] = options.scene->shown();
    json["width"] = r.image.width;
    json["height"] = r.image.height;
    json["samples"] = r.samples;
    json["threads"] = r.threads;
    json["simd"] = simd_target();
    json["render_seconds"] = r.seconds;
    json["paths"] = r.counters.paths;
    json["interactions"] = r.counters.interactions;
    json["rays"] = r.counters.rays;
    json["cell_visits_per_ray"] = per_ray(r.counters.trace.visits);
    json["batches_per_ray"] = per_ray(r.counters.trace.batches);
    json["samples_per_ray"] = static_cast<double>(batch_size) * per_ray(r.counters.trace.batches);
    json["phantom_steps_per_ray"] = per_ray(r.counters.trace.phantoms);
    const CellStatistics cells = world.geometry().object().statistics();
    json["instructions"] = world.geometry().object().whole().program().instructions.size();
    add_cells(json, cells);
    write_file(json.dump(2) + "\n", path);
}

// Makes sure that they can be written, before hours of work.
std::vector<std::string> outputs_of(const RenderOptions& options, const SampleRange& samples) {
    std::vector<std::string> outputs = options.outputs;
    if (outputs.empty()) {
        const std::string stem =
            options.scene->is_standard_input() ? "scene" : std::filesystem::path(options.scene->name).stem().string();
        if (options.share)
            outputs = {fmt::format("{}.{}-{}.part", stem, samples.first, samples.last)};
        else
            outputs = {stem + ".exr", stem + ".png"};
    }
    check_outputs(outputs);
    if (options.stats) check_file_writable(*options.stats);
    if (options.checkpoint) check_file_writable(*options.checkpoint);
    return outputs;
}

FilmFileHeader header_of(const RenderOptions& options, const Document& document, const Scene& scene,
                         const RenderJob& job) {
    FilmFileHeader h;
    const PixelRange& a = job.pixels;
    std::vector<std::string_view> planes;
    for (std::size_t i = 0; i < Planes::size; ++i)
        if (scene.film.planes[i]) planes.push_back(Planes::names[i]);
    h.settings = {{"version", fmt::format("{} with Embree {}", version(), PHASETREE_EMBREE_MAJOR)},
                  {"scene", fmt::format("{:016x}", fingerprint(document))},
                  {"size", fmt::format("{}x{}", scene.film.width, scene.film.height)},
                  {"crop", fmt::format("{},{},{},{}", a.x0, a.y0, a.x1, a.y1)},
                  {"planes", fmt::format("{}", fmt::join(planes, ","))},
                  {"seed", std::to_string(scene.settings.seed)},
                  {"max_depth", std::to_string(scene.settings.max_depth)},
                  {"build quality", options.quality == BuildQuality::low ? "low" : "medium"},
                  {"max memory", options.most_bytes == 0 ? "by default" : fmt::format("{} bytes", options.most_bytes)}};
    h.film = scene.film;
    h.subjects = {scene.phases.names};
    h.area = job.pixels;
    h.samples = *job.samples;
    h.samples_in_all = scene.settings.samples;
    h.scene = std::filesystem::path(options.scene->shown()).filename().string();
    h.seed = scene.settings.seed;
    h.exposure_ev = scene.settings.exposure_ev;
    h.view = scene.settings.view;
    return h;
}

// Adds what there is already. Throws FilmFileError.
void resume(const RenderOptions& options, const FilmFileHeader& header, Film& film) {
    if (!options.resume) return;
    try {
        const FilmFile file(*options.resume);
        file.check_picture(header);
        const SampleRange &wanted = header.samples, &found = file.header().samples;
        // The whole may have become more: samples are numbered, and the first of them are the same.
        if (found.first != wanted.first || found.last > wanted.last)
            throw file.error(fmt::format("it is to have the samples {}:{}, not {}:{}", found.first, found.last,
                                         wanted.first, wanted.last));
        file.add_to(film);
    } catch (const FilmFileMissing&) {
        if (!options.may_start) throw;
    }
}

struct Everything {
    const RenderOptions& options;
    const Scene& scene;
    const World& world;
    const DisplayTransform& display;
    const std::vector<std::string>& outputs;
    const FilmFileHeader& header;
    const Film& film;
};

// Returns whether all could be written, and sets whether the render can be resumed.
bool write_all(const Everything& e, const Rendering& rendering, bool& can_resume) {
    Metadata metadata;
    metadata.scene = e.options.scene->shown();
    metadata.samples_per_pixel = rendering.samples;
    metadata.seed = e.scene.settings.seed;
    Writing writing;
    std::string written;
    const auto write_film_file = [&](const std::string& path) {
        const bool is_written = writing([&] { write_film(path, e.header, e.film); });
        can_resume = can_resume || is_written;
        return is_written;
    };
    // First of all, should there be no time for the rest.
    const bool is_output = e.options.checkpoint && std::ranges::count(e.outputs, *e.options.checkpoint) > 0;
    if (e.options.checkpoint && !is_output) write_film_file(*e.options.checkpoint);
    for (const std::string& output : e.outputs) {
        const bool is_written = is_film_file(output)
                                    ? write_film_file(output)
                                    : writing([&] { write_image(rendering.image, output, metadata, e.display); });
        if (is_written)
            written += fmt::format("{} ({}x{}, {} samples a pixel, {:.1f} s)\n", output, rendering.image.width,
                                   rendering.image.height, rendering.samples, rendering.seconds);
    }
    if (e.options.stats) writing([&] { write_stats(*e.options.stats, e.options, e.world, rendering); });
    say_faults(rendering.faults);
    if (!e.options.quiet) say(written);
    return writing.all_is_well();
}

// What a run that a signal ended comes to.
int code_of_interruption(bool can_resume) {
    if (interrupting_signal() == SIGINT) return interrupted_by_person;
    return can_resume ? resume_me : 1;
}

// Whether the world is there; it is not if that was interrupted.
bool prepare(std::optional<World>& world, const RenderOptions& options, const Scene& scene, const RenderJob& job) {
    try {
        CellProgress progress(ProgressOutput::standard_error(options.quiet));
        world.emplace(scene, WorldOptions{.quality = options.quality,
                                          .cancelled = job.cancelled,
                                          .progress = [&](float done) { progress.tell(done); },
                                          .most_bytes = options.most_bytes,
                                          .kept_cells = options.cells});
        return true;
    } catch (const BuildCancelled&) {
        say("phasetree: interrupted while the object was being prepared; nothing is written\n");
        return false;
    } catch (const CellsFileError& e) {
        throw OutputError(e.what());
    }
}

Rendering rendered(const RenderOptions& options, const World& world, const Scene& scene, RenderJob& job,
                   const FilmFileHeader& header, Film& film) {
    std::uint64_t total = 0;
    for (int y = job.pixels.y0; y < job.pixels.y1; ++y)
        for (int x = job.pixels.x0; x < job.pixels.x1; ++x)
            total += static_cast<std::uint64_t>(job.samples->size()) - film.pixels().samples(x, y);
    Progress progress(total, ProgressOutput::standard_error(options.quiet));
    job.advance = [&](std::uint64_t n) { progress.advance(n); };
    std::optional<Checkpoints> checkpoints;
    if (options.checkpoint) checkpoints.emplace(*options.checkpoint, options.checkpoint_seconds, header, film);
    return render(world, scene, job, film);
}

int render_scene(const RenderOptions& options) {
    const AvailableThreads threads(options.threads);
    const Document document = read_document(*options.scene);
    Scene scene = load_scene(document);
    apply(options, scene);
    RenderJob job;
    job.pixels = pixels_of(options, scene);
    job.samples = samples_of(options, scene);
    job.threads = threads.count();
    job.cancelled = [] { return interrupted(); };
    const std::vector<std::string> outputs = outputs_of(options, *job.samples);
    const DisplayTransform display =
        display_of(document, scene.settings, options.display, options.view, options.exposure);
    if (threads.count() < threads.wanted())
        say("phasetree: only {} of {} threads can be started\n", threads.count(), threads.wanted());
    const FilmFileHeader header = header_of(options, document, scene, job);
    Film film = film_of(scene, job);
    resume(options, header, film);

    const InterruptGuard guard;
    std::optional<World> world;
    if (!prepare(world, options, scene, job)) return code_of_interruption(options.checkpoint || options.resume);
    if (world->geometry().object().size() == 0) say("{}\n", empty_object_warning(document));
    if (!options.quiet && world->geometry().object().statistics().is_coarser)
        say("phasetree: the object would take more memory than --max-memory allows: rays are slower\n");
    if (!options.quiet) print_warning(document.name(), world->geometry().object().warning());
    const Rendering rendering = rendered(options, *world, scene, job, header, film);

    bool can_resume = false;
    const bool all_is_well = write_all({options, scene, *world, display, outputs, header, film}, rendering, can_resume);
    if (rendering.cancelled)
        say("phasetree: interrupted; the image has {} of {} samples a pixel{}\n", rendering.samples,
            job.samples->size(), job.samples->size() == 1 ? ", in part" : "");
    if (!all_is_well) return 1;
    return rendering.cancelled ? code_of_interruption(can_resume) : 0;
}

}  // namespace

void add_render(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("render", "Path-trace a scene to images");
    auto o = std::make_shared<RenderOptions>();
    add_render_options(*command, *o);
    command->callback([o, &run] { run = [o] { return render_scene(*o); }; });
}

}  // namespace phasetree::tracer
