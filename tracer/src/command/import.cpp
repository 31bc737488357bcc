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

// Removes the files and the folder that it was given, unless they are kept.
class CreatedFiles {
  public:
    CreatedFiles() = default;
    CreatedFiles(const CreatedFiles&) = delete;
    CreatedFiles& operator=(const CreatedFiles&) = delete;
    ~CreatedFiles() {
        std::error_code ignored;
        for (const path& file : paths_) std::filesystem::remove(file, ignored);
    }
    // Later ones are removed first; a folder only if it is empty then.
    void add(const path& file) { paths_.insert(paths_.begin(), file); }
    void keep() { paths_.clear(); }

  private:
    std::vector<path> paths_;
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
void check_outputs(const ImportOptions& options, const std::vector<NamedFile>& outputs) {
    std::vector<NamedFile> inputs{{"the glTF file", options.input}};
    for (const path& file : files_of_gltf(options.input)) inputs.push_back({"the glTF file's", file});
    check_overwrites(inputs, outputs);
    std::error_code ignored;
    for (const NamedFile& output : outputs)
        if (!options.force && std::filesystem::exists(output.path, ignored))
            throw UsageError(fmt::format("{} exists; choose another name with --output, or replace it with --force",
                                         output.path.string()));
}

// False if a signal arrived; then nothing that was written is left.
bool write(const ImportOptions& options, const gltf_import::ImportedScene& scene) {
    CreatedFiles created;
    const auto write_new = [&](const std::string& bytes, const path& file) {
        std::error_code ignored;
        const bool is_new = !std::filesystem::exists(file, ignored);
        write_file(bytes, file);
        if (is_new) created.add(file);
    };
    if (!scene.meshes.empty()) {
        const path folder = beside(options.output, scene.meshes.front().file).parent_path();
        std::error_code problem;
        if (std::filesystem::create_directory(folder, problem)) created.add(folder);
        if (problem) throw OutputError(fmt::format("cannot create {}: {}", folder.string(), problem.message()));
    }
    for (const gltf_import::ImportedMesh& mesh : scene.meshes) {
        if (interrupted()) return false;
        write_new(mesh.bytes, beside(options.output, mesh.file));
    }
    if (interrupted()) return false;
    // The scene is written last, so that everything it needs exists when it appears.
    write_new(scene.text, options.output);
    created.keep();
    return true;
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
    const InterruptGuard guard;
    gltf_import::ImportedScene scene;
    {
        const EndingAtOnce reading = ending_at_once("importing", false);
        check_outputs(options, {{"--output", options.output}});
        check_file_writable(options.output);
        scene = imported(options);
        check_outputs(options, outputs_of(options, scene));
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
    CLI::App* command = app.add_subcommand("import", "Make a scene of a glTF file, with clear objects as phases");
    command->footer(
        "Clear objects (KHR_materials_transmission and KHR_materials_volume) become phases of one tree;\n"
        "their triangles are written to a folder beside the scene: cup.json has cup.meshes. The rest of\n"
        "the file stays in it and is used as a mesh. The first perspective camera and the lights are\n"
        "copied to the scene. y up becomes z up; the unit is the metre.\n"
        "\n"
        "Where clear objects overlap, one of them keeps the space: the one with the higher number\n"
        "phasetree_priority in the extras of its node or material (default: 0); else the one within the\n"
        "other; else a solid rather than a gas, and a gas rather than a liquid; else the earlier in the\n"
        "file. Names (\"ice\", \"Orange juice\") and indices say what is a liquid. Thin gaps along surfaces\n"
        "are closed. The order, overlaps and gaps are printed; warnings name materials and extensions of which "
        "something is lost.");
    auto options = std::make_shared<ImportOptions>();
    command->add_option("file", options->input, "glTF file, .glb or .gltf")->required();
    command->add_option("-o,--output", options->output, "Scene file, .json")->required()->option_text("FILE");
    command->add_flag("--force", options->force, "Replace existing files");
    command->add_flag(
        "--solid", options->choices.panes_too,
        "Make closed objects of clear materials without volume phases, too; otherwise they are thin panes "
        "and left out");
    command->add_flag(
        "!--keep-gaps", options->choices.closes_gaps,
        "Keep thin gaps beside liquids; otherwise the node close_gaps fills those that cover a tenth of a "
        "surface");
    command->callback([=, &run] { run = [=] { return import_file(*options); }; });
}

}  // namespace phasetree::tracer
