#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "command/commands.hpp"
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
    options.most_numbers_in_text = 0;
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
            return 0;
        }
    } catch (const BuildCancelled&) {
        say("phasetree: interrupted; nothing is written\n");
        return 1;
    }
    throw OutputError(
        fmt::format("cannot write \"{}\": the page would be larger than {} kB", chosen.output, largest_page / 1000));
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
        say("phasetree: interrupted; nothing is written\n");
        return 1;
    }
    return 0;
}

// Rejects options that do not apply to files with this extension.
void check_options(const CLI::App& command, const std::string& extension) {
    const auto is_given = [&](const char* name) { return command.get_option(name)->count() > 0; };
    if (extension != ".glsl" && is_given("--grid")) throw InputError("--grid is for .glsl");
    for (const char* name : {"--spacing", "--scale", "--phase", "--max-memory"})
        if (!is_mesh_extension(extension) && is_given(name))
            throw InputError(fmt::format("{} is for triangles, and {} has none", name, extension));
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
    CLI::App* command = app.add_subcommand("export", "Write a scene's object for other programs");
    command->footer(
        "The extension of FILE says what is written.\n"
        ".glsl: functions in GLSL ES 3.00 (WebGL 2) and GLSL 3.30 for the distances, the label,\n"
        "normals and rays from phase to phase; comments at its top say how they are called. If it\n"
        "has more numbers than a shader can hold they are in FILE with the extension .f32: 32-bit\n"
        "floats, lowest byte first, for a texture of format RGBA32F that is 1024 texels wide.\n"
        ".html: a page of at most 500 kB that shows the object in a browser with WebGL 2, from disk\n"
        "and without a net. Drag to turn, with shift or the right button to move, scroll to zoom;\n"
        "arrows, +, - and 0 do the same; phases can be hidden, and a plane cuts the object open.\n"
        ".3mf .stl .obj .glb .ply: triangles. Each phase has a closed surface; where two touch they\n"
        "share its triangles' corners, so there are neither gaps nor overlaps. .3mf, for printers, and\n"
        ".obj and .glb have an object of its own for each phase, with its colour; .obj has a file .mtl\n"
        "beside it; a unit of length is a millimetre in .3mf, a metre in .glb. .stl has what bounds\n"
        "all phases together or, with {phase} in the name of FILE, a file for each. .ply has each\n"
        "triangle once, with the phases on both of its sides. Another --max-memory may change last\n"
        "digits.");
    const auto file = add_scene_file(*command);
    auto options = std::make_shared<ExportOptions>();
    add_object(*command, options->object);
    command->add_option("-o,--output", options->output, "The file to write")->required()->option_text("FILE");
    command
        ->add_option("--grid", options->grid,
                     "Of a shader: divide the object's bounds into boxes, this many along the longest side, and "
                     "evaluate in each "
                     "only what matters there; 0 for none (default: 0)")
        ->check(CLI::Range(0, 64))
        ->option_text("N");
    command
        ->add_option("--spacing", options->mesh.spacing,
                     "Of triangles: the distance of the grid's points, about the size of the smallest that is kept "
                     "(default: a 256th of the longest side)")
        ->check(is_positive("a length such as 0.1"), "", "length")
        ->option_text("LENGTH");
    command
        ->add_option(
            "--scale", options->mesh.scale,
            "Of triangles: how much larger they are than the scene, such as 25.4 for a scene in inches that is "
            "to be printed (default: 1)")
        ->check(is_positive("a factor such as 25.4"), "", "factor")
        ->option_text("FACTOR");
    command
        ->add_option("--phase", options->mesh.phases,
                     "Of triangles: a phase that is to be written; may be repeated (default: all but the vacuum)")
        ->option_text("NAME");
    add_max_memory(*command, options->mesh.most_bytes);
    command->callback([=, &run] {
        run = [=] {
            const std::string extension = std::filesystem::path(options->output).extension().string();
            if (extension == ".glsl" || extension == ".html" || is_mesh_extension(extension))
                check_options(*command, extension);
            if (extension == ".glsl") return export_shader(*file, *options);
            if (extension == ".html") return export_page(*file, *options);
            if (is_mesh_extension(extension)) {
                options->mesh.output = options->output;
                options->mesh.object = options->object;
                return export_mesh(*file, options->mesh);
            }
            throw OutputError(fmt::format(
                "cannot write \"{}\": {}, and an export is .3mf, .stl, .obj, .glb, .ply, .html or .glsl",
                options->output, extension.empty() ? "it has no extension" : "its extension is \"" + extension + "\""));
        };
    });
}

}  // namespace phasetree::tracer
