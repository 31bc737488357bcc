#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>

#include "command/commands.hpp"
#include "command/errors.hpp"
#include "command/exit_codes.hpp"
#include "command/overwritten_files.hpp"
#include "command/reading.hpp"
#include "command/streams.hpp"
#include "gltf_import/import_gltf.hpp"
#include "output/error.hpp"
#include "output/file.hpp"
#include "output/interrupt.hpp"
#include "phasetree/io/kind.hpp"
#include "scene/gltf_files.hpp"

namespace phasetree::tracer {

namespace {

using std::filesystem::path;

struct ImportOptions {
    std::string input, output;
    bool force = false;
    gltf_import::ImportChoices choices{};
};

// A folder that is removed again if it was created and is still empty.
class CreatedFolder {
  public:
    explicit CreatedFolder(const path& folder) : folder_(folder) {
        std::error_code problem;
        is_new_ = std::filesystem::create_directory(folder, problem);
        if (problem) throw OutputError(fmt::format("cannot create {}: {}", folder.string(), problem.message()));
    }
    ~CreatedFolder() {
        std::error_code ignored;
        if (is_new_) std::filesystem::remove(folder_, ignored);
    }
    CreatedFolder(const CreatedFolder&) = delete;
    CreatedFolder& operator=(const CreatedFolder&) = delete;

  private:
    path folder_;
    bool is_new_ = false;
};

path beside(const path& scene, const std::string& file) {
    return scene.parent_path() / file;
}

std::vector<NamedFile> outputs_of(const ImportOptions& options, const gltf_import::ImportedScene& scene) {
    std::vector<NamedFile> outputs{{"--output", options.output}};
    for (const gltf_import::ImportedMesh& mesh : scene.meshes)
        outputs.push_back({"--output", beside(options.output, mesh.file)});
    return outputs;
}

// Throws UsageError if a file exists that must not be replaced.
void check_written_files(const ImportOptions& options, const std::vector<NamedFile>& outputs) {
    std::vector<NamedFile> inputs{{"the glTF file", options.input}};
    for (const path& file : files_of_gltf(options.input)) inputs.push_back({"the glTF file's", file});
    check_overwrites(inputs, outputs);
    std::error_code ignored;
    for (const NamedFile& output : outputs)
        if (!options.force && std::filesystem::exists(output.path, ignored))
            throw UsageError(fmt::format("{} exists; choose another name with --output, or replace it with --force",
                                         output.path.string()));
}

// Returns false if a signal arrived. Existing files are then unchanged, and no new file is left.
bool write(const ImportOptions& options, const gltf_import::ImportedScene& scene) {
    std::optional<CreatedFolder> folder;  // outlives the files in it
    if (!scene.meshes.empty()) folder.emplace(beside(options.output, scene.meshes.front().file).parent_path());
    FilesTogether files;
    for (const gltf_import::ImportedMesh& mesh : scene.meshes) {
        if (interrupted()) return false;
        files.add(mesh.bytes, beside(options.output, mesh.file));
    }
    // The scene is renamed last, so that everything it needs exists when it appears.
    files.add(scene.text, options.output);
    if (interrupted()) return false;
    files.finish();
    return true;
}

// A scene names its meshes and its glTF file relative to its own folder. If the output is a symbolic link into another
// folder, they would be found relative to the link or relative to its target, but not both.
void check_is_in_its_folder(const std::string& scene) {
    std::error_code problem;
    if (!std::filesystem::is_symlink(std::filesystem::symlink_status(scene, problem))) return;
    path target = path(scene).parent_path() / std::filesystem::read_symlink(scene, problem);
    const path folder = path(scene).has_parent_path() ? path(scene).parent_path() : ".";
    if (problem || std::filesystem::is_symlink(std::filesystem::symlink_status(target, problem)) ||
        !std::filesystem::equivalent(folder, target.has_parent_path() ? target.parent_path() : ".", problem))
        throw UsageError(fmt::format(
            "--output: {} is a symbolic link to another folder, where the scene would not find its files; give the "
            "path of the scene itself, {}",
            scene, target.lexically_normal().string()));
}

gltf_import::ImportedScene imported(const ImportOptions& options) {
    try {
        return gltf_import::import_gltf(options.input, options.output, options.choices);
    } catch (const ParameterError& e) {
        throw UsageError(e.what());
    }
}

int import_file(const ImportOptions& options) {
    if (path(options.output).extension() != ".json")
        throw OutputNameError(
            fmt::format("cannot write \"{}\": the name of a scene file must end in .json", options.output));
    if (!is_gltf(options.input))
        throw UsageError(
            fmt::format("cannot import \"{}\": the name of the file must end in .glb or .gltf; export the "
                        "scene as glTF",
                        options.input));
    check_is_in_its_folder(options.output);
    const InterruptGuard guard;
    gltf_import::ImportedScene scene;
    {
        const EndingAtOnce reading = ending_at_once("importing", false);
        check_written_files(options, {{"--output", options.output}});
        check_file_writable(options.output);
        scene = imported(options);
        check_written_files(options, outputs_of(options, scene));
    }
    for (const std::string& warning : scene.warnings) say("warning: {}: {}\n", options.input, warning);
    if (!write(options, scene)) {
        say("phasetree: interrupted; no file was written\n");
        return code_of_interruption(false);
    }
    put(scene.report);
    return exit_code::success;
}

}  // namespace

void add_import(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("import", "Convert a glTF file to a scene, with clear objects as phases");
    command->footer(
        "Clear objects (KHR_materials_transmission and KHR_materials_volume) become phases of one tree;\n"
        "their triangles are written to a folder next to the scene: cup.json has cup.meshes. The rest of\n"
        "the file stays in it and is used as a mesh. The first perspective camera and the lights are\n"
        "copied to the scene. y up becomes z up; the unit is the metre.\n"
        "\n"
        "Where clear objects overlap, one of them keeps the space. The first rule that applies decides:\n"
        "(1) the higher phasetree_priority in the extras of the node or material (default: 0); (2) the\n"
        "object inside the other; (3) solids over gases over liquids; (4) the object earlier in the file.\n"
        "What is a liquid follows from phasetree_matter in the extras (\"solid\", \"liquid\", \"gas\"), or\n"
        "else from names (\"ice\", \"Orange juice\") and indices. Thin gaps along surfaces are closed.\n"
        "The order, overlaps and gaps are printed. Warnings name materials and extensions that are not\n"
        "fully preserved.");
    auto options = std::make_shared<ImportOptions>();
    command->add_option("file", options->input, "glTF file, .glb or .gltf")->required();
    command->add_option("-o,--output", options->output, "Scene file, .json")->required()->option_text("FILE");
    command->add_flag("--force", options->force, "Replace existing files");
    command->add_flag("--solid", options->choices.include_panes,
                      "Turn closed objects whose clear material lacks KHR_materials_volume into phases, too; by "
                      "default, they become panes of thin_glass");
    command->add_flag("!--keep-gaps", options->choices.closes_gaps,
                      "Keep thin gaps beside liquids; by default, the node close_gaps fills those that cover at least "
                      "a tenth of either surface");
    command->callback([=, &run] { run = [=] { return import_file(*options); }; });
}

}  // namespace phasetree::tracer
