#include "render/render.hpp"
#include "command/errors.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "command/cells_report.hpp"
#include "command/checkpoints.hpp"
#include "command/commands.hpp"
#include "command/denoising.hpp"
#include "command/detail.hpp"
#include "command/empty_object.hpp"
#include "command/exit_codes.hpp"
#include "command/film_header.hpp"
#include "command/frames.hpp"
#include "command/load.hpp"
#include "command/not_shown_report.hpp"
#include "command/overlap_report.hpp"
#include "command/overwritten_files.hpp"
#include "command/pictures.hpp"
#include "command/reading.hpp"
#include "command/render_options.hpp"
#include "command/render_progress.hpp"
#include "command/unplaced_report.hpp"
#include "denoise/denoise.hpp"
#include "film_file/read.hpp"
#include "output/interrupt.hpp"
#include "output/late_progress.hpp"
#include "output/utf8_name.hpp"
#include "phasetree/cells/file.hpp"
#include "render/threads.hpp"
#include "scene/meshes_alone.hpp"

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
    const CellStatistics cells = world.geometry().statistics();
    std::size_t instructions = 0;
    for (const auto& object : world.geometry().objects()) instructions += object->whole().program().instructions.size();
    json["instructions"] = instructions;
    add_cells(json, cells);
    write_file(json.dump(2) + "\n", path);
}

// Checks that no output overwrites another file. A film file may serve as the checkpoint, as an output and as the file
// to resume from.
void check_overwrites(const RenderOptions& options, const Document& document, const std::vector<std::string>& outputs) {
    std::vector<NamedFile> written;  // except for film files
    for (const std::string& output : outputs)
        if (!is_film_file(output)) written.push_back({"--output", output});
    if (options.stats) written.push_back({"--stats", *options.stats});
    if (options.cells) written.push_back({"--cells", *options.cells});
    if (options.resume) {
        const NamedFile resumed{"--resume", *options.resume};
        check_overwrites(std::span(&resumed, 1), written);
    }
    for (const std::string& output : outputs)
        if (is_film_file(output)) written.push_back({"--output", output});
    const auto is_checkpoint = [&](const std::string& output) {
        return is_film_file(output) && is_same_file(output, *options.checkpoint);
    };
    if (options.checkpoint && std::ranges::none_of(outputs, is_checkpoint))
        written.push_back({"--checkpoint", *options.checkpoint});
    check_overwrites(*options.scene, document, written);
}

// Returns the names of the outputs. First checks, before rendering starts, that all files can be written.
std::vector<std::string> checked_outputs(const RenderOptions& options, const Document& document,
                                         const SampleRange& samples, const std::vector<std::string>& layers) {
    std::vector<std::string> outputs = options.outputs;
    if (outputs.empty()) {
        const std::string stem =
            options.scene->is_standard_input() ? "scene" : std::filesystem::path(options.scene->name).stem().string();
        if (options.share)
            outputs = {fmt::format("{}.{}-{}.part", stem, samples.first, samples.last)};
        else
            outputs = {stem + ".exr", stem + ".png"};
    }
    check_outputs(outputs, layers);
    const auto keeps_planes = [&](const std::string& output) {
        if (is_film_file(output)) return true;
        const Format format = format_of(output);
        return format == Format::exr || (options.planes == "alpha" && format != Format::jpeg);
    };
    if (options.planes && std::ranges::none_of(outputs, keeps_planes))
        throw UsageError(
            "--planes needs an output that can store planes: an .exr or .part file, or for alpha alone a .png or .tif "
            "file");
    if (options.stats) {
        require_utf8(options.scene->shown());
        check_file_writable(*options.stats);
    }
    if (options.checkpoint) check_file_writable(*options.checkpoint);
    check_overwrites(options, document, outputs);
    return outputs;
}

// Reads the file to resume. Returns nullopt if no resumption was requested, or if the file does not exist and the
// render may start from scratch. Throws FilmFileError.
std::optional<FilmFile> film_to_resume(const RenderOptions& options, const FilmFileHeader& header) {
    if (!options.resume) return std::nullopt;
    try {
        FilmFile file(*options.resume);
        file.check_picture(header);
        const SampleRange &wanted = header.samples, &found = file.header().samples;
        // The number of samples may differ from that of the earlier run: samples are numbered, and existing ones stay
        // valid.
        const bool has_too_many =
            found.last > wanted.last && file.most_samples_of_pixel() > static_cast<std::uint32_t>(wanted.size());
        if (found.first != wanted.first || has_too_many)
            throw file.error(fmt::format("it has the samples {}:{}, but this render has {}:{}", found.first, found.last,
                                         wanted.first, wanted.last));
        return file;
    } catch (const FilmFileMissing&) {
        if (!options.may_start) throw;
        return std::nullopt;
    }
}

struct FinishedRender {
    const RenderOptions& options;
    const Scene& scene;
    const World& world;
    const std::optional<DisplayTransform>& display;  // empty if no output needs one
    const std::vector<std::string>& outputs;
    const FilmFileHeader& header;
    const Film& film;
    Planes::Choice wanted_planes;  // by the user; denoising may need more
    bool is_finished;
};

// An interrupted frame is not written, because --skip-existing would take it for a complete one.
bool is_unfinished_frame(const RenderOptions& options, const Rendering& r) {
    return r.cancelled && options.frame;
}

// Returns whether all files were written.
bool write_all(const FinishedRender& e, Rendering& rendering) {
    Metadata metadata;
    metadata.scene = e.header.scene;
    metadata.samples_per_pixel = rendering.samples;
    metadata.seed = e.scene.settings.seed;
    Writing writing;
    std::string written;
    const auto write_film_file = [&](const std::string& path) {
        return writing([&] { write_film(path, e.header, e.film, e.is_finished); });
    };
    // Write the checkpoint first, in case there is no time for the rest. A checkpoint that is also an output is written
    // in its turn.
    const bool is_output = e.options.checkpoint && std::ranges::count(e.outputs, *e.options.checkpoint) > 0;
    if (e.options.checkpoint && !is_output) write_film_file(*e.options.checkpoint);
    const bool is_unfinished = is_unfinished_frame(e.options, rendering);
    if (e.options.denoise && !is_unfinished && !std::ranges::all_of(e.outputs, is_film_file)) {
        denoise_picture(rendering.image,
                        {denoiser_of(*e.options.denoise), rendering.threads, e.options.quiet, rendering.cancelled});
        leave_out(rendering.image, e.header.film.planes, e.wanted_planes, e.header.scene_names);
    }
    for (const std::string& output : e.outputs) {
        if (is_unfinished && output != e.options.checkpoint) continue;
        const bool is_written = is_film_file(output)
                                    ? write_film_file(output)
                                    : writing([&] { write_image(rendering.image, output, metadata, e.display); });
        if (is_written)
            written += fmt::format("{} ({}x{}, {} samples per pixel, {:.1f} s)\n", output, rendering.image.width,
                                   rendering.image.height, rendering.samples, rendering.seconds);
    }
    if (e.options.stats) writing([&] { write_stats(*e.options.stats, e.options, e.world, rendering); });
    say_faults(rendering.faults);
    if (!e.options.quiet) say(written);
    return writing.has_succeeded();
}

// Whether running the same command line again resumes the render, or starts it.
bool can_resume(const RenderOptions& options) {
    return options.resume && (options.may_start || std::filesystem::exists(*options.resume));
}

struct ReadScene {
    Document document;
    Scene scene;
};

ReadScene read(const RenderOptions& options) {
    const EndingAtOnce at_once = ending_at_once("the scene was being read", can_resume(options));
    Document document = read_document_showing(*options.scene, options.quiet);
    if (options.frame) document = document.at(seconds_of_frame(document, *options.frame));
    Scene scene = load_scene_showing(document, options.quiet);
    return {std::move(document), std::move(scene)};
}

// The header of the picture, and the film to resume, if any. Reads all files of the scene again.
std::pair<FilmFileHeader, std::optional<FilmFile>> read_checkpoint(const RenderOptions& options,
                                                                   const Document& document, const Scene& scene,
                                                                   const RenderJob& job) {
    const EndingAtOnce at_once = ending_at_once("the scene was being read", can_resume(options));
    FilmFileHeader header = header_of(options, document, scene, job);
    std::optional<FilmFile> found = film_to_resume(options, header);
    return {std::move(header), std::move(found)};
}

constexpr const char* while_preparing = "the object was being prepared";

// Builds the world. Returns false if a signal interrupted it.
bool prepare(std::optional<World>& world, const RenderOptions& options, const Scene& scene, const RenderJob& job) {
    LateProgress progress(ProgressOutput::standard_error(options.quiet), "preparing the object");
    const auto build = [&] {
        world.emplace(scene, WorldOptions{.quality = options.quality,
                                          .cancelled = job.cancelled,
                                          .progress = [&](float done) { progress.tell(static_cast<double>(done)); },
                                          .max_bytes = options.max_bytes,
                                          .kept_cells = options.cells});
    };
    try {
        if (options.cells) {  // a signal may have arrived while it was being written
            build();
        } else {
            const EndingAtOnce at_once = ending_at_once(while_preparing, can_resume(options));
            build();
        }
        return true;
    } catch (const BuildCancelled&) {
        say("phasetree: interrupted while {}; no file was written\n", while_preparing);
        return false;
    } catch (const CellsFileError& e) {
        if (e.reason() == CellsFileError::Reason::foreign) throw UsageError(fmt::format("--cells: {}", e.what()));
        throw OutputError(e.what());
    }
}

// Prints warnings about the prepared object.
void warn_of_object(const RenderOptions& options, const Document& document, const Scene& scene, const World& world) {
    if (world.geometry().statistics().cells == 0 && !has_meshes_alone(scene))
        say("{}\n", empty_object_warning(document));
    if (options.quiet) return;
    if (world.geometry().statistics().is_coarser)
        say("phasetree: warning: --max-memory is too small for the whole object, so tracing is slower\n");
    for (const auto& object : world.geometry().objects()) print_warning(document.name(), object->warning());
    warn_of_unplaced_groups(document, scene.placed);
    warn_of_overlaps(document, scene.placed);
    warn_of_what_is_not_shown(scene);
}

Rendering rendered(const RenderOptions& options, const World& world, const Scene& scene, RenderJob job,
                   const FilmFileHeader& header, Film& film) {
    std::uint64_t total = 0;
    for (int y = film.area().y0; y < film.area().y1; ++y)
        for (int x = film.area().x0; x < film.area().x1; ++x)
            total += static_cast<std::uint64_t>(job.samples->size()) - film.pixels().samples(x, y);
    // While this exists, another thread saves the film under a lock. It must not exist before the first sample, because
    // an empty film would replace a file that has samples.
    std::optional<Checkpoints> checkpoints;
    RenderProgress progress(ProgressOutput::standard_error(options.quiet), total, job.deadline,
                            scene.settings.guiding && total > 0, [&] {
                                if (options.checkpoint)
                                    checkpoints.emplace(*options.checkpoint, options.checkpoint_seconds, header, film);
                            });
    job.learned = [&](double share) { progress.learned(share); };
    job.advance = [&](std::uint64_t samples) { progress.advance(samples); };
    return render(world, scene, job, film);
}

bool has_samples(const Film& film) {
    const PixelRange& area = film.area();
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x)
            if (film.pixels().samples(x, y) > 0) return true;
    return false;
}

// Reports what is missing from a render that ended early.
void say_what_is_missing(const RenderOptions& options, const Scene& scene, const Rendering& r, int wanted) {
    if (is_unfinished_frame(options, r)) {
        say("phasetree: interrupted after {} of {} samples per pixel; the frame was not written\n", r.samples, wanted);
    } else if (r.cancelled) {
        say("phasetree: interrupted; the picture has {} of {} samples per pixel{}\n", r.samples, wanted,
            wanted == 1 ? ", and only in some pixels" : "");
    } else if (r.noisy_blocks > 0 && !options.quiet) {
        say("phasetree: {:.1f} % of the picture is still noisier than {} {}\n",
            100.0 * static_cast<double>(r.noisy_blocks) / static_cast<double>(r.blocks), scene.settings.noise,
            r.is_out_of_time ? "at the end of --time"
                             : fmt::format("after {} samples per pixel; raise --spp to continue", wanted));
    }
}

// Warns about outputs that cannot have the requested alpha.
void warn_of_alpha(const Scene& scene, const std::string& name, const std::vector<std::string>& outputs) {
    if (!scene.film.planes[Planes::index_of<AlphaPlane>()] || scene.lights.is_background_black()) return;
    for (const std::string& output : outputs)
        if (!is_film_file(output) && (format_of(output) == Format::png || format_of(output) == Format::tiff))
            say("{}: warning: {} has no alpha, because the background is not black; set \"background\": [0, 0, 0]\n",
                name, output);
}

int render_scene(const RenderOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    expect_checkpoint_requests();
    const InterruptGuard guard;
    const AvailableThreads threads(options.threads);
    ReadScene read_scene = read(options);
    const Document& document = read_scene.document;
    Scene& scene = read_scene.scene;
    apply(options, scene);
    const FilmSettings wanted_film = film_settings(scene);
    if (options.denoise) {
        check_denoising(*options.denoise, scene.settings.samples);
        scene.film.planes |= denoising_planes();
    }
    if (!scene.placed.empty() && (options.detail || options.cells))
        throw UsageError(fmt::format("{} needs a scene with a single \"tree\", and this one has \"objects\"",
                                     options.detail ? "--detail" : "--cells"));
    if (options.detail) made_of_tree(document, [&] { choose_levels_of_detail(scene, *options.detail); });
    RenderJob job;
    job.pixels = pixels_of(options, scene);
    job.samples = samples_of(options, scene);
    if (options.time_seconds > 0)
        job.deadline = start + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                   std::chrono::duration<double>(options.time_seconds));
    job.threads = threads.count();
    job.cancelled = [] { return interrupted(); };
    const std::vector<std::string> outputs =
        checked_outputs(options, document, *job.samples,
                        layers_of_picture(wanted_film, scene_names_of(scene), options.denoise.has_value()));
    warn_of_alpha(scene, document.name(), outputs);
    std::optional<DisplayTransform> display;
    if (need_display(outputs) || options.display || options.view)
        display = display_of(document, scene.settings, options.display, options.view, options.exposure);
    if (threads.count() < threads.wanted())
        say("phasetree: warning: only {} of {} threads can be started\n", threads.count(), threads.wanted());
    auto [header, found] = read_checkpoint(options, document, scene, job);

    std::optional<World> world;
    if (!prepare(world, options, scene, job)) return code_of_interruption(can_resume(options));
    // The header now also records whether the cells were made coarser, so compare the resumed file again.
    add_cells(header, options, world->geometry().statistics());
    Film film = film_of(scene, job);
    {
        const EndingAtOnce at_once = ending_at_once(while_preparing, can_resume(options));
        warn_of_object(options, document, scene, *world);
        if (found) {
            found->check_picture(header);
            found->add_to(film);
        }
    }
    Rendering rendering = rendered(options, *world, scene, job, header, film);

    // Interrupted before the first path, for example while guiding was learned. Keep the picture of an earlier render
    // rather than write a black one.
    if (rendering.cancelled && !has_samples(film)) {
        say("phasetree: interrupted before the first sample; no file was written\n");
        return code_of_interruption(can_resume(options));
    }
    // A render that runs out of time counts as one with the number of samples reached by then.
    if (rendering.is_out_of_time && scene.settings.noise == 0)
        header.samples.last = header.samples_in_all = header.samples.first + rendering.samples;
    const bool is_finished = !rendering.cancelled && scene.settings.noise > 0;
    const bool has_written =
        write_all({options, scene, *world, display, outputs, header, film, wanted_film.planes, is_finished}, rendering);
    say_what_is_missing(options, scene, rendering, job.samples->size());
    if (!has_written) return exit_code::failure;
    if (!rendering.cancelled) return exit_code::success;
    return code_of_interruption(options.checkpoint || (!options.frame && std::ranges::any_of(outputs, is_film_file)));
}

}  // namespace

void add_render(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("render", "Path-trace a scene to images");
    auto o = std::make_shared<RenderOptions>();
    add_render_options(*command, *o);
    command->callback(
        [o, &run] { run = [o] { return o->frames ? render_frames(*o, render_scene) : render_scene(*o); }; });
}

}  // namespace phasetree::tracer
