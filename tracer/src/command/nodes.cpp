#include "command/commands.hpp"
#include "command/errors.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>

#include "command/numbers.hpp"
#include "command/streams.hpp"
#include "output/file.hpp"
#include "phasetree/io/meant_kind.hpp"
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

// Members of a scene file whose kinds are in a chapter with another name.
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> chapters_of_members{
    {{"camera", "cameras"}, {"phases", "materials"}, {"tree", "objects"}}};

// The parts of the reference with these names: chapters, members of a scene file, or kinds in any chapter.
std::vector<Chapter> chapters_about(std::vector<std::string> names) {
    for (std::string& name : names)
        for (const auto& [member, chapter] : chapters_of_members)
            if (name == member) name = chapter;
    std::vector<Chapter> result;
    std::set<std::string> known, found;
    for (Chapter& chapter : scene_chapters()) {
        const std::string stem = file_stem(chapter);
        known.insert(stem);
        for (const KindPage& page : chapter.pages) known.insert(page.name);
        if (std::ranges::find(names, stem) != names.end()) {
            found.insert(stem);
        } else {
            chapter.text.clear();
            std::erase_if(chapter.pages,
                          [&](const KindPage& page) { return std::ranges::find(names, page.name) == names.end(); });
        }
        for (const KindPage& page : chapter.pages) found.insert(page.name);
        if (!chapter.pages.empty()) result.push_back(std::move(chapter));
    }
    for (const std::string& name : names) {
        if (found.contains(name)) continue;
        const auto meant = meant_kind(name, known);
        throw UsageError(
            fmt::format("nodes: the reference has no entry \"{}\" ({})", name,
                        meant ? fmt::format("did you mean \"{}\"?", *meant) : "\"phasetree nodes\" prints all of it"));
    }
    return result;
}

}  // namespace

void add_nodes(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("nodes", "Print the reference of the scene format, or parts of it");
    auto names = std::make_shared<std::vector<std::string>>();
    auto folder = std::make_shared<std::string>();
    auto schema = std::make_shared<bool>(false);
    CLI::Option* parts = command->add_option(
        "NAME", *names, "Print only these nodes, materials, lights, …, or chapters, such as sphere or lights");
    auto* first = command->add_option("--markdown", *folder,
                                      "Write the pages of the scene reference to this folder, which must contain the "
                                      "examples, as scenes/reference does");
    first->type_name("FOLDER")->excludes(parts);
    command->add_flag("--json-schema", *schema, "Print a JSON Schema for editors, scenes/scene.schema.json")
        ->excludes(first)
        ->excludes(parts);
    command->callback([names, folder, schema, &run] {
        run = [names, folder, schema] {
            if (!names->empty())
                put(reference_text(chapters_about(*names)));
            else if (folder->empty())
                put(*schema ? scene_json_schema() : scene_reference_text());
            else
                for (const ReferencePage& page : pages_from(*folder))
                    write_file(page.text, std::filesystem::path(*folder) / page.file);
            return 0;
        };
    });
}

}  // namespace phasetree::tracer
