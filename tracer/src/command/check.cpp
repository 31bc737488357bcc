#include "command/commands.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "command/empty_object.hpp"
#include "command/exit_codes.hpp"
#include "command/load.hpp"
#include "command/not_shown_report.hpp"
#include "command/overlap_report.hpp"
#include "command/prove.hpp"
#include "command/streams.hpp"
#include "command/unplaced_report.hpp"
#include "command/unused_names.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/trace/tracer.hpp"
#include "render/threads.hpp"
#include "scene/meshes_alone.hpp"

namespace phasetree::tracer {

namespace {

// The phases of a single object, or of all placed objects.
PhaseSet phases_of(const Phased& object, const PlacedObjects& placed) {
    if (placed.empty()) return phases(object);
    PhaseSet all{};
    for (const PlacedObject& o : placed.objects) all = all | phases(o.tree);
    return all;
}

// Checks a scene without a camera, and reports what it can be used for.
int check_without_camera(const Document& document, const std::string& shown) {
    const SceneModel model = read_scene_without_camera(document);
    warn_of_unused_names(document, model.phases, phases_of(model.object, model.placed));
    if (has_meshes_alone(document)) {
        put("{}: the meshes are valid and can be used by info; without a \"camera\" the scene cannot be rendered\n",
            shown);
        return exit_code::tree_only;
    }
    if (!model.placed.empty()) {
        warn_of_unplaced_groups(document, model.placed);
        warn_of_overlaps(document, model.placed);
        put("{}: the objects are valid and can be used by eval, info and trace; without a \"camera\" the scene cannot "
            "be rendered\n",
            shown);
        return exit_code::tree_only;
    }
    const SceneTree tree{model.phases, model.object};
    const Evaluator evaluator(record_tree(document, tree.object));
    std::string uses = "eval, info, trace, measure, solve, slice, export and other programs";
    const Bounds b = bounds(tree.object);
    if (!b.empty() && b.finite()) {
        print_warning(shown, made_of_tree(document, [&] { return prepare_to_trace(tree.object); }).warning);
    } else if (!b.empty()) {
        const SceneError e = unbounded_error(document);
        uses = fmt::format("eval and info, but not traced, because the node in line {}, column {} makes it unbounded",
                           e.line(), e.column());
    }
    if (is_empty(tree.object, evaluator)) say("{}\n", empty_object_warning(document));
    put("{}: the tree is valid and can be used by {}; without a \"camera\" the scene cannot be rendered\n", shown,
        uses);
    return exit_code::tree_only;
}

int check(const SceneFile& file) {
    const AvailableThreads threads;
    const Document document = read_document(file);
    if (document.root().is_object() && !document.root().find("camera"))
        return check_without_camera(document, file.shown());
    const Scene scene = load_scene(document);
    // Views are defined by the OpenColorIO configuration, so a broken $OCIO is an error for a scene that names a view.
    if (scene.settings.view) (void)display_of(document, scene.settings, {}, {}, {});
    warn_of_unused_names(document, scene.phases, phases_of(scene.object, scene.placed));
    warn_of_what_is_not_shown(scene);
    if (has_meshes_alone(scene)) return 0;
    if (!scene.placed.empty()) {
        warn_of_unplaced_groups(document, scene.placed);
        warn_of_overlaps(document, scene.placed);
        return 0;
    }
    if (is_empty(scene.object, Evaluator(record_tree(document, scene.object))))
        say("{}\n", empty_object_warning(document));
    print_warning(file.shown(), prepare_to_trace(scene.object).warning);
    return 0;
}

}  // namespace

void add_check(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("check", "Validate a scene file");
    command->footer(
        "If the scene is valid, check exits with 0 and prints nothing but warnings. Otherwise it\n"
        "prints the error and exits with 2. Parts that render ignores must be valid, too. For a\n"
        "valid scene without a camera, check prints what it can be used for and exits with 3.\n"
        "\n"
        "With --prove, it prints one of these for each statement in \"expect\": proved; refuted, with\n"
        "points that show it; or undecided, at the given resolution or within the given time. Without\n"
        "\"expect\", it prints for each phase whether it is present and whether it is connected. With\n"
        "several objects, their union is examined. The scene may lack a camera and lights. Ctrl-C prints\n"
        "what is known so far.");
    const auto file = add_scene_file(*command);
    auto prove = std::make_shared<ProveCommand>();
    add_prove_options(*command, *prove);
    command->callback(
        [=, &run] { run = [=] { return prove->is_wanted ? prove_scene(*file, *prove) : check(*file); }; });
}

}  // namespace phasetree::tracer
