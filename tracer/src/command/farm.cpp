#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "command/commands.hpp"
#include "command/denoising.hpp"
#include "command/errors.hpp"
#include "command/farm_scripts.hpp"
#include "command/load.hpp"
#include "command/overwritten_files.hpp"
#include "command/pictures.hpp"
#include "command/render_options.hpp"

namespace phasetree::tracer {

namespace {

struct FarmOptions {
    std::string kind;
    std::shared_ptr<SceneFile> scene;
    int shares = 0, most_parts = 64, most_running = 0;
    std::vector<std::string> outputs, sbatch, render_words;
    std::string folder, program = "phasetree";
};

// Parses the options after "--" as `render` would. Throws UsageError.
RenderOptions render_options(const FarmOptions& options) {
    CLI::App app;
    RenderOptions render;
    add_render_options(app, render);
    std::vector<std::string> words = options.render_words;
    words.push_back(options.scene->name);
    std::ranges::reverse(words);  // CLI11 expects them in reverse
    try {
        app.parse(words);
    } catch (const CLI::ParseError& e) {
        throw UsageError(fmt::format("options after -- are for render, which reports: {}", e.what()));
    }
    if (!render.outputs.empty() || render.share || render.checkpoint || render.resume || render.stats)
        throw UsageError(
            "--output, --sample-range, --checkpoint, --resume and --stats are not allowed after --, because the same "
            "options go to every share");
    if (render.frames)
        throw UsageError("--frames is not allowed: a farm renders one picture; put --at before -- to choose its time");
    if (render.scene->at) throw UsageError("--at is not allowed after --; put it before --");
    if (render.time_seconds > 0) throw UsageError("--time is not allowed: a share needs all of its samples");
    return render;
}

// A file name that no command mistakes for an option.
std::string as_file(const std::string& name) {
    return name.starts_with('-') ? "./" + name : name;
}

// Checks limits now that would otherwise make every machine of the farm fail.
void check_limits(const Farm& farm) {
    // Limits of most file systems, and of Linux for one argument: `sh -c` receives the whole line as one.
    constexpr std::size_t longest_name = 255, longest_line = (128 << 10) - 1;
    const std::string part = std::filesystem::path(part_of_share(farm, farm.shares - 1)).filename().string();
    if (part.size() > longest_name)
        throw UsageError(
            fmt::format("names of parts such as \"{}\" would have {} bytes, and file systems allow {}; give the scene "
                        "file a shorter name",
                        part, part.size(), longest_name));
    if (const std::size_t bytes = longest_merge_line(farm); bytes > longest_line)
        throw UsageError(fmt::format(
            "--merge-width {}: the command line of a merge would have {} bytes, and Linux allows {}; choose "
            "a smaller number",
            farm.most_parts, bytes, longest_line));
}

int write_farm(const FarmOptions& options) {
    if (options.kind != "slurm" && options.kind != "list")
        throw UsageError(fmt::format("the kind of farm must be slurm or list, but is \"{}\"", options.kind));
    if (options.kind != "slurm" && options.most_running > 0)
        throw UsageError(
            "--max-running is for slurm only; the program that runs a list decides how many run at a time");
    if (options.scene->is_standard_input())
        throw UsageError("the scene must be a file that all machines can read, not standard input");
    const RenderOptions render = render_options(options);
    const Document document = read_document(*options.scene);
    Scene scene = load_scene(document);
    apply(render, scene);
    (void)pixels_of(render, scene);
    if (scene.settings.noise > 0)
        throw UsageError(
            "a farm cannot be combined with a noise limit: a share does not have all samples of a pixel, so it cannot "
            "decide when to stop; -- --noise 0 turns off the scene's limit");
    Farm farm;
    farm.program = options.program;
    farm.scene = as_file(options.scene->name);
    farm.render_options = options.render_words;
    farm.has_threads = render.threads > 0;
    if (options.scene->assets_within) {
        farm.render_options.push_back("--assets-within");
        farm.render_options.push_back(*options.scene->assets_within);
    }
    if (options.scene->at) {
        farm.render_options.push_back("--at");
        farm.render_options.push_back(fmt::format("{}", *options.scene->at));
    }
    const std::filesystem::path stem = std::filesystem::path(options.scene->name).stem();
    farm.parts = as_file((std::filesystem::path(options.folder) / stem).string());
    farm.outputs = options.outputs;
    if (farm.outputs.empty()) farm.outputs = {stem.string() + ".exr", stem.string() + ".png"};
    for (std::string& output : farm.outputs) output = as_file(output);
    check_outputs(farm.outputs,
                  layers_of_picture(film_settings(scene), scene_names_of(scene), render.denoise.has_value()));
    std::vector<NamedFile> written = named_files_of("--output", farm.outputs);
    if (render.cells) written.push_back({"--cells", *render.cells});
    check_overwrites(*options.scene, document, written);
    farm.sbatch_options = options.sbatch;
    farm.samples = scene.settings.samples;
    farm.shares = options.shares;
    farm.most_parts = options.most_parts;
    farm.most_running = options.most_running;
    if (farm.shares > farm.samples)
        throw UsageError(
            fmt::format("--shares {}: must be at most the number of samples per pixel, {}", farm.shares, farm.samples));
    for (const auto& [name, value] :
         {std::pair("--display", render.display), std::pair("--view", render.view),
          std::pair("--exposure", render.exposure ? std::optional(fmt::format("{}", *render.exposure)) : std::nullopt)})
        if (value) farm.merge_options.insert(farm.merge_options.end(), {name, *value});
    if (render.denoise) {
        check_denoising(*render.denoise, scene.settings.samples);
        farm.merge_options.push_back("--denoise=" + *render.denoise);
    }
    check_limits(farm);
    const std::string text = options.kind == "slurm" ? slurm_script(farm) : command_list(farm);
    const auto has_line_feed = [](const std::string& word) { return word.find('\n') != std::string::npos; };
    std::vector<std::string> all{farm.program, farm.scene, farm.parts};
    for (const auto* words : {&farm.render_options, &farm.outputs, &farm.sbatch_options})
        all.insert(all.end(), words->begin(), words->end());
    if (std::ranges::any_of(all, has_line_feed)) throw UsageError("arguments of a farm must not contain newlines");
    put(text);
    return 0;
}

}  // namespace

void add_farm(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("farm", "Write the commands that render a scene on many machines");
    auto o = std::make_shared<FarmOptions>();
    command
        ->add_option("kind", o->kind,
                     "slurm: a bash script that submits job arrays and a merge. list: one command per line, the merge "
                     "last, for OpenCue, GNU parallel or nq")
        ->required();
    o->scene = add_scene_file(*command);
    command->add_option("render", o->render_words, "After --: options of render, for every share");
    command->add_option("--shares", o->shares, "Number of shares into which the samples of each pixel are divided")
        ->required()
        ->check(CLI::Range(1, 1 << 20));
    command
        ->add_option("--merge-width", o->most_parts,
                     "Maximum number of parts per merge; more shares are merged in several steps (default: 64)")
        ->check(CLI::Range(2, 1 << 20))
        ->option_text("PARTS");
    command
        ->add_option(
            "--max-running", o->most_running,
            "Slurm: run at most this many shares, or merges, at a time (default: no limit). If the shares need several "
            "job arrays, each array waits for the one before it")
        ->check(CLI::Range(1, 1 << 20))
        ->option_text("N");
    add_outputs(*command, o->outputs, "the scene's name, .exr and .png");
    command->add_option("--parts", o->folder, "Existing folder for the parts (default: the current one)")
        ->option_text("DIR");
    command
        ->add_option("--sbatch", o->sbatch,
                     "Option of sbatch for all jobs, as in --sbatch=--time=60; may be repeated")
        ->take_all()
        ->expected(1)
        ->allow_extra_args(false)  // otherwise it consumes a following "--"
        ->option_text("OPTION");
    command
        ->add_option("--program", o->program, "The phasetree command on the machines of the farm (default: phasetree)")
        ->option_text("PATH");
    command->callback([o, &run] { run = [o] { return write_farm(*o); }; });
}

}  // namespace phasetree::tracer
