#include <fmt/format.h>

#include <cstdio>
#include <iostream>
#include <limits>

#include "command/commands.hpp"
#include "command/load.hpp"
#include "command/numbers.hpp"
#include "phasetree/math/float_mode.hpp"
#include "phasetree/program/evaluator.hpp"
#include "phasetree/reading/tree.hpp"
#include "phasetree/trace/tracer.hpp"

namespace phasetree::tracer {

namespace {

// t counts in units of the direction as it was given, so that origin + t·direction is the place.
int trace(const std::string& file) {
    const Document document = Document::from_file(file);
    const SceneTree tree = read_tree(document);
    (void)record_tree(document, tree.object);
    const InterfaceTracer tracer = made_of_tree(document, [&] { return InterfaceTracer(tree.object); });
    Evaluator::Workspace workspace;
    const FlushSubnormals flush;
    fmt::print("ray,t,from,to,nx,ny,nz\n");
    std::size_t ray = 0;
    for_each_line_of_numbers(std::cin, 6, [&](const std::array<float, 6>& v, std::size_t line) {
        const glm::vec3 origin(v[0], v[1], v[2]), given(v[3], v[4], v[5]);
        const double length = glm::length(glm::dvec3(given));
        if (!(length > 0)) throw InputError(fmt::format("<stdin>:{}:1: the ray has no direction", line));
        const glm::vec3 direction(glm::dvec3(given) / length);
        glm::vec3 start = origin;
        Phase phase = tracer.label(origin, workspace);
        while (const auto c =
                   tracer.first_crossing(start, direction, 0, std::numeric_limits<float>::max(), phase, workspace)) {
            const double t = glm::dot(glm::dvec3(c->p_in) - glm::dvec3(origin), glm::dvec3(direction)) / length;
            const glm::vec3 n = tracer.normal(*c, direction);
            fmt::print("{},{},{},{},{},{},{}\n", ray, static_cast<float>(t), tree.phases[c->from], tree.phases[c->to],
                       n.x, n.y, n.z);
            start = c->p_out;
            phase = c->to;
        }
        ++ray;
    });
    return 0;
}

}  // namespace

void add_trace(CLI::App& app, Run& run) {
    CLI::App* command =
        app.add_subcommand("trace", "Read rays \"ox oy oz dx dy dz\" and write every interface along each as CSV");
    auto file = std::make_shared<std::string>();
    command->add_option("scene", *file, "The scene file")->required();
    command->callback([file, &run] { run = [file] { return trace(*file); }; });
}

}  // namespace phasetree::tracer
