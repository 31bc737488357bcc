#include <CLI/CLI.hpp>
#include <algorithm>
#include <bit>
#include <filesystem>

#include "command/commands.hpp"
#include "command/load.hpp"
#include "command/streams.hpp"
#include "output/error.hpp"
#include "output/file.hpp"
#include "output/interrupt.hpp"
#include "phasetree/building/options.hpp"
#include "phasetree/glsl/shader.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/trace/tracer.hpp"

namespace phasetree::tracer {

namespace {

// Numbers of shaders are rounded more often than ours, and a bracket must be longer than what that moves.
constexpr float finest_of_diagonal = 1e-5f;

struct Options {
    std::string output;
    int grid = 0;
};

std::string numbers_as_bytes(const std::vector<float>& numbers) {
    std::string bytes;
    bytes.reserve(4 * numbers.size());
    for (const float v : numbers) {
        const auto bits = std::bit_cast<std::uint32_t>(v);
        for (int i = 0; i < 4; ++i) bytes += static_cast<char>(bits >> (8 * i) & 255);
    }
    return bytes;
}

int export_shader(const SceneFile& file, const Options& chosen) {
    const std::filesystem::path path = chosen.output;
    std::filesystem::path numbers_path = path;
    numbers_path.replace_extension(".f32");
    check_file_writable(path);
    const Document document = read_document(file);
    const SceneTree tree = read_model(document);
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
        // The shader comes last: where it is, all that it needs is.
        if (!shader.numbers.empty()) write_file(numbers_as_bytes(shader.numbers), numbers_path);
        write_file(shader.text, path);
    } catch (const BuildCancelled&) {
        say("phasetree: interrupted; nothing is written\n");
        return 1;
    }
    return 0;
}

}  // namespace

void add_export(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("export", "Write a scene's object for other programs");
    command->footer(
        "The extension of FILE says what is written.\n"
        ".glsl: functions in GLSL ES 3.00 (WebGL 2) and GLSL 3.30 for the distances, the label,\n"
        "normals and rays from phase to phase; comments at its top say how they are called. If it\n"
        "has more numbers than a shader can hold they are in FILE with the extension .f32: 32-bit\n"
        "floats, lowest byte first, for a texture of format RGBA32F that is 1024 texels wide.");
    const auto file = add_scene_file(*command);
    auto options = std::make_shared<Options>();
    command->add_option("-o,--output", options->output, "The file to write")->required()->option_text("FILE");
    command
        ->add_option("--grid", options->grid,
                     "Divide the object's bounds into boxes, so many along the longest side, and evaluate in each "
                     "only what matters there; 0 for none (default: 0)")
        ->check(CLI::Range(0, 64))
        ->option_text("N");
    command->callback([=, &run] {
        run = [=] {
            const std::string extension = std::filesystem::path(options->output).extension().string();
            if (extension == ".glsl") return export_shader(*file, *options);
            throw OutputError(
                fmt::format("cannot write \"{}\": {}, and an export is .glsl", options->output,
                            extension.empty() ? "it has no extension" : "its extension is \"" + extension + "\""));
        };
    });
}

}  // namespace phasetree::tracer
