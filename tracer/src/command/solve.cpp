#include "phasetree/measuring/solve.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include "command/commands.hpp"
#include "command/densities.hpp"
#include "command/duration.hpp"
#include "command/errors.hpp"
#include "command/exit_codes.hpp"
#include "command/load.hpp"
#include "command/number_in.hpp"
#include "command/number_path.hpp"
#include "command/overwritten_files.hpp"
#include "command/quantity.hpp"
#include "command/reading.hpp"
#include "command/solve_report.hpp"
#include "command/streams.hpp"
#include "output/file.hpp"
#include "output/interrupt.hpp"
#include "output/late_progress.hpp"
#include "phasetree/io/kept_nodes.hpp"
#include "render/threads.hpp"
#include "scene/named_files.hpp"
#include "view/numbers.hpp"

namespace phasetree::tracer {

namespace {

struct SolveCommand {
    std::string number, quantity;
    std::optional<std::string> object, output;
    double tolerance = 0;
    double seconds = 120;
    std::optional<std::string> unit;
    std::vector<std::string> densities;
    bool as_json = false;
};

// The scene with another number.
class EditedScene {
  public:
    EditedScene(const SceneFile& file, Document document, std::string pointer, std::optional<std::string> object)
        : file_(file), document_(std::move(document)), pointer_(std::move(pointer)), object_(std::move(object)) {}

    std::string text(double number) const { return view::with_numbers(document_, {{pointer_, number}}); }
    // Throws UsageError if the number makes the scene invalid.
    Phased object(double number) {
        kept_->start();
        Document edited = Document::from_text(text(number), document_.name()).at(document_.seconds());
        if (file_.assets_within) edited = edited.with_files_within(*file_.assets_within);
        edited = edited.with_kept_nodes(kept_);
        try {
            const Phased found = read_model(edited, object_).object;
            (void)record_tree(edited, found);  // throws a precise error if the object is too large
            kept_->finish();
            return found;
        } catch (const SceneError& e) {
            throw UsageError(fmt::format("--set: the scene is invalid with {} at {}: {}; choose another bracket",
                                         number, pointer_, e.message()));
        }
    }

  private:
    const SceneFile& file_;
    Document document_;
    std::string pointer_;
    std::optional<std::string> object_;
    std::shared_ptr<KeptNodes> kept_ = std::make_shared<KeptNodes>();
};

// A scene written to another folder would no longer find the files that it names relative to its own. Throws
// UsageError.
void check_same_folder(const Document& document, Value value, const std::filesystem::path& output) {
    if (value.is_string())
        for (const std::filesystem::path& named : named_files(document, value)) {
            const std::filesystem::path as_written = std::string(value.string());
            std::error_code problem;
            const std::filesystem::path there =
                as_written.is_absolute() ? named : output.parent_path() / as_written.parent_path() / named.filename();
            if (!std::filesystem::equivalent(named, there, problem))
                throw UsageError(fmt::format(
                    "--output {}: the scene names \"{}\", relative to its own folder; write the new scene there",
                    output.string(), value.string()));
        }
    for (const Value child : value) check_same_folder(document, child, output);
}

// Densities are read once: the mass is proportional to them. Throws UsageError.
void check_is_no_density(const std::string& pointer) {
    const std::string_view phases = "/phases/", density = "/density";
    if (!pointer.starts_with(phases) || !pointer.ends_with(density)) return;
    const std::string_view name = std::string_view(pointer).substr(phases.size());
    if (name.size() < density.size() || name.find('/') != name.size() - density.size()) return;
    throw UsageError(
        fmt::format("--set: {} is a density and changes no shape; to get it, divide the mass by the volume that "
                    "\"phasetree measure\" prints",
                    pointer));
}

// The scene at the time for which to solve: --at; otherwise the time of the keyframe whose value is to be found. Throws
// UsageError.
Document at_time_of(const NumberToSet& number, const SceneFile& file, const Document& document) {
    if (number.is_time_of_key && !file.at)
        throw UsageError(
            fmt::format("--set: \"{}\" is the time of a keyframe; choose with --at SECONDS when the object is measured",
                        number.pointer));
    return number.key_seconds && !file.at ? document.at(*number.key_seconds) : document;
}

[[noreturn]] void throw_same_side(const NumberToSet& number, const Quantity& q, const SolveResult& r) {
    const bool is_below = r.low->measure.high < q.target.value;
    throw UsageError(fmt::format(
        "--set: no bracket: {} is {} with {} at {}, and {} with {}; both are {} than {:.9g} {}. Give a bracket with "
        "the "
        "target in between, as in {}=LOW:HIGH",
        q.name, interval_text(r.low->measure, q), r.low->at, number.pointer, interval_text(r.high->measure, q),
        r.high->at, is_below ? "less" : "more", q.shown(q.target.value), q.unit_name, number.pointer));
}

[[noreturn]] void throw_undecided_end(const NumberToSet& number, const Quantity& q, const SolvePoint& end) {
    throw UsageError(fmt::format(
        "--set: no bracket: with {} at {}, {} is {}, which does not show on which side of {:.9g} {} it is. Move this "
        "end "
        "of the bracket farther away",
        end.at, number.pointer, q.name, interval_text(end.measure, q), q.shown(q.target.value), q.unit_name));
}

SolveOptions options_of(const SolveCommand& chosen, LateProgress& progress) {
    SolveOptions options;
    options.width = chosen.tolerance;
    options.seconds = chosen.seconds;
    options.cancelled = [] { return interrupted(); };
    options.progress = [&](const SolveProgress& p) { progress.tell(p.share); };
    return options;
}

struct WhatToSolve {
    Document document;
    Quantity quantity;
    NumberToSet number;
};

WhatToSolve read_what_to_solve(const SceneFile& file, const SolveCommand& chosen) {
    const EndingAtOnce at_once = ending_before_results();
    const Document as_read = read_document(file);
    if (chosen.output) {
        check_overwrites(file, as_read, named_files_of("--output", std::span(&*chosen.output, 1)));
        check_same_folder(as_read, as_read.root(), *chosen.output);
    }
    SceneModel model = read_scene_model(as_read);
    SceneTree tree = tree_of_model(as_read, model, chosen.object);
    (void)record_tree(as_read, tree.object);  // throws a precise error if the object is too large
    const NumberToSet number = number_to_set(chosen.number, as_read);
    check_is_no_density(number.pointer);
    const Document document = at_time_of(number, file, as_read);
    if (document.seconds() != as_read.seconds()) {
        model = read_scene_model(document);
        tree = tree_of_model(document, model, chosen.object);
        (void)record_tree(document, tree.object);
    }
    const Quantity quantity = quantity_of(chosen.quantity, tree, length_unit(chosen.unit, model),
                                          densities_of(chosen.densities, tree, model));
    return {document, quantity, number};
}

int solve_scene(const SceneFile& file, const SolveCommand& chosen) {
    const AvailableThreads threads;
    if (chosen.output) check_file_writable(*chosen.output);
    const InterruptGuard guard;
    const WhatToSolve given = read_what_to_solve(file, chosen);
    const Document& document = given.document;
    const NumberToSet& number = given.number;
    const Quantity& quantity = given.quantity;
    EditedScene scene(file, document, number.pointer, chosen.object);
    LateProgress progress(ProgressOutput::standard_error(false), "solving");
    const SolveResult result = made_of_tree(document, [&] {
        return solve([&](double x) { return scene.object(x); }, quantity.target, number.low, number.high,
                     options_of(chosen, progress));
    });
    progress.tell(1);
    if (result.end == SolveEnd::same_side) throw_same_side(number, quantity, result);
    if (result.end == SolveEnd::undecided && !result.best) throw_undecided_end(number, quantity, *result.undecided);
    const bool is_animated = number.key_seconds || file.at;
    const SolveReport report{file.shown(), number.pointer, quantity, result,
                             is_animated ? std::optional(document.seconds()) : std::nullopt};
    if (chosen.as_json)
        print_solution_json(report);
    else
        print_solution(report);
    if (interrupted()) {
        say("phasetree: interrupted; printed what was known by then{}\n",
            chosen.output ? ", and no file was written" : "");
        return code_of_interruption(false);
    }
    if (chosen.output && result.best) write_file(scene.text(result.best->at), *chosen.output);
    if (chosen.output && !result.best) {
        say("phasetree: error: no value is known yet, so no file was written; allow more with --time\n");
        return exit_code::failure;
    }
    return exit_code::success;
}

void add_solve_options(CLI::App& command, SolveCommand& options) {
    command
        .add_option("--set", options.number,
                    "The number to find: its path in the scene file, and the bracket in which to look (default: from "
                    "half to twice the number in the file)")
        ->required()
        ->option_text("PATH[=LOW:HIGH]");
    command
        .add_option("--until", options.quantity,
                    "The target: volume(PHASE) or mass(PHASE), where the phase may be \"total\", and "
                    "its value")
        ->required()
        ->option_text("'volume(PHASE) = VALUE [UNIT]'");
    command
        .add_option("--tolerance", options.tolerance,
                    "Stop when the bracket is at most this wide (default: a thousandth of the first bracket)")
        ->check(number_in(1e-12, 1e12))
        ->option_text("WIDTH");
    add_duration(command, "--time", options.seconds,
                 "Time limit, after which the results so far are printed (default: 120s)");
    add_length_unit(command, options.unit);
    add_densities(command, options.densities);
    command
        .add_option("-o,--output", options.output,
                    "Write the scene with the value found; everything else in the text stays as it is")
        ->option_text("SCENE");
    command.add_flag("--json", options.as_json, "Print JSON");
}

}  // namespace

void add_solve(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("solve", "Find the number for which a phase has a given volume or mass");
    command->footer(
        "PATH is the number's place in the scene file, as a JSON pointer, such as\n"
        "/shapes/level/plane/offset; items of lists count from 0. Units of volume are mm3, ml, cm3, cl,\n"
        "dl, l and m3, units of mass mg, g, kg and t. Without a unit, a volume is in cubed units of\n"
        "length, and a mass in kilograms. If the number is the value of a keyframe, the object is measured at\n"
        "the time of this keyframe, unless --at chooses another.\n"
        "\n"
        "The bracket is halved repeatedly. An end moves only if the guaranteed interval of the volume lies\n"
        "entirely on one side of the target. So the volume is proven to be below the target\n"
        "at one end of the final bracket, and above it at the other. One solution is in between; there may be\n"
        "others. The value printed lies in the bracket. Ctrl-C prints the bracket so far.\n"
        "\n"
        "The whole scene file is checked, but it may lack a camera and lights, and the files of\n"
        "lights, meshes, textures and media are not opened.");
    const auto file = add_scene_file(*command);
    auto options = std::make_shared<SolveCommand>();
    add_object(*command, options->object);
    add_solve_options(*command, *options);
    command->callback([=, &run] { run = [=] { return solve_scene(*file, *options); }; });
}

}  // namespace phasetree::tracer
