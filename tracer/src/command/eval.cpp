#include <CLI/CLI.hpp>
#include <iostream>

#include "command/commands.hpp"
#include "command/copies_at.hpp"
#include "command/load.hpp"
#include "command/numbers.hpp"
#include "command/streams.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/math/float_mode.hpp"

namespace phasetree::tracer {

namespace {

constexpr NumberTable::Column columns[] = {{"x"}, {"y"}, {"z"}};

// Columns of phases that the object never has are left empty.
int eval(const SceneFile& file, const std::optional<std::string>& object) {
    const Document document = read_document_beside_input(file);
    const SceneModel model = read_scene_model(document);
    const SceneTree tree = tree_of_model(document, model, object);
    std::optional<CopiesAt> copies;
    if (!object && !model.placed.empty()) copies.emplace(model.placed);
    const Evaluator evaluator(record_tree(document, tree.object));
    Evaluator::Workspace workspace;
    const FlushSubnormals flush;
    std::string header = copies ? "x,y,z,phase,object,copy" : "x,y,z,phase";
    for (const std::string& name : tree.phases.names) header += "," + csv_cell("phi." + name);
    put("{}\n", header);
    for_each_row(std::cin, columns, [&](const std::array<float, 6>& v, const NumberTable&) {
        const Phases<float> phi = evaluator.distances({v[0], v[1], v[2]}, workspace);
        std::string line = fmt::format("{},{},{},{}", unsigned_zero(v[0]), unsigned_zero(v[1]), unsigned_zero(v[2]),
                                       csv_cell(tree.phases[label(phi)]));
        if (copies) line += copies->columns({v[0], v[1], v[2]});
        for (std::size_t i = 0; i < tree.phases.names.size(); ++i)
            line += phi.has(static_cast<int>(i)) ? fmt::format(",{}", unsigned_zero(phi[static_cast<int>(i)])) : ",";
        put("{}\n", line);
    });
    return 0;
}

}  // namespace

void add_eval(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("eval", "Print the phase and the distances at points, as CSV");
    command->footer(
        "Reads one point per line, \"x y z\", from standard input, separated by blanks or commas; #\n"
        "begins a comment. Also reads CSV with a header that names the columns x, y and z, such as\n"
        "the output of this command.\n"
        "\n"
        "Writes one line per point, x,y,z,phase,phi.vacuum,phi.NAME…, to standard output. phi is the\n"
        "signed distance to a phase, negative inside it. It is empty for phases that the object never\n"
        "has. With several objects, the columns object,copy follow phase: the name of the object that\n"
        "contains the point, and the number of its copy.\n"
        "\n"
        "The whole scene file is checked, but it may lack a camera and lights, and the files of\n"
        "lights, meshes, textures and media are not opened.");
    const auto file = add_scene_file(*command);
    auto object = std::make_shared<std::optional<std::string>>();
    add_object(*command, *object);
    command->callback([=, &run] { run = [=] { return eval(*file, *object); }; });
}

}  // namespace phasetree::tracer
