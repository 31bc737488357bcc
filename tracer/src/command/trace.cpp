#include <CLI/CLI.hpp>
#include <iostream>
#include <limits>

#include "command/commands.hpp"
#include "command/copies_at.hpp"
#include "command/load.hpp"
#include "command/numbers.hpp"
#include "command/streams.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/math/float_mode.hpp"
#include "phasetree/trace/tracer.hpp"

namespace phasetree::tracer {

namespace {

constexpr NumberTable::Column columns[] = {{"ox"}, {"oy"}, {"oz"}, {"dx"}, {"dy"}, {"dz"}};

// t is in units of the direction as given, so the position is origin + t·direction.
int trace(const SceneFile& file, const std::optional<std::string>& object) {
    const Document document = read_document_beside_input(file);
    const SceneModel model = read_scene_model(document);
    const SceneTree tree = tree_of_model(document, model, object);
    std::optional<CopiesAt> copies;
    if (!object && !model.placed.empty()) copies.emplace(model.placed);
    const auto copy_at = [&](const glm::vec3& p) { return copies ? copies->columns(p) : std::string(); };
    (void)record_tree(document, tree.object);
    const InterfaceTracer tracer = made_of_tree(document, [&] { return InterfaceTracer(tree.object); });
    print_warning(file.shown(), tracer.warning());
    Evaluator::Workspace workspace;
    const FlushSubnormals flush;
    put("ray,t,from,to,nx,ny,nz{}\n", copies ? ",to_object,to_copy" : "");
    std::size_t ray = 0;
    for_each_row(std::cin, columns, [&](const std::array<float, 6>& v, const NumberTable& table) {
        const glm::vec3 origin(v[0], v[1], v[2]), given(v[3], v[4], v[5]);
        const double length = glm::length(glm::dvec3(given));
        if (!(length > 0)) throw table.error(3, "the direction must not be zero; any other length will do");
        const glm::vec3 direction(glm::dvec3(given) / length);
        // After the first interface, positions are computed from there. Restarting the ray at each interface would add
        // a rounding error each time; at grazing angles, these errors could keep the ray at the interface.
        glm::vec3 start = origin;
        float from = 0;
        bool is_at_object = false;
        Phase phase = tracer.label(origin, workspace);
        put("{},0,,{},,,{}\n", ray, csv_cell(tree.phases[phase]), copy_at(origin));
        while (const auto c =
                   tracer.first_crossing(start, direction, from, std::numeric_limits<float>::max(), phase, workspace)) {
            const double t = glm::dot(glm::dvec3(c->p_from) - glm::dvec3(origin), glm::dvec3(direction)) / length;
            const glm::vec3 n = tracer.normal(*c, direction);
            put("{},{},{},{},{},{},{}{}\n", ray, unsigned_zero(static_cast<float>(t)), csv_cell(tree.phases[c->from]),
                csv_cell(tree.phases[c->to]), unsigned_zero(n.x), unsigned_zero(n.y), unsigned_zero(n.z),
                copy_at(c->p_to));
            if (is_at_object) {
                from = c->t_to;
            } else {
                start = c->p_to;
                is_at_object = true;
            }
            phase = c->to;
        }
        ++ray;
    });
    return 0;
}

}  // namespace

void add_trace(CLI::App& app, Run& run) {
    CLI::App* command = app.add_subcommand("trace", "Print the interfaces along rays, as CSV");
    command->footer(
        "Reads one ray per line, \"ox oy oz dx dy dz\", from standard input, separated by blanks or\n"
        "commas; # begins a comment. The direction may have any length. Also reads CSV with a header\n"
        "that names the columns ox, oy, oz, dx, dy and dz.\n"
        "\n"
        "Writes ray,t,from,to,nx,ny,nz to standard output. Rays are numbered from 0. The first line of\n"
        "each ray describes its origin: t is 0, \"from\" and the normal are empty, and \"to\" is the\n"
        "phase there. Then comes one line per interface, in order. The interface lies at origin +\n"
        "t·direction. t is the near end of the bracket that was found, which is still in \"from\"; the\n"
        "far end, in \"to\", is less than the resolution away. The normal has unit length and points\n"
        "from \"from\" into \"to\", so along the ray: normal·direction ≥ 0. With several objects, the\n"
        "columns to_object,to_copy come last: the object that \"to\" belongs to, and the number of its\n"
        "copy.\n"
        "\n"
        "The whole scene file is checked, but it may lack a camera and lights, and the files of\n"
        "lights, meshes, textures and media are not opened.");
    const auto file = add_scene_file(*command);
    auto object = std::make_shared<std::optional<std::string>>();
    add_object(*command, *object);
    command->callback([=, &run] { run = [=] { return trace(*file, *object); }; });
}

}  // namespace phasetree::tracer
