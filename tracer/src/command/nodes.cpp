#include "command/commands.hpp"

#include <CLI/CLI.hpp>
#include "command/streams.hpp"
#include "scene/reference.hpp"

namespace phasetree::tracer {

void add_nodes(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("nodes", "Print the reference of the scene format");
    auto markdown = std::make_shared<bool>(false), schema = std::make_shared<bool>(false);
    auto* first = command->add_flag("--markdown", *markdown, "Print it as Markdown, the page scenes/nodes.md");
    command->add_flag("--json-schema", *schema, "Print a JSON Schema for editors, scenes/scene.schema.json")
        ->excludes(first);
    command->callback([markdown, schema, &run] {
        run = [markdown, schema] {
            const std::string text = *schema     ? scene_json_schema()
                                     : *markdown ? scene_reference_markdown()
                                                 : scene_reference_text();
            put(text);
            return 0;
        };
    });
}

}  // namespace phasetree::tracer
