#include <fmt/format.h>

#include <cstdio>
#include <iostream>

#include "command/commands.hpp"
#include "command/load.hpp"
#include "command/numbers.hpp"
#include "phasetree/math/float_mode.hpp"
#include "phasetree/program/evaluator.hpp"
#include "phasetree/reading/tree.hpp"

namespace phasetree::tracer {

namespace {

// Phases that the object never has are left empty.
int eval(const std::string& file) {
    const Document document = Document::from_file(file);
    const SceneTree tree = read_tree(document);
    const Evaluator evaluator(record_tree(document, tree.object));
    Evaluator::Workspace workspace;
    const FlushSubnormals flush;
    std::string header = "x,y,z,phase";
    for (const std::string& name : tree.phases.names) header += ",phi." + name;
    fmt::print("{}\n", header);
    for_each_line_of_numbers(std::cin, 3, [&](const std::array<float, 6>& v, std::size_t) {
        const Phases<float> phi = evaluator.distances({v[0], v[1], v[2]}, workspace);
        std::string line = fmt::format("{},{},{},{}", v[0], v[1], v[2], tree.phases[label(phi)]);
        for (std::size_t i = 0; i < tree.phases.names.size(); ++i)
            line += phi.has(static_cast<int>(i)) ? fmt::format(",{}", phi[static_cast<int>(i)]) : ",";
        fmt::print("{}\n", line);
    });
    return 0;
}

}  // namespace

void add_eval(CLI::App& app, Run& run) {
    CLI::App* command =
        app.add_subcommand("eval", "Read points \"x y z\" and write the phase and all distances there as CSV");
    auto file = std::make_shared<std::string>();
    command->add_option("scene", *file, "The scene file")->required();
    command->callback([file, &run] { run = [file] { return eval(*file); }; });
}

}  // namespace phasetree::tracer
