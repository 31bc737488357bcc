#include "command/commands.hpp"
#include "command/errors.hpp"

#include <CLI/CLI.hpp>
#include "command/numbers.hpp"
#include "command/streams.hpp"
#include "output/file.hpp"
#include "scene/reference.hpp"

namespace phasetree::tracer {

namespace {

std::vector<ReferencePage> pages_from(const std::filesystem::path& folder) {
    try {
        return scene_reference_pages(folder);
    } catch (const std::runtime_error& e) {
        throw InputError(fmt::format("--markdown: {}", e.what()));
    }
}

}  // namespace

void add_nodes(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("nodes", "Print the reference of the scene format");
    auto folder = std::make_shared<std::string>();
    auto schema = std::make_shared<bool>(false);
    auto* first = command->add_option("--markdown", *folder,
                                      "Write the pages of scenes/reference to this folder, from the examples in it");
    first->type_name("FOLDER");
    command->add_flag("--json-schema", *schema, "Print a JSON Schema for editors, scenes/scene.schema.json")
        ->excludes(first);
    command->callback([folder, schema, &run] {
        run = [folder, schema] {
            if (folder->empty())
                put(*schema ? scene_json_schema() : scene_reference_text());
            else
                for (const ReferencePage& page : pages_from(*folder))
                    write_file(page.text, std::filesystem::path(*folder) / page.file);
            return 0;
        };
    });
}

}  // namespace phasetree::tracer
