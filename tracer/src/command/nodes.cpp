#include "command/commands.hpp"

#include <CLI/CLI.hpp>
#include "command/streams.hpp"
#include "phasetree/io/reference.hpp"

namespace phasetree::tracer {

void add_nodes(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("nodes", "Print every node with its parameters, equation and section");
    auto markdown = std::make_shared<bool>(false), schema = std::make_shared<bool>(false);
    auto* first = command->add_flag("--markdown", *markdown, "As the page scenes/nodes.md");
    command->add_flag("--json-schema", *schema, "The JSON Schema of scene files, scenes/scene.schema.json")
        ->excludes(first);
    command->callback([markdown, schema, &run] {
        run = [markdown, schema] {
            const std::string text = *schema     ? scene_json_schema()
                                     : *markdown ? node_reference_markdown()
                                                 : node_reference_text();
            put(text);
            return 0;
        };
    });
}

}  // namespace phasetree::tracer
