#include "command/render_options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "command/build_quality.hpp"
#include "command/denoising.hpp"
#include "command/duration.hpp"
#include "command/max_memory.hpp"
#include "command/number_in.hpp"
#include "command/option_error.hpp"
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
        throw OptionError(fmt::format("{} must be {}, but is \"{}\"", option, form, text));
    return values;
}

namespace {

constexpr int most_samples = 1 << 24;

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
        throw OptionError(fmt::format("--planes: {}", e.what()));
    }
}

}  // namespace

void apply(const RenderOptions& options, Scene& scene) {
    if (options.planes) scene.film.planes = planes_of(*options.planes);
    // A time limit without a number of samples means as many samples as fit.
    if (options.time_seconds > 0) scene.settings.samples = most_samples;
    if (options.samples_in_all) scene.settings.samples = *options.samples_in_all;
    if (options.noise) scene.settings.noise = *options.noise;
    if (options.seed) scene.settings.seed = *options.seed;
    if (options.size) {
        const std::vector<int> size = integers(*options.size, 'x', 2, "--size", "WIDTHxHEIGHT in pixels");
        for (const int n : size)
            if (n < 1 || n > 32768)
                throw OptionError(fmt::format("--size {}: a side is 1 to 32768 pixels", *options.size));
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
        throw OptionError(fmt::format("--crop {} is not a part of the {}x{} image", *options.crop, scene.film.width,
                                      scene.film.height));
    return range;
}

SampleRange samples_of(const RenderOptions& options, const Scene& scene) {
    SampleRange range{0, scene.settings.samples};
    if (!options.share) return range;
    if (options.time_seconds > 0)
        throw OptionError("--samples and --time: a share has to have all of its samples, however long that takes");
    if (scene.settings.noise > 0)
        throw OptionError(
            "--samples and --noise: where a pixel may stop is decided by all of its samples, of which a share has only "
            "some; --noise 0 turns off what the scene says");
    const std::vector<int> ends = integers(*options.share, ':', 2, "--samples", "FIRST:LAST, the last excluded");
    range = {ends[0], ends[1]};
    if (range.first < 0 || range.first >= range.last || range.last > scene.settings.samples)
        throw OptionError(fmt::format("--samples {}: they must be some of the {} samples a pixel, from 0 on",
                                      *options.share, scene.settings.samples));
    return range;
}

void add_outputs(CLI::App& command, std::vector<std::string>& outputs, const std::string& by_default) {
    command
        .add_option(
            "-o,--output", outputs,
            "File to write: an image, the extension choosing the format: .exr .png .jpg .tif, where {plane} in the "
            "name of a .exr makes a file for each plane; or .part, which merge joins with others; may be "
            "repeated (default: " +
                by_default + ")")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false);  // otherwise it consumes a following "--"
}

void add_display_options(CLI::App& command, std::optional<float>& exposure, std::optional<std::string>& display,
                         std::optional<std::string>& view) {
    command.add_option("--exposure", exposure, "Stops by which display images are brighter; EXR stays as it is")
        ->check(number_in(-50, 50));
    command.add_option("--display", display, "OpenColorIO display");
    command.add_option("--view", view, "OpenColorIO view");
}

void add_render_options(CLI::App& command, RenderOptions& o) {
    o.scene = add_scene_file(command);
    add_outputs(command, o.outputs, "the scene's name, .exr and .png");
    command.add_option("--spp", o.samples_in_all, "Samples a pixel")->check(CLI::Range(1, most_samples));
    add_duration(command, "--time", o.time_seconds,
                 "Stop at the last whole pass that ends within such a time as 90s, 5m or 1h from the start of the "
                 "command, preparing included; without --spp no number of samples ends it");
    command
        .add_option(
            "--noise", o.noise,
            "Blocks of 8x8 pixels stop before they have all samples where their estimated relative error is "
            "at most this, 0.02 for example; adds the planes noise and samples. 0: none stops. Where bright paths are "
            "rare and were missed a block stops too soon, so the picture gets a little darker")
        ->check(number_in(0, 1))
        ->option_text("ERROR");
    command
        .add_option("--samples", o.share,
                    "Only those of the samples a pixel that have these numbers, from 0, the last excluded: a share of "
                    "the work, which goes to a .part and is joined with the others by merge")
        ->option_text("FIRST:LAST");
    // Keep the pointer: looking an option up by name may throw where CLI11 allows no exception.
    CLI::Option* const frames = command.add_option(
        "--frames", o.frames,
        "Frames of a film by their numbers, from 0, the last excluded; each is at its number over the "
        "scene's \"frames_per_second\". In the names of files #### becomes the number");
    frames->option_text("FIRST:LAST");
    command.add_flag("--skip-existing", o.skips_existing, "With --frames: leave out frames whose files are all there")
        ->needs(frames);
    command.add_option("--size", o.size, "WIDTHxHEIGHT in pixels");
    command.add_option("--crop", o.crop, "X0,Y0,X1,Y1: only these pixels, from the top left, the last excluded");
    command.add_option("--threads", o.threads, "Threads (default: one a core); the image does not depend on it")
        ->check(CLI::Range(1, 1024));
    add_build_quality(command, o.quality);
    add_max_memory(command, o.most_bytes);
    command.add_option("--cells", o.cells,
                       "File that keeps the prepared object for the next time: read if it is there and of this "
                       "object, else written");
    command
        .add_option("--checkpoint", o.checkpoint,
                    "File that keeps what is done, from which --resume goes on: written every few minutes, when "
                    "SIGUSR1 arrives, and on exit, whatever the cause")
        ->option_text("FILE");
    add_duration(command, "--checkpoint-interval", o.checkpoint_seconds,
                 "Time from one checkpoint to the next, such as 90s, 5m or 1h (default: 5m)");
    command
        .add_option(
            "--resume", o.resume,
            "Go on from this checkpoint, which must be of the same picture; it may be the file of --checkpoint, "
            "too")
        ->option_text("FILE");
    command.add_flag("--or-start", o.may_start, "With --resume: start again if there is no such file");
    command.add_option("--seed", o.seed, "Seed of the sampling");
    command
        .add_option("--detail", o.detail,
                    "Lets coarser levels of detail stand where their errors look no larger than this many pixels; "
                    "without it the finest stand everywhere")
        ->check(number_in(1e-3, 1e3))
        ->option_text("PIXELS");
    add_display_options(command, o.exposure, o.display, o.view);
    command.add_option("--planes", o.planes,
                       "Planes that .exr files hold beside the picture: names with commas between them, such as "
                       "depth,normal,crypto_phase, or all");
    add_denoise(command, o.denoise);
    command.add_option("--stats", o.stats, "Write what rendering cost, as JSON");
    command.add_flag("--quiet", o.quiet, "No progress, errors only");
}

}  // namespace phasetree::tracer
