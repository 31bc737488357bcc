#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "command/build_quality.hpp"
#include "command/carve_report.hpp"
#include "command/cells_report.hpp"
#include "command/commands.hpp"
#include "command/empty_object.hpp"
#include "command/errors.hpp"
#include "command/load.hpp"
#include "command/max_memory.hpp"
#include "command/meshes_report.hpp"
#include "command/numbers.hpp"
#include "command/objects_report.hpp"
#include "command/streams.hpp"
#include "output/late_progress.hpp"
#include "output/utf8_name.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/trace/tracer.hpp"
#include "render/threads.hpp"
#include "scene/meshes_alone.hpp"
#include "scene/read_parts.hpp"

namespace phasetree::tracer {

namespace {

glm::vec3 unsigned_zeroes(const glm::vec3& v) {
    return {unsigned_zero(v.x), unsigned_zero(v.y), unsigned_zero(v.z)};
}

struct InfoOptions {
    bool as_json = false, with_cells = false, with_carving = false;
    std::optional<std::string> object;
    int max_planes = CarveOptions().max_planes;
    CellOptions cells;
};

// Prints the information on a scene of several objects of which none was chosen.
int info_of_objects(const SceneFile& file, const InfoOptions& chosen, const SceneModel& model) {
    if (chosen.with_cells || chosen.with_carving)
        throw UsageError(fmt::format("{} needs a single object; choose one with --object",
                                     chosen.with_cells ? "--cells" : "--carve"));
    if (chosen.as_json) {
        nlohmann::ordered_json json;
        json["scene"] = file.shown();
        json["copies"] = model.placed.copies();
        json["groups"] = model.placed.groups.size();
        json["instances"] = model.placed.instances.size();
        json["objects"] = objects_as_json(model);
        put("{}\n", json.dump(2));
        return 0;
    }
    put("{:<14}{}\n", "scene", file.shown());
    print_objects(model);
    return 0;
}

// Prints the information on a scene without objects.
int info_of_meshes(const SceneFile& file, const InfoOptions& chosen, const Document& document) {
    if (chosen.with_cells || chosen.with_carving || chosen.object)
        throw UsageError(fmt::format("{} needs an object, but the scene has only meshes", chosen.with_cells ? "--cells"
                                                                                          : chosen.with_carving
                                                                                              ? "--carve"
                                                                                              : "--object"));
    (void)read_scene_without_camera(document);
    const MeshGroup group = read_meshes(document, document.root().find("meshes").value());
    if (chosen.as_json) {
        nlohmann::ordered_json json;
        json["scene"] = file.shown();
        json["meshes"] = meshes_as_json(group.meshes);
        put("{}\n", json.dump(2));
        return 0;
    }
    put("{:<14}{}\n", "scene", file.shown());
    print_meshes(group.meshes);
    return 0;
}

int info(const SceneFile& file, const InfoOptions& chosen) {
    if (chosen.as_json) require_utf8(file.shown());
    const AvailableThreads threads;
    const Document document = read_document(file);
    if (has_meshes_alone(document)) return info_of_meshes(file, chosen, document);
    const SceneModel model = read_scene_model(document);
    if (!model.placed.empty() && !chosen.object) return info_of_objects(file, chosen, model);
    const SceneTree tree = tree_of_model(document, model, chosen.object);
    const TreeStatistics s = statistics(tree.object);
    Bounds b = bounds(tree.object);
    b = {unsigned_zeroes(b.low), unsigned_zeroes(b.high)};
    const Evaluator evaluator(record_tree(document, tree.object));
    const Program& program = evaluator.program();
    const PhaseSet there = phases(tree.object);
    if (b.finite() && !b.empty()) {
        try {
            print_warning(file.shown(), prepare_to_trace(tree.object).warning);
        } catch (const ModelError& e) {
            print_warning(file.shown(), e.what());
        }
    }
    std::optional<CellStatistics> cells;
    if (chosen.with_cells) {
        CellOptions options = chosen.cells;
        options.opaque = model.opaque;
        LateProgress progress(ProgressOutput::standard_error(false), "preparing the object");
        options.progress = [&](float done) { progress.tell(done); };
        cells = made_of_tree(document, [&] { return InterfaceCells(tree.object, options).statistics(); });
    }
    const bool nothing_left = is_empty(tree.object, evaluator);
    std::vector<CarvedPart> carved;
    if (chosen.with_carving && !nothing_left)
        carved = made_of_tree(document, [&] { return carve_parts(tree, chosen.max_planes); });

    if (chosen.as_json) {
        nlohmann::ordered_json json;
        json["scene"] = file.shown();
        json["nodes"] = s.nodes;
        json["depth"] = s.depth;
        json["tree_bytes"] = s.bytes;
        auto& list = json["phases"] = nlohmann::ordered_json::array();
        for_each_phase(there.bits & ~std::uint64_t{1},
                       [&](int i) { list.push_back(tree.phases.names[static_cast<std::size_t>(i)]); });
        if (b.finite() && !b.empty())
            json["bounds"] = {{b.low.x, b.low.y, b.low.z}, {b.high.x, b.high.y, b.high.z}};
        else
            json["bounds"] = nullptr;
        json["empty"] = nothing_left;
        json["instructions"] = program.instructions.size();
        json["program_bytes"] = evaluator.bytes();
        json["simd"] = simd_target();
        if (cells) add_cells(json, *cells);
        if (chosen.with_carving) add_carved(json, carved);
        put("{}\n", json.dump(2));
        return 0;
    }
    std::string names;
    for_each_phase(there.bits & ~std::uint64_t{1}, [&](int i) {
        names += (names.empty() ? "" : ", ") + tree.phases.names[static_cast<std::size_t>(i)];
    });
    put("{:<14}{}\n", "scene", file.shown());
    put("{:<14}{} ({} deep)\n", "nodes", s.nodes, s.depth);
    put("{:<14}{} ({})\n", "phases", std::popcount(there.bits & ~std::uint64_t{1}), names);
    put("{:<14}{}\n", "tree bytes", s.bytes);
    if (b.finite() && !b.empty())
        put("{:<14}[{}, {}, {}] to [{}, {}, {}]\n", "bounds", b.low.x, b.low.y, b.low.z, b.high.x, b.high.y, b.high.z);
    else
        put("{:<14}{}\n", "bounds", b.empty() ? "none" : "unbounded");
    if (nothing_left) put("{:<14}{}\n", "empty", "yes, the object is vacuum everywhere");
    put("{:<14}{}\n", "instructions", program.instructions.size());
    put("{:<14}{}\n", "program bytes", evaluator.bytes());
    put("{:<14}{}\n", "SIMD", simd_target());
    if (cells) print_cells(*cells);
    print_carved(carved);
    return 0;
}

}  // namespace

void add_info(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("info", "Print the nodes, phases, bounds and memory of a scene");
    const auto file = add_scene_file(*command);
    auto options = std::make_shared<InfoOptions>();
    command->footer(
        "If the scene has several objects, info lists them; --object chooses one. If it has only\n"
        "meshes, info lists those. The whole scene file is checked, but it may lack a camera and\n"
        "lights, and the files of lights, meshes, textures and media are not opened.");
    add_object(*command, options->object);
    command->add_flag("--json", options->as_json, "Print JSON");
    auto* const with_cells =
        command->add_flag("--cells", options->with_cells,
                          "Also build the cells in which a render traces rays, and print their statistics");
    add_build_quality(*command, options->cells.quality)->needs(with_cells);
    add_max_memory(*command, options->cells.max_bytes)->needs(with_cells);
    auto* const with_carving = command->add_flag(
        "--carve", options->with_carving, "Also carve convex bounds around the object and each phase, and print them");
    command->add_option("--planes", options->max_planes, "Maximum number of planes of each bound (default: 40)")
        ->check(CLI::Range(6, 256))
        ->option_text("N")
        ->needs(with_carving);
    command->callback([=, &run] { run = [=] { return info(*file, *options); }; });
}

}  // namespace phasetree::tracer
