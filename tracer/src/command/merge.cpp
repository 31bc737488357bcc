#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>

#include "command/commands.hpp"
#include "command/denoising.hpp"
#include "command/errors.hpp"
#include "command/exit_codes.hpp"
#include "command/load.hpp"
#include "command/overwritten_files.hpp"
#include "command/pictures.hpp"
#include "command/reading.hpp"
#include "command/render_options.hpp"
#include "film_file/merge.hpp"
#include "output/interrupt.hpp"
#include "output/progress.hpp"
#include "phasetree/version.hpp"
#include "render/threads.hpp"

namespace phasetree::tracer {

namespace {

struct MergeOptions {
    std::vector<std::string> parts, outputs;
    std::optional<float> exposure;
    std::optional<std::string> display, view;
    std::optional<std::string> denoise;
    bool may_have_gaps = false, quiet = false;
};

// The merged film as an image, which is empty if not needed, and as film files if requested.
struct Joined {
    Image image;
    std::uint64_t samples = 0;  // over all pixels
    FilmFaults faults;
    bool is_complete = true;
};

std::uint64_t samples_within(const FilmTile& band, const PixelRange& shown) {
    std::uint64_t samples = 0;
    for (int y = std::max(band.area().y0, shown.y0); y < std::min(band.area().y1, shown.y1); ++y)
        for (int x = shown.x0; x < shown.x1; ++x) samples += band.samples(x, y);
    return samples;
}

Joined join(const Parts& parts, const std::vector<std::string>& film_files, bool has_image, Progress& progress) {
    const FilmFileHeader& header = parts.header();
    Joined joined;
    std::vector<std::unique_ptr<FilmFileWriter>> writers;
    for (const std::string& path : film_files) writers.push_back(std::make_unique<FilmFileWriter>(path, header));
    ByteWriter bytes;
    parts.join(
        [&](const FilmTile& band) {
            joined.faults += band.faults();
            if (has_image && joined.image.pixels.empty())
                joined.image = black_image(header.film, header.area, band.channels());
            if (has_image) band.write_into(joined.image, header.area);
            joined.samples += samples_within(band, header.shown);
            bytes.clear();
            std::uint64_t samples = 0;
            if (!writers.empty())
                for (int y = band.area().y0; y < band.area().y1; ++y) samples += band.write_row(y, bytes);
            for (const auto& writer : writers) writer->band(bytes.bytes(), samples);
            progress.advance(1);
        },
        [] { return interrupted(); });
    joined.is_complete = !interrupted();
    if (has_image && joined.is_complete && header.shown.size() != header.area.size())
        joined.image = part_of(joined.image, header.shown.x0 - header.area.x0, header.shown.y0 - header.area.y0,
                               header.shown.width(), header.shown.height());
    if (joined.is_complete)
        for (const auto& writer : writers) writer->finish(parts.are_joined());
    return joined;
}

bool write_pictures(const MergeOptions& options, const Parts& parts, const std::vector<std::string>& images,
                    const Joined& joined, const std::optional<DisplayTransform>& display) {
    Metadata metadata;
    metadata.scene = parts.header().scene;
    metadata.samples_per_pixel = static_cast<int>(joined.samples / parts.header().shown.size());
    metadata.seed = parts.header().seed;
    metadata.build = parts.header().build();
    Writing writing;
    std::string written;
    for (const std::string& output : images)
        if (writing([&] { write_image(joined.image, output, metadata, display); }))
            written += fmt::format("{} ({}x{}, {} samples per pixel, {} parts)\n", output, joined.image.width,
                                   joined.image.height, metadata.samples_per_pixel, options.parts.size());
    if (!options.quiet) say(written);
    return writing.has_succeeded();
}

// Opens all parts, reading only the beginning and end of each.
Parts opened(const MergeOptions& options) {
    const EndingAtOnce at_once = ending_at_once("the parts were being read", false);
    return {{options.parts.begin(), options.parts.end()}, options.may_have_gaps};
}

int merge_parts(const MergeOptions& options) {
    const InterruptGuard guard;
    const AvailableThreads threads;
    std::vector<std::string> images, film_files;
    for (const std::string& output : options.outputs) (is_film_file(output) ? film_files : images).push_back(output);
    check_outputs(options.outputs);
    // A single part is allowed: if one part remains after grouping, a farm's command list merges it by itself, which
    // copies it for the next step.
    const bool is_one = options.parts.size() == 1;
    check_overwrites(named_files_of("the part", options.parts),
                     named_files_of("--output", is_one ? images : options.outputs));
    const Parts parts = opened(options);
    check_outputs(images,
                  layers_of_picture(parts.header().film, parts.header().scene_names, options.denoise.has_value()));
    if (!options.quiet && parts.header().build() != build_id())
        say("phasetree: note: the parts were rendered by build {} and are merged by build {}\n", parts.header().build(),
            build_id());
    if (const std::string missing = parts.missing(); !missing.empty() && !images.empty() && !options.may_have_gaps)
        throw FilmFileError(fmt::format("{} of {} per pixel; --allow-gaps makes a picture of the others", missing,
                                        parts.header().samples_in_all));
    if (!film_files.empty() && !parts.are_joined())
        throw UsageError("cannot write a .part: samples are missing between the parts, or a part is unfinished");
    const Denoiser denoiser = denoiser_of(options.denoise.value_or("best"));
    if (options.denoise) check_denoising(parts.header().film.planes, !images.empty());
    const std::optional<std::string> view = options.view ? options.view : parts.header().view;
    std::optional<DisplayTransform> display;
    if (need_display(options.outputs) || options.display || options.view)
        display.emplace(options.display, view, options.exposure.value_or(parts.header().exposure_ev));
    Progress progress(static_cast<std::uint64_t>(parts.header().bands()), ProgressOutput::standard_error(options.quiet),
                      "merging");
    Joined joined = join(parts, film_files, !images.empty(), progress);
    progress.finish();
    if (!joined.is_complete) {
        say("phasetree: interrupted; no file was written\n");
        return code_of_interruption(false);
    }
    say_faults(joined.faults);
    if (options.denoise) denoise_picture(joined.image, {denoiser, threads.count(), options.quiet});
    return write_pictures(options, parts, images, joined, display) ? exit_code::success : exit_code::failure;
}

}  // namespace

void add_merge(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("merge", "Merge the parts of a picture that were rendered separately");
    auto o = std::make_shared<MergeOptions>();
    command->add_option("parts", o->parts, "The .part files that render --sample-range wrote, in any order")
        ->required();
    add_outputs(*command, o->outputs, "none");
    command->get_option("--output")->required();
    command->add_flag("--allow-gaps", o->may_have_gaps,
                      "Make a picture although samples are missing or parts are unfinished");
    add_denoise(*command, o->denoise);
    add_display_options(*command, o->exposure, o->display, o->view);
    command->add_flag("--quiet", o->quiet, "Print no progress, only errors");
    command->callback([o, &run] { run = [o] { return merge_parts(*o); }; });
}

}  // namespace phasetree::tracer
