#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "command/commands.hpp"
#include "command/densities.hpp"
#include "command/duration.hpp"
#include "command/exit_codes.hpp"
#include "command/load.hpp"
#include "command/measure_report.hpp"
#include "command/metres.hpp"
#include "command/number_in.hpp"
#include "command/quantity.hpp"
#include "command/reading.hpp"
#include "command/streams.hpp"
#include "embree_core/line_tracer.hpp"
#include "embree_core/prepared_object.hpp"
#include "output/interrupt.hpp"
#include "output/late_progress.hpp"
#include "render/threads.hpp"

namespace phasetree::tracer {

namespace {

struct MeasureCommand {
    std::optional<std::string> object;
    double tolerance = MeasureOptions().tolerance;
    double seconds = 30;
    std::optional<std::string> unit;
    std::vector<std::string> densities;
    bool finds_thickness = false, as_json = false;
};

// For areas: the maximum shares of the time for preparing the object and for tracing lines.
constexpr double share_of_preparing = 0.5, share_of_areas = 0.2;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// Throws BuildCancelled.
AreaResult areas_of(const SceneFile& file, const Document& document, const SceneTree& tree,
                    const MeasureCommand& chosen, Clock::time_point start) {
    CellOptions cells;
    cells.quality = BuildQuality::low;
    cells.cancelled = [&] { return interrupted() || seconds_since(start) > share_of_preparing * chosen.seconds; };
    LateProgress preparing(ProgressOutput::standard_error(false), "preparing the object");
    cells.progress = [&](float done) { preparing.tell(done); };
    const auto prepared =
        made_of_tree(document, [&] { return std::make_unique<const embree::PreparedObject>(tree.object, cells); });
    print_warning(file.shown(), prepared->cells().warning());
    AreaOptions options;
    options.tolerance = std::max(options.tolerance, chosen.tolerance);
    options.seconds = share_of_areas * chosen.seconds;
    options.cancelled = [] { return interrupted(); };
    return estimate_areas(prepared->cells().bounds(), embree::line_tracer(prepared->scene()), options);
}

std::vector<WallThickness> thicknesses_of(const Document& document, const SceneTree& tree,
                                          const MeasureCommand& chosen) {
    ProveOptions options;
    options.seconds = chosen.seconds;
    options.cancelled = [] { return interrupted(); };
    LateProgress progress(ProgressOutput::standard_error(false), "finding thin walls");
    options.progress = [&](float done) { progress.tell(done); };
    return made_of_tree(document, [&] { return wall_thicknesses(tree.object, options); });
}

struct WhatToMeasure {
    Document document;
    SceneTree tree;
    LengthUnit unit;
    std::vector<std::pair<Phase, double>> densities;
};

WhatToMeasure read_what_to_measure(const SceneFile& file, const MeasureCommand& chosen) {
    const EndingAtOnce at_once = ending_before_results();
    const Document document = read_document(file);
    const SceneModel model = read_scene_model(document);
    const SceneTree tree = tree_of_model(document, model, chosen.object);
    const LengthUnit unit = length_unit(chosen.unit, model);
    const std::vector<std::pair<Phase, double>> densities = densities_of(chosen.densities, tree, model);
    (void)record_tree(document, tree.object);  // throws a precise error if the object is too large
    return {document, tree, unit, densities};
}

int measure_scene(const SceneFile& file, const MeasureCommand& chosen) {
    const AvailableThreads threads;
    const InterruptGuard guard;
    const WhatToMeasure given = read_what_to_measure(file, chosen);
    const Document& document = given.document;
    const SceneTree& tree = given.tree;
    const LengthUnit& unit = given.unit;
    const Clock::time_point start = Clock::now();
    AreaResult areas;
    try {
        areas = areas_of(file, document, tree, chosen, start);
    } catch (const BuildCancelled&) {
        // After an interruption, volumes of the first few boxes are known immediately.
        if (!interrupted())
            say("phasetree: warning: areas are left out, because preparing the object takes more than {:.0f} % of the "
                "time; allow more with --time\n",
                100 * share_of_preparing);
    }
    MeasureOptions options;
    options.tolerance = chosen.tolerance;
    options.densities = given.densities;
    options.cancelled = [] { return interrupted(); };
    LateProgress progress(ProgressOutput::standard_error(false), "measuring the object");
    options.progress = [&](float done) { progress.tell(done); };
    options.seconds =
        std::max(chosen.seconds - seconds_since(start), (1 - share_of_preparing - share_of_areas) * chosen.seconds);
    MeasureResult result = made_of_tree(document, [&] { return measure(tree.object, options); });
    std::vector<WallThickness> walls;
    if (chosen.finds_thickness) walls = thicknesses_of(document, tree, chosen);
    convert_to_metres(result, areas, unit);
    for (WallThickness& w : walls) {
        w.low *= unit.metres;
        w.high *= unit.metres;
        if (w.place) *w.place *= static_cast<float>(unit.metres);
    }
    const MeasureReport report{file.shown(), unit, tree.phases, result, areas, walls};
    if (chosen.as_json)
        print_json(report);
    else
        print_table(report);
    if (!interrupted()) return exit_code::success;
    say("phasetree: interrupted; printed what was known by then\n");
    return code_of_interruption(false);
}

}  // namespace

void add_measure(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("measure", "Print volumes, masses, centres of mass and areas of phases");
    command->footer(
        "Prints an interval and an estimate for each number. Volumes, masses, centres of mass, moments\n"
        "of inertia and bounding boxes are guaranteed to lie in their intervals. Areas are statistical\n"
        "estimates with a standard error.\n"
        "\n"
        "Lengths, areas and volumes are printed in the scene's unit, masses in kilograms. JSON always has\n"
        "metres and kilograms. With several objects, their union is measured; --object chooses one.\n"
        "Ctrl-C prints what is known so far.\n"
        "\n"
        "The whole scene file is checked, but it may lack a camera and lights, and the files of\n"
        "lights, meshes, textures and media are not opened.");
    const auto file = add_scene_file(*command);
    auto options = std::make_shared<MeasureCommand>();
    add_object(*command, options->object);
    command
        ->add_option("--tolerance", options->tolerance,
                     "Stop when the interval of each volume is at most this fraction of the volume (default: 0.001)")
        ->check(number_in(1e-9, 1))
        ->option_text("T");
    add_duration(*command, "--time", options->seconds,
                 "Time limit, after which the results so far are printed (default: 30s)");
    add_length_unit(*command, options->unit);
    add_densities(*command, options->densities);
    command->add_flag(
        "--thickness", options->finds_thickness,
        "Also print the smallest thickness of each phase, and where it is; this can take as long again as --time");
    command->add_flag("--json", options->as_json, "Print JSON");
    command->callback([=, &run] { run = [=] { return measure_scene(*file, *options); }; });
}

}  // namespace phasetree::tracer
