#include "command/render_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "command/build_quality.hpp"
#include "command/denoising.hpp"
#include "command/duration.hpp"
#include "command/errors.hpp"
#include "command/max_memory.hpp"
#include "command/number_in.hpp"
#include "command/streams.hpp"
#include "film/chosen_planes.hpp"

namespace phasetree::tracer {

std::vector<int> integers(const std::string& text, char separator, std::size_t count, const char* option,
                          const char* form) {
    std::vector<int> values;
    std::size_t from = 0;
    while (from <= text.size() && values.size() < count) {
        const std::size_t to = std::min(text.find(separator, from), text.size());
        int value = 0;
        const auto [end, error] = std::from_chars(text.data() + from, text.data() + to, value);
        if (error != std::errc() || end != text.data() + to || from == to) break;
        values.push_back(value);
        from = to + 1;
    }
    if (values.size() != count || from != text.size() + 1)
        throw UsageError(fmt::format("{} must be {}, but is \"{}\"", option, form, text));
    return values;
}

namespace {

constexpr int max_samples = 1 << 24;

Planes::Choice planes_of(const std::string& list) {
    std::vector<std::string> names;
    for (std::size_t from = 0; from <= list.size();) {
        const std::size_t to = std::min(list.find(',', from), list.size());
        names.push_back(list.substr(from, to - from));
        from = to + 1;
    }
    try {
        return chosen_planes(names);
    } catch (const std::invalid_argument& e) {
        throw UsageError(fmt::format("--planes: {}", e.what()));
    }
}

}  // namespace

void apply(const RenderOptions& options, Scene& scene) {
    if (options.planes) scene.film.planes = planes_of(*options.planes);
    // A time limit without a number of samples means as many samples as fit.
    if (options.time_seconds > 0) scene.settings.samples = max_samples;
    if (options.samples_in_all) scene.settings.samples = *options.samples_in_all;
    if (options.noise) scene.settings.noise = *options.noise;
    if (options.seed) scene.settings.seed = *options.seed;
    if (options.size) {
        const std::vector<int> size = integers(*options.size, 'x', 2, "--size", "WIDTHxHEIGHT in pixels");
        for (const int n : size)
            if (n < 1 || n > 32768)
                throw UsageError(
                    fmt::format("--size {}: width and height must be from 1 to 32768 pixels", *options.size));
        scene.film.width = size[0];
        scene.film.height = size[1];
    }
}

PixelRange pixels_of(const RenderOptions& options, const Scene& scene) {
    PixelRange range = scene.film.whole();
    if (!options.crop) return range;
    const std::vector<int> c = integers(*options.crop, ',', 4, "--crop", "X0,Y0,X1,Y1 in pixels");
    range = {c[0], c[1], c[2], c[3]};
    if (range.x0 < 0 || range.y0 < 0 || range.x1 > scene.film.width || range.y1 > scene.film.height ||
        range.x0 >= range.x1 || range.y0 >= range.y1)
        throw UsageError(fmt::format("--crop {}: the region must not be empty and must lie within the {}x{} picture",
                                     *options.crop, scene.film.width, scene.film.height));
    return range;
}

SampleRange samples_of(const RenderOptions& options, const Scene& scene) {
    SampleRange range{0, scene.settings.samples};
    if (!options.share) return range;
    if (options.time_seconds > 0)
        throw UsageError(
            "--sample-range cannot be combined with --time: a share needs all of its samples, however long they take");
    if (scene.settings.noise > 0)
        throw UsageError(
            "--sample-range cannot be combined with a noise limit: a share does not have all samples of a pixel, so it "
            "cannot decide when to stop; --noise 0 turns off the scene's limit");
    const std::vector<int> ends =
        integers(*options.share, ':', 2, "--sample-range", "FIRST:LAST, where LAST is excluded");
    range = {ends[0], ends[1]};
    if (range.first < 0 || range.first >= range.last || range.last > scene.settings.samples)
        throw UsageError(fmt::format("--sample-range {}: the range must not be empty and must lie within 0:{}",
                                     *options.share, scene.settings.samples));
    return range;
}

void add_outputs(CLI::App& command, std::vector<std::string>& outputs, const std::string& by_default) {
    command
        .add_option(
            "-o,--output", outputs,
            "Output file, whose extension selects the format: .exr, .png, .jpg, .tif, or .part for merge. {plane} in "
            "the name of an .exr writes one file per plane. May be repeated (default: " +
                by_default + ")")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);  // otherwise it consumes a following "--"
}

void add_display_options(CLI::App& command, std::optional<float>& exposure, std::optional<std::string>& display,
                         std::optional<std::string>& view) {
    command.add_option("--exposure", exposure, "Brighten display images by this many stops; .exr files do not change")
        ->check(number_in(-50, 50));
    command.add_option("--display", display, "OpenColorIO display (default: that of the configuration)");
    command.add_option("--view", view, "OpenColorIO view (default: that of the scene or the configuration)");
}

void add_render_options(CLI::App& command, RenderOptions& o) {
    o.scene = add_scene_file(command);
    add_outputs(command, o.outputs, "the scene's name, .exr and .png");
    command.add_option("--spp", o.samples_in_all, "Samples per pixel (default: that of the scene)")
        ->check(CLI::Range(1, max_samples));
    add_duration(command, "--time", o.time_seconds,
                 "Time limit, such as 90s, 5m or 1h, from the start of the command, including preparation. Rendering "
                 "stops after the last whole pass that fits. Without --spp the number of samples is not limited");
    command
        .add_option(
            "--noise", o.noise,
            "Stop sampling each block of 8x8 pixels once its estimated relative error is at most this, such as 0.02; 0 "
            "turns this off. Adds the planes noise and samples. A block that missed rare bright paths stops too early, "
            "so the picture gets slightly darker")
        ->check(number_in(0, 1))
        ->option_text("ERROR");
    CLI::Option* const range = command.add_option(
        "--sample-range", o.share,
        "Render only these samples of each pixel, numbered from 0, with LAST excluded: a share of the work. Write it "
        "to a .part and join the parts with merge");
    range->option_text("FIRST:LAST");
    // CLI11 runs these functions in the order in which options are added, so that of --sample-range has already run.
    const auto use_old_name = [&share = o.share](const std::string& text) {
        if (share) throw CLI::ValidationError("--samples is the old name of --sample-range; give only one of them");
        say("phasetree: warning: --samples is deprecated; use --sample-range instead\n");
        share = text;
    };
    command.add_option_function<std::string>("--samples", use_old_name, "Old name of --sample-range")
        ->group("");  // not listed
    // Keep the pointer: looking an option up by name may throw where CLI11 allows no exception.
    CLI::Option* const frames = command.add_option(
        "--frames", o.frames,
        "Render these frames of an animation, numbered from 0, with LAST excluded. Frame N shows the time N / "
        "\"frames_per_second\". #### in file names stands for the frame number");
    frames->option_text("FIRST:LAST");
    command.add_flag("--skip-existing", o.skips_existing, "With --frames: skip frames whose output files all exist")
        ->needs(frames);
    command.add_option("--size", o.size, "WIDTHxHEIGHT of the picture in pixels (default: that of the scene)");
    command.add_option("--crop", o.crop,
                       "X0,Y0,X1,Y1: render only these pixels, counted from the top left, with X1 and Y1 excluded");
    command
        .add_option("--threads", o.threads,
                    "Number of threads (default: one per core); the picture does not depend on it")
        ->check(CLI::Range(1, 1024));
    add_build_quality(command, o.quality);
    add_max_memory(command, o.max_bytes);
    command.add_option("--cells", o.cells,
                       "Keep the prepared object in this file for the next run. The file is read if it belongs to this "
                       "object and this build, and otherwise written");
    command
        .add_option("--checkpoint", o.checkpoint,
                    "File for the finished samples, from which --resume continues. It is written every few minutes, on "
                    "SIGUSR1, and on exit, whatever the cause")
        ->option_text("FILE");
    add_duration(command, "--checkpoint-interval", o.checkpoint_seconds,
                 "Time between checkpoints, such as 90s, 5m or 1h (default: 5m)");
    command
        .add_option("--resume", o.resume,
                    "Continue from this checkpoint of the same picture; it may be the file of --checkpoint")
        ->option_text("FILE");
    command.add_flag("--or-start", o.may_start, "With --resume: start a new render if the file does not exist");
    command.add_option("--seed", o.seed, "Seed of the random numbers; a different seed gives different noise");
    command
        .add_option("--detail", o.detail,
                    "Use coarser levels of detail where their error is at most this many pixels (default: the finest "
                    "level everywhere)")
        ->check(number_in(1e-3, 1e3))
        ->option_text("PIXELS");
    add_display_options(command, o.exposure, o.display, o.view);
    command.add_option("--planes", o.planes,
                       "Planes to add to .exr files: names separated by commas, such as depth,normal,crypto_phase, or "
                       "all");
    add_denoise(command, o.denoise);
    command.add_option("--stats", o.stats, "Write counters and times of the render to this file, as JSON");
    command.add_flag("--quiet", o.quiet, "Print no progress, only errors");
}

}  // namespace phasetree::tracer
