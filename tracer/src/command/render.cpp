#include "render/render.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>

#include "command/build_quality.hpp"
#include "command/cells_report.hpp"
#include "command/commands.hpp"
#include "command/detail.hpp"
#include "command/empty_object.hpp"
#include "command/load.hpp"
#include "command/max_memory.hpp"
#include "command/streams.hpp"
#include "output/cell_progress.hpp"
#include "output/file.hpp"
#include "output/interrupt.hpp"
#include "output/progress.hpp"
#include "output/write.hpp"
#include "phasetree/cells/file.hpp"
#include "render/threads.hpp"

namespace phasetree::tracer {

namespace {

struct Options {
    std::shared_ptr<SceneFile> scene;
    std::vector<std::string> outputs;
    std::optional<int> samples;
    std::optional<std::string> size;
    std::optional<std::string> crop;
    int threads = 0;
    BuildQuality quality = BuildQuality::medium;
    std::size_t most_bytes = 0;
    std::optional<std::uint32_t> seed;
    std::optional<float> exposure, detail;
    std::optional<std::string> display, view, stats, cells, planes;
    bool quiet = false;
};

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
        throw OutputError(fmt::format("{} must be {}, but is \"{}\"", option, form, text));
    return values;
}

PixelRange pixels(const Options& options, const Scene& scene) {
    PixelRange range = scene.film.whole();
    if (!options.crop) return range;
    const std::vector<int> c = integers(*options.crop, ',', 4, "--crop", "X0,Y0,X1,Y1 in pixels");
    range = {c[0], c[1], c[2], c[3]};
    if (range.x0 < 0 || range.y0 < 0 || range.x1 > scene.film.width || range.y1 > scene.film.height ||
        range.x0 >= range.x1 || range.y0 >= range.y1)
        throw OutputError(fmt::format("--crop {} is not a part of the {}x{} image", *options.crop, scene.film.width,
                                      scene.film.height));
    return range;
}

void write_stats(const std::string& path, const Options& options, const World& world, const Rendering& r) {
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

Planes::Choice planes_of(const std::string& list) {
    if (list == "all") return Planes::all();
    Planes::Choice choice = Planes::by_default();
    for (std::size_t from = 0; from <= list.size();) {
        const std::size_t to = std::min(list.find(',', from), list.size());
        const std::string_view name = std::string_view(list).substr(from, to - from);
        const auto found = std::ranges::find(Planes::names, name);
        if (found == Planes::names.end())
            throw OutputError(fmt::format("--planes: there is no plane \"{}\"; the planes are {}, and \"all\"", name,
                                          fmt::join(Planes::names, ", ")));
        choice[static_cast<std::size_t>(found - Planes::names.begin())] = true;
        from = to + 1;
    }
    return choice;
}

void apply(const Options& options, Scene& scene) {
    if (options.planes) scene.film.planes = planes_of(*options.planes);
    if (options.samples) scene.settings.samples = *options.samples;
    if (options.seed) scene.settings.seed = *options.seed;
    if (options.size) {
        const std::vector<int> size = integers(*options.size, 'x', 2, "--size", "WIDTHxHEIGHT in pixels");
        for (const int n : size)
            if (n < 1 || n > 32768)
                throw OutputError(fmt::format("--size {}: a side is 1 to 32768 pixels", *options.size));
        scene.film.width = size[0];
        scene.film.height = size[1];
    }
}

// Makes sure that they can be written, before hours of work.
std::vector<std::string> outputs_of(const Options& options) {
    std::vector<std::string> outputs = options.outputs;
    if (outputs.empty()) {
        const std::string stem =
            options.scene->is_standard_input() ? "scene" : std::filesystem::path(options.scene->name).stem().string();
        outputs = {stem + ".exr", stem + ".png"};
    }
    for (const std::string& output : outputs) check_writable(output);
    const auto is_exr = [](const std::string& output) { return format_of(output) == Format::exr; };
    if (options.planes && std::ranges::none_of(outputs, is_exr))
        throw OutputError("--planes needs an output that can hold them: name a .exr file with -o");
    if (options.stats) check_file_writable(*options.stats);
    return outputs;
}

// Writes all that can be written, after hours of work: where one file fails, the others do not. Returns whether none
// did.
class Writing {
  public:
    template <class Write>
    bool operator()(Write&& write) {
        try {
            write();
            return true;
        } catch (const std::bad_alloc&) {
            say("phasetree: out of memory\n");
        } catch (const std::exception& e) {
            say("phasetree: {}\n", e.what());
        }
        all_is_well_ = false;
        return false;
    }
    bool all_is_well() const { return all_is_well_; }

  private:
    bool all_is_well_ = true;
};

// What no sound scene leads to.
void say_faults(const FilmFaults& faults) {
    if (faults.not_finite > 0)
        say("phasetree: {} values of samples were not finite numbers and count as black; please report this scene\n",
            faults.not_finite);
    if (faults.too_large > 0)
        say("phasetree: {} values of samples were larger than 10^12 and are cut to that\n", faults.too_large);
}

bool write_all(const Options& options, const std::vector<std::string>& outputs, const DisplayTransform& display,
               const Scene& scene, const World& world, const Rendering& rendering) {
    Metadata metadata;
    metadata.scene = options.scene->shown();
    metadata.samples_per_pixel = rendering.samples;
    metadata.seed = scene.settings.seed;
    Writing writing;
    std::string written;
    for (const std::string& output : outputs)
        if (writing([&] { write_image(rendering.image, output, metadata, display); }))
            written += fmt::format("{} ({}x{}, {} samples a pixel, {:.1f} s)\n", output, rendering.image.width,
                                   rendering.image.height, rendering.samples, rendering.seconds);
    if (options.stats) writing([&] { write_stats(*options.stats, options, world, rendering); });
    say_faults(rendering.faults);
    if (!options.quiet) say(written);
    return writing.all_is_well();
}

int render_scene(const Options& options) {
    const AvailableThreads threads(options.threads);
    const Document document = read_document(*options.scene);
    Scene scene = load_scene(document);
    apply(options, scene);
    if (options.detail) made_of_tree(document, [&] { choose_levels_of_detail(scene, *options.detail); });
    const std::vector<std::string> outputs = outputs_of(options);
    const DisplayTransform display =
        display_of(document, scene.settings, options.display, options.view, options.exposure);
    if (threads.count() < threads.wanted())
        say("phasetree: only {} of {} threads can be started\n", threads.count(), threads.wanted());
    RenderJob job;
    job.pixels = pixels(options, scene);
    job.threads = threads.count();
    job.cancelled = [] { return interrupted(); };

    const InterruptGuard guard;
    std::optional<World> prepared;
    try {
        CellProgress progress(ProgressOutput::standard_error(options.quiet));
        prepared.emplace(scene, WorldOptions{.quality = options.quality,
                                             .cancelled = job.cancelled,
                                             .progress = [&](float done) { progress.tell(done); },
                                             .most_bytes = options.most_bytes,
                                             .kept_cells = options.cells});
    } catch (const BuildCancelled&) {
        say("phasetree: interrupted while the object was being prepared; nothing is written\n");
        return 1;
    } catch (const CellsFileError& e) {
        throw OutputError(e.what());
    }
    const World& world = *prepared;
    if (world.geometry().object().size() == 0) say("{}\n", empty_object_warning(document));
    if (!options.quiet && world.geometry().object().statistics().is_coarser)
        say("phasetree: the object would take more memory than --max-memory allows: rays are slower\n");
    if (!options.quiet) print_warning(document.name(), world.geometry().object().warning());
    const auto total = static_cast<std::uint64_t>(job.pixels.width()) *
                       static_cast<std::uint64_t>(job.pixels.height()) *
                       static_cast<std::uint64_t>(scene.settings.samples);
    Progress progress(total, ProgressOutput::standard_error(options.quiet));
    job.advance = [&](std::uint64_t n) { progress.advance(n); };
    const Rendering rendering = render(world, scene, job);
    progress.finish();

    const bool all_is_well = write_all(options, outputs, display, scene, world, rendering);
    if (rendering.cancelled)
        say("phasetree: interrupted; the image has {} of {} samples a pixel{}\n", rendering.samples,
            scene.settings.samples, scene.settings.samples == 1 ? ", in part" : "");
    return rendering.cancelled || !all_is_well ? 1 : 0;
}

}  // namespace

void add_render(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("render", "Path-trace a scene to images");
    auto o = std::make_shared<Options>();
    o->scene = add_scene_file(*command);
    command
        ->add_option("-o,--output", o->outputs,
                     "Image to write, the extension choosing the format: .exr .png .jpg .tif; may be repeated "
                     "(default: the scene's name, .exr and .png)")
        ->take_all()
        ->expected(1);
    command->add_option("--spp", o->samples, "Samples a pixel")->check(CLI::Range(1, 1 << 24));
    command->add_option("--size", o->size, "WIDTHxHEIGHT in pixels");
    command->add_option("--crop", o->crop, "X0,Y0,X1,Y1: only these pixels, from the top left, the last excluded");
    command->add_option("--threads", o->threads, "Threads (default: one a core); the image does not depend on it")
        ->check(CLI::Range(1, 1024));
    add_build_quality(*command, o->quality);
    add_max_memory(*command, o->most_bytes);
    command->add_option("--cells", o->cells,
                        "File that keeps the prepared object for the next time: read if it is there and of this "
                        "object, else written");
    command->add_option("--seed", o->seed, "Seed of the sampling");
    command->add_option("--exposure", o->exposure, "Stops by which display images are brighter; EXR stays as it is")
        ->check(CLI::Range(-50.0, 50.0));
    command
        ->add_option("--detail", o->detail,
                     "Lets coarser levels of detail stand where their errors look no larger than so many pixels; "
                     "without it the finest stand everywhere")
        ->check(CLI::Range(1e-3, 1e3))
        ->option_text("PIXELS");
    command->add_option("--display", o->display, "OpenColorIO display");
    command->add_option("--view", o->view, "OpenColorIO view");
    command->add_option("--planes", o->planes,
                        "Planes that .exr files hold beside the picture: names with commas between them, such as "
                        "depth,normal,crypto_phase, or all");
    command->add_option("--stats", o->stats, "Write what rendering cost, as JSON");
    command->add_flag("--quiet", o->quiet, "No progress, errors only");
    command->callback([o, &run] { run = [o] { return render_scene(*o); }; });
}

}  // namespace phasetree::tracer
