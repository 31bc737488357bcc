#include "phasetree/glsl/shader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "glsl/functions.hpp"
#include "glsl/program_table.hpp"
#include "glsl/pruned_grid.hpp"
#include "glsl/runtime.hpp"
#include "program/op_traits.hpp"

namespace phasetree {

using glsl::Functions, glsl::literal;
using program::gives_point, program::operands;

namespace {

std::string vector(const glm::vec3& v) {
    return fmt::format("vec3({}, {}, {})", literal(v.x), literal(v.y), literal(v.z));
}

// Adds the functions for all instructions of a program. Returns the index of each instruction in `functions`.
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

// The text of phasetree_distances(), or of phasetree_gradients().
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

std::string heading(const Program& program, const GlslOptions& options, std::size_t rows) {
    std::string text =
        "// An object of several phases: its distances, labels, normals, and rays from phase to phase.\n"
        "// Made by phasetree. For GLSL ES 3.00 and GLSL 3.30: put #version before this text and main() behind it.\n"
        "//\n"
        "//     void phasetree_distances(vec3 p, out float phi[PHASETREE_COMPONENTS])\n"
        "//     void phasetree_gradients(vec3 p, out vec4 phi[PHASETREE_COMPONENTS])   xyz the gradient, w the "
        "distance\n"
        "//     int phasetree_phase(int component)                                     the phase of a component\n"
        "//     int phasetree_label(vec3 p)                                            the phase at p; 0 is vacuum\n"
        "//     int phasetree_sample(vec3 p, out float interface_distance)\n"
        "//     vec3 phasetree_normal(vec3 p, int phase)                               out of the phase\n"
        "//     PhasetreeCrossing phasetree_trace(vec3 origin, vec3 direction, float t_min, float t_max, int carried)\n"
        "//\n"
        "// In a fragment shader, for example:\n"
        "//\n"
        "//     PhasetreeCrossing c = phasetree_trace(eye, direction, 0.0, 1e9, -1);\n"
        "//     color = c.found ? vec4(0.5 + 0.5 * c.normal, 1.0) : vec4(0.0, 0.0, 0.0, 1.0);\n"
        "//\n";
    if (rows > 0)
        text += fmt::format(
            "// The sampler phasetree_numbers must be a texture of format RGBA32F that is 1024 wide and {} high, with\n"
            "// the numbers that came with this text, and without a filter (NEAREST).\n//\n",
            rows);
    for (const Output& o : program.outputs)
        if (o.phase.index < options.phase_names.size()) {
            std::string name = options.phase_names[o.phase.index];
            // Prevent a name from ending the comment.
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

// Packs four numbers per vector.
std::string numbers_text(const std::vector<float>& numbers, bool in_texture) {
    if (in_texture)
        return "uniform highp sampler2D phasetree_numbers;\n"
               "vec4 pt_four(int i) { return texelFetch(phasetree_numbers, ivec2(i & 1023, i >> 10), 0); }\n"
               "float pt_number(int i) { return pt_four(i >> 2)[i & 3]; }\n\n";
    if (numbers.empty()) return "float pt_number(int i) { return 0.0; }\n\n";
    std::string text = fmt::format("const vec4 pt_numbers[{0}] = vec4[{0}](", numbers.size() / 4);
    for (std::size_t i = 0; i < numbers.size(); i += 4)
        text +=
            fmt::format("{}vec4({}, {}, {}, {})",
                        i == 0       ? "\n    "
                        : i % 8 == 0 ? ",\n    "
                                     : ", ",
                        literal(numbers[i]), literal(numbers[i + 1]), literal(numbers[i + 2]), literal(numbers[i + 3]));
    return text +
           ");\nvec4 pt_four(int i) { return pt_numbers[i]; }\n"
           "float pt_number(int i) { return pt_numbers[i >> 2][i & 3]; }\n\n";
}

void fill_rows(std::vector<float>& numbers, std::size_t row) {
    numbers.resize((numbers.size() + row - 1) / row * row, 0.f);
}

// The text that evaluates the object, without the part that reads its numbers.
struct Evaluation {
    std::string text;
    std::vector<float> numbers;
    std::size_t boxes = 0, programs = 0;
};

// Evaluation as text, with one call per instruction.
Evaluation by_calls(const Program& program) {
    Functions functions;
    const std::vector<std::uint32_t> calls = add_all(program, functions);
    functions.finish();
    return {functions.text(false) + "\n" + program_text(program, functions, calls, false) + glsl::gradient_arithmetic +
                "\n" + functions.text(true) + "\n" + program_text(program, functions, calls, true) +
                glsl::calls_sampler,
            functions.numbers()};
}

glsl::BoxProgram whole_of(const Program& program) {
    glsl::BoxProgram whole{program.instructions, {}};
    for (const Output& o : program.outputs) whole.outputs.push_back({o.phase, o.value, false});
    return whole;
}

// Evaluation by a loop that interprets a table of instructions.
Evaluation by_table(Program program, const Bounds& bounds, float resolution, const GlslOptions& options) {
    const glsl::BoxProgram whole = whole_of(program);
    glsl::PrunedGrid grid;
    if (options.grid > 0) grid = glsl::prune_on_grid(program, bounds, 4 * resolution, options.grid, options.cancelled);
    // The instructions of the whole program determine where the constants of each end; rewriting leaves them unchanged.
    Functions functions;
    glsl::ProgramTable table(program, functions);
    table.add(whole);
    for (const glsl::BoxProgram& p : grid.programs) table.add(p);
    functions.finish();
    Evaluation result{{}, functions.numbers(), grid.content.size(), grid.programs.size()};
    const std::vector<std::size_t> offsets = table.append_to(result.numbers);
    result.text = fmt::format("const int PT_WHOLE = {};\n", offsets[0]);
    if (options.grid > 0) {
        result.text += fmt::format("const int PT_GRID = {};\nconst ivec3 PT_BOXES = ivec3({}, {}, {});\n",
                                   result.numbers.size(), grid.boxes[0], grid.boxes[1], grid.boxes[2]);
        for (const std::int32_t c : grid.content)
            result.numbers.push_back(c < 0 ? static_cast<float>(c)
                                           : static_cast<float>(offsets[static_cast<std::size_t>(c) + 1]));
    }
    result.text += functions.text(false) + "\n" + table.text(false) + glsl::gradient_arithmetic + "\n" +
                   functions.text(true) + "\n" + table.text(true) + glsl::table_evaluation +
                   (options.grid > 0 ? glsl::grid_of_programs : glsl::one_program) + glsl::table_sampler +
                   (options.grid > 0 ? glsl::grid_sampler : glsl::one_program_sampler);
    return result;
}

}  // namespace

GlslShader make_glsl(const Program& program, const Bounds& bounds, float resolution, const GlslOptions& options) {
    if (program.instructions.size() > max_glsl_instructions)
        throw ModelError(
            fmt::format("the object has {} instructions, but a shader can hold only {}; export a part of it",
                        program.instructions.size(), max_glsl_instructions));
    const bool is_table = options.grid > 0 || program.instructions.size() > options.max_calls;
    Evaluation evaluation = is_table ? by_table(program, bounds, resolution, options) : by_calls(program);
    const bool in_texture = evaluation.numbers.size() > options.max_numbers_in_text;
    fill_rows(evaluation.numbers, in_texture ? GlslShader::numbers_in_row : 4);
    GlslShader shader;
    shader.text = heading(program, options, in_texture ? evaluation.numbers.size() / GlslShader::numbers_in_row : 0) +
                  definitions(program, bounds, resolution, options) + numbers_text(evaluation.numbers, in_texture) +
                  evaluation.text + glsl::phase_tracer;
    if (in_texture) shader.numbers = std::move(evaluation.numbers);
    shader.boxes = evaluation.boxes;
    shader.programs = evaluation.programs;
    return shader;
}

}  // namespace phasetree
