#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "command/commands.hpp"
#include "command/errors.hpp"
#include "command/exit_codes.hpp"
#include "command/export_labels.hpp"
#include "command/export_mesh.hpp"
#include "command/load.hpp"
#include "command/looks.hpp"
#include "command/max_memory.hpp"
#include "command/numbers.hpp"
#include "command/overwritten_files.hpp"
#include "command/streams.hpp"
#include "mesh_file/bytes_as_text.hpp"
#include "output/error.hpp"
#include "output/file.hpp"
#include "output/interrupt.hpp"
#include "page/page.hpp"
#include "phasetree/building/options.hpp"
#include "phasetree/glsl/shader.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/trace/tracer.hpp"
#include "scene/mesh_kinds.hpp"
#include "scene/read_parts.hpp"

namespace phasetree::tracer {

namespace {

// Shaders round more often than the C++ code does. A bracket must be longer than the resulting error.
constexpr float finest_of_diagonal = 1e-5f;

struct ExportOptions {
    std::string output;
    int grid = 0;
    std::optional<std::string> object;
    MeshExport mesh;
};

std::string numbers_as_bytes(const std::vector<float>& numbers) {
    ByteWriter bytes;
    for (const float v : numbers) bytes.number(v);
    return bytes_as_text(bytes);
}

// Maximum size of a page in bytes, so that it loads quickly.
constexpr std::size_t largest_page = 500'000;
// Numbers of boxes along the longest side to try, finest first, and the length of a bracket. They suit a page, in which
// the object is examined closely.
constexpr int page_grids[] = {32, 24, 16, 12, 8, 5};
constexpr float bracket_on_page = 3e-5f;

// The height of the last floor among the scene's meshes. Mesh files are not read.
std::optional<float> floor_height(const Document& document) {
    std::optional<float> height;
    const std::optional<Value> meshes = document.root().find("meshes");
    if (!meshes || !meshes->is_array()) return height;
    for (const Value mesh : *meshes) {
        const std::optional<Value> floor = mesh.is_object() ? mesh.find(FloorParameters::info.name) : std::nullopt;
        if (!floor || !floor->is_object()) continue;
        const std::optional<Value> given = floor->find("height");
        height = given ? as<float>(document, *given, "\"height\"") : FloorParameters().height;
    }
    return height;
}

int export_page(const SceneFile& file, const ExportOptions& chosen) {
    const std::filesystem::path path = chosen.output;
    check_file_writable(path);
    const Document document = read_document(file);
    check_overwrites(file, document, named_files_of("--output", std::span(&chosen.output, 1)));
    const SceneTree tree = read_model(document, chosen.object);
    const std::vector<std::optional<Material>> materials = read_materials(document);
    const TraceableObject traceable = made_of_tree(document, [&] { return prepare_to_trace(tree.object); });
    print_warning(file.shown(), traceable.warning);
    const Bounds& bounds = traceable.bounds;
    const Program program = record_tree(document, tree.object);
    const std::vector<Look> looks = looks_of(tree.phases, materials, bounds);
    PageView view{bounds.centre() + 1.4f * bounds.diagonal() * glm::vec3(0.45f, -0.8f, 0.4f), bounds.centre(), 40};
    float floor = bounds.low.z;
    if (const auto camera = document.root().find("camera")) {
        FilmSettings unused;
        view = view_of(read_camera(document, *camera, unused));
        floor = floor_height(document).value_or(floor);
    }
    GlslOptions options;
    options.phase_names = tree.phases.names;
    options.max_numbers_in_text = 0;
    options.steps = 256;
    options.cancelled = [] { return interrupted(); };
    const float resolution = std::max(traceable.resolution, bracket_on_page * bounds.diagonal());
    const std::string title = file.is_standard_input() ? "phasetree" : std::filesystem::path(file.name).stem().string();
    const InterruptGuard guard;
    try {
        for (const int grid : page_grids) {
            options.grid = grid;
            const GlslShader shader =
                made_of_tree(document, [&] { return make_glsl(program, bounds, resolution, options); });
            const std::string page = make_page(title, shader, bounds, looks, view, floor);
            if (page.size() > largest_page) continue;
            write_file(page, path);
            return exit_code::success;
        }
    } catch (const BuildCancelled&) {
        say("phasetree: interrupted; no file was written\n");
        return code_of_interruption(false);
    }
    throw UsageError(
        fmt::format("cannot write \"{}\": the object is too complex for a page of at most {} kB; export a "
                    "simpler one",
                    chosen.output, largest_page / 1000));
}

int export_shader(const SceneFile& file, const ExportOptions& chosen) {
    const std::filesystem::path path = chosen.output;
    std::filesystem::path numbers_path = path;
    numbers_path.replace_extension(".f32");
    check_file_writable(path);
    const Document document = read_document(file);
    check_overwrites(file, document, named_files_of("--output", std::vector{chosen.output, numbers_path.string()}));
    const SceneTree tree = read_model(document, chosen.object);
    const TraceableObject traceable = made_of_tree(document, [&] { return prepare_to_trace(tree.object); });
    print_warning(file.shown(), traceable.warning);
    const Program program = record_tree(document, tree.object);
    GlslOptions options;
    options.phase_names = tree.phases.names;
    options.grid = chosen.grid;
    options.cancelled = [] { return interrupted(); };
    const float resolution = std::max(traceable.resolution, finest_of_diagonal * traceable.bounds.diagonal());
    const InterruptGuard guard;
    try {
        const GlslShader shader =
            made_of_tree(document, [&] { return make_glsl(program, traceable.bounds, resolution, options); });
        // Write the shader last, so that everything it needs exists when it appears.
        if (!shader.numbers.empty()) write_file(numbers_as_bytes(shader.numbers), numbers_path);
        write_file(shader.text, path);
    } catch (const BuildCancelled&) {
        say("phasetree: interrupted; no file was written\n");
        return code_of_interruption(false);
    }
    return exit_code::success;
}

// Rejects options that do not apply to files with this extension.
void check_options(const CLI::App& command, const std::string& extension) {
    const auto is_given = [&](const char* name) { return command.get_option(name)->count() > 0; };
    if (extension != ".glsl" && is_given("--grid")) throw UsageError("--grid is for .glsl files only");
    const bool is_grid = is_label_extension(extension);
    for (const char* name : {"--spacing", "--scale", "--max-memory"})
        if (!is_mesh_extension(extension) && !is_grid && is_given(name))
            throw UsageError(fmt::format("{} is for triangles and voxels, and {} files have neither", name, extension));
    if (!is_mesh_extension(extension) && is_given("--phase"))
        throw UsageError(fmt::format("--phase is for triangles, and {} files have none", extension));
}

// A validator for CLI11: returns an empty string if the text is a finite number above 0.
std::function<std::string(const std::string&)> is_positive(const std::string& what) {
    return [what](const std::string& text) {
        float number = 0;
        const bool is_right = CLI::detail::lexical_cast(text, number) && number > 0 && std::isfinite(number);
        return is_right ? std::string() : fmt::format("must be {}, but is \"{}\"", what, text);
    };
}

}  // namespace

void add_export(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("export", "Write the object as triangles, voxels, a web page or a shader");
    command->footer(
        "The extension of FILE selects the format.\n"
        "\n"
        ".3mf .stl .obj .glb .ply: triangles. Each phase has a closed surface. Neighbouring phases\n"
        "share vertices, so there are no gaps or overlaps. .3mf, .obj and .glb have one coloured object\n"
        "per phase; an .obj comes with an .mtl. The unit of length is a millimetre in .3mf and a metre\n"
        "in .glb; lengths are converted to it if the scene has a \"unit\". An .stl has the outer surface of\n"
        "all phases; with {phase} in its name, one file per phase is written. A .ply has each triangle\n"
        "once, with the phases on both sides. A different --max-memory may change the last digits of\n"
        "coordinates.\n"
        "\n"
        ".nrrd .vdb: the index of the phase at the centre of each voxel, 0 for the vacuum. A file whose\n"
        "name ends in .seg.nrrd is a segmentation for 3D Slicer, with the names and colours of phases.\n"
        "A .vdb has one grid of integers, \"labels\", with the names in its metadata.\n"
        "\n"
        ".html: a page of at most 500 kB that shows the object in a browser with WebGL 2, offline. It\n"
        "can be rotated, moved and zoomed; phases can be hidden, and a plane cuts the object open.\n"
        "\n"
        ".glsl: functions in GLSL ES 3.00 (WebGL 2) and GLSL 3.30 for distances, labels, normals and\n"
        "rays from phase to phase. Comments at the top explain how to call them. If there are more\n"
        "numbers than a shader can hold, they are written to FILE with the extension .f32, as\n"
        "little-endian 32-bit floats for an RGBA32F texture that is 1024 texels wide.");
    const auto file = add_scene_file(*command);
    auto options = std::make_shared<ExportOptions>();
    add_object(*command, options->object);
    command->add_option("-o,--output", options->output, "Output file")->required()->option_text("FILE");
    command
        ->add_option("--grid", options->grid,
                     "Shaders: divide the bounds into boxes, this many along the longest side, and evaluate in each "
                     "box only the nodes that matter there; 0 turns this off (default: 0)")
        ->check(CLI::Range(0, 64))
        ->option_text("N");
    command
        ->add_option("--spacing", options->mesh.spacing,
                     "Triangles and voxels: distance between grid points. Smaller details are lost (default: 1/256 of "
                     "the longest "
                     "side)")
        ->check(is_positive("a length such as 0.1"), "", "length")
        ->option_text("LENGTH");
    command
        ->add_option("--scale", options->mesh.scale,
                     "Triangles and voxels: scale the object by this factor (default: in .3mf and .glb, the factor "
                     "from the scene's \"unit\" to that of the format; otherwise 1)")
        ->check(is_positive("a factor such as 25.4"), "", "factor")
        ->option_text("FACTOR");
    command
        ->add_option("--phase", options->mesh.phases,
                     "Triangles: write only this phase; may be repeated (default: all but the vacuum)")
        ->option_text("NAME");
    add_max_memory(*command, options->mesh.max_bytes);
    command->callback([=, &run] {
        run = [=] {
            const std::string extension = std::filesystem::path(options->output).extension().string();
            if (extension == ".glsl" || extension == ".html" || is_mesh_extension(extension) ||
                is_label_extension(extension))
                check_options(*command, extension);
            if (extension == ".glsl") return export_shader(*file, *options);
            if (extension == ".html") return export_page(*file, *options);
            if (is_mesh_extension(extension)) {
                options->mesh.output = options->output;
                options->mesh.object = options->object;
                return export_mesh(*file, options->mesh);
            }
            if (is_label_extension(extension))
                return export_labels(*file, {options->output, options->mesh.spacing, options->mesh.scale,
                                             options->object, options->mesh.max_bytes});
            throw OutputNameError(
                fmt::format("cannot write \"{}\": {}; use .3mf, .stl, .obj, .glb, .ply, .nrrd, .vdb, .html or .glsl",
                            options->output,
                            extension.empty() ? "its name has no extension" : "unknown format \"" + extension + "\""));
        };
    });
}

}  // namespace phasetree::tracer
