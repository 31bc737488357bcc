#include "phasetree/glsl/shader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "glsl/functions.hpp"
#include "glsl/runtime.hpp"
#include "program/op_traits.hpp"

namespace phasetree {

using glsl::Functions, glsl::literal;
using program::gives_point, program::operands;

namespace {

std::string vector(const glm::vec3& v) {
    return fmt::format("vec3({}, {}, {})", literal(v.x), literal(v.y), literal(v.z));
}

// What must be called for the instructions of a program.
std::vector<std::uint32_t> add_all(const Program& program, Functions& functions) {
    std::vector<std::uint32_t> added(program.instructions.size(), 0);
    for (std::size_t i = 1; i < program.instructions.size(); ++i) {
        const Instruction& in = program.instructions[i];
        const std::size_t end =
            i + 1 < program.instructions.size() ? program.instructions[i + 1].data : program.constants.size();
        added[i] = functions.add(in.op, std::span(program.constants).subspan(in.data, end - in.data));
    }
    return added;
}

// phasetree_distances(), or phasetree_gradients().
std::string program_text(const Program& program, const Functions& functions, const std::vector<std::uint32_t>& calls,
                         bool with_gradients) {
    const char* const number = with_gradients ? "vec4" : "float";
    std::string text = with_gradients ? "void phasetree_gradients(vec3 p, out vec4 phi[PHASETREE_COMPONENTS]) {\n"
                                        "    mat3x4 v0 = mat3x4(1.0, 0.0, 0.0, p.x, 0.0, 1.0, 0.0, p.y, "
                                        "0.0, 0.0, 1.0, p.z);\n"
                                      : "void phasetree_distances(vec3 p, out float phi[PHASETREE_COMPONENTS]) {\n"
                                        "    vec3 v0 = p;\n";
    for (std::size_t i = 1; i < program.instructions.size(); ++i) {
        const Instruction& in = program.instructions[i];
        std::vector<std::string> arguments;
        if (in.op >= Op::first_primitive) {
            for (int k = 0; k < 3; ++k)
                arguments.push_back(with_gradients ? fmt::format("v{}[{}]", in.a, k)
                                                   : fmt::format("v{}.{}", in.a, static_cast<char>('x' + k)));
        } else {
            arguments.push_back(fmt::format("v{}", in.a));
            if (operands(in.op) > 1) arguments.push_back(fmt::format("v{}", in.b));
        }
        const char* const type = gives_point(in.op) ? (with_gradients ? "mat3x4" : "vec3") : number;
        text += fmt::format("    {} v{} = {};\n", type, i, functions.call(calls[i], arguments, with_gradients));
    }
    for (std::size_t k = 0; k < program.outputs.size(); ++k)
        text += fmt::format("    phi[{}] = v{};\n", k, program.outputs[k].value);
    return text + "}\n";
}

std::string heading(const Program& program, const GlslOptions& options) {
    std::string text =
        "// An object of several phases: its distances, labels, normals, and rays from phase to phase.\n"
        "// Made by phasetree. For GLSL ES 3.00 and GLSL 3.30: put #version before this text and main() behind it.\n"
        "//\n"
        "//     void phasetree_distances(vec3 p, out float phi[PHASETREE_COMPONENTS])\n"
        "//     void phasetree_gradients(vec3 p, out vec4 phi[PHASETREE_COMPONENTS])   xyz the gradient, w the "
        "distance\n"
        "//     int phasetree_phase(int component)                                     the phase of a component\n"
        "//     int phasetree_label(vec3 p)                                            the phase at p\n"
        "//     int phasetree_sample(vec3 p, out float interface_distance)\n"
        "//     vec3 phasetree_normal(vec3 p, int phase)                               out of the phase\n"
        "//     PhasetreeCrossing phasetree_trace(vec3 origin, vec3 direction, float t_min, float t_max, int carried)\n"
        "//\n";
    for (const Output& o : program.outputs)
        if (o.phase.index < options.phase_names.size()) {
            std::string name = options.phase_names[o.phase.index];
            // A name must not end the comment.
            std::ranges::replace_if(
                name, [](char c) { return static_cast<unsigned char>(c) < 32 || c == '\\'; }, ' ');
            text += fmt::format("// phase {}: {}\n", o.phase.index, name);
        }
    return text;
}

std::string definitions(const Program& program, const Bounds& bounds, float resolution, const GlslOptions& options) {
    std::string text = "precision highp float;\nprecision highp int;\n\n";
    text += fmt::format("const int PHASETREE_COMPONENTS = {};\n", program.outputs.size());
    text += fmt::format("const int PHASETREE_STEPS = {};\n", options.steps);
    text += fmt::format("const float PHASETREE_RESOLUTION = {};\n", literal(resolution));
    text +=
        fmt::format("const vec3 PHASETREE_LOW = {}, PHASETREE_HIGH = {};\n\n", vector(bounds.low), vector(bounds.high));
    text += "int phasetree_phase(int component) {\n";
    for (std::size_t i = 0; i + 1 < program.outputs.size(); ++i)
        text += fmt::format("    if (component == {}) return {};\n", i, program.outputs[i].phase.index);
    return text + fmt::format("    return {};\n}}\n\n", program.outputs.back().phase.index);
}

std::string numbers_text(const std::vector<float>& numbers, bool in_texture) {
    if (in_texture)
        return "uniform highp sampler2D phasetree_numbers;\n"
               "float pt_number(int i) { return texelFetch(phasetree_numbers, ivec2(i & 1023, i >> 10), 0).r; }\n\n";
    if (numbers.empty()) return "float pt_number(int i) { return 0.0; }\n\n";
    std::string text = fmt::format("const float pt_numbers[{0}] = float[{0}](", numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i)
        text += (i == 0 ? "\n    " : i % 8 == 0 ? ",\n    " : ", ") + literal(numbers[i]);
    return text + ");\nfloat pt_number(int i) { return pt_numbers[i]; }\n\n";
}

}  // namespace

GlslShader make_glsl(const Program& program, const Bounds& bounds, float resolution, const GlslOptions& options) {
    if (program.instructions.size() > longest_glsl_program)
        throw ModelError(
            fmt::format("the object has {} instructions, and a shader takes {}: export a part of it, or "
                        "a page, which cuts it into cells",
                        program.instructions.size(), longest_glsl_program));
    Functions functions;
    const std::vector<std::uint32_t> calls = add_all(program, functions);
    functions.finish();
    const bool in_texture = functions.numbers().size() > options.most_numbers_in_text;
    GlslShader shader;
    shader.text = heading(program, options) + definitions(program, bounds, resolution, options) +
                  numbers_text(functions.numbers(), in_texture) + functions.text(false) + "\n" +
                  program_text(program, functions, calls, false) + glsl::gradient_arithmetic + "\n" +
                  functions.text(true) + "\n" + program_text(program, functions, calls, true) + glsl::phase_tracer;
    if (in_texture) shader.numbers = functions.numbers();
    return shader;
}

}  // namespace phasetree
