#include "glsl/program_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "evaluation/assemble.hpp"
#include "program/op_traits.hpp"

namespace phasetree::glsl {

using program::gives_point, program::operands;

namespace {

// The number of a function and that of a slot share a float, which represents integers up to 2²⁴ exactly.
constexpr std::uint32_t most_functions = 2048, most_slots = 4096;

}  // namespace

ProgramTable::ProgramTable(const Program& whole, Functions& functions)
    : whole_(whole), functions_(functions), ends_(whole.constants.size() + 1, 0) {
    const auto& code = whole.instructions;
    for (std::size_t i = 1; i < code.size(); ++i)
        ends_[code[i].data] =
            std::max(ends_[code[i].data],
                     i + 1 < code.size() ? code[i + 1].data : static_cast<std::uint32_t>(whole.constants.size()));
}

std::uint32_t ProgramTable::instruction_at(const Instruction& in) {
    const auto [known, is_new] = known_.try_emplace({in.op, in.data}, 0);
    if (is_new) {
        // A constant appended by rewriting stands alone.
        const std::uint32_t end = std::max(ends_[in.data], in.data);
        const bool is_appended = ends_[in.data] == 0 && in.data < whole_.constants.size();
        known->second =
            functions_.add(in.op, std::span(whole_.constants).subspan(in.data, is_appended ? 1 : end - in.data));
    }
    return known->second;
}

std::size_t ProgramTable::add(const BoxProgram& program) {
    const evaluation::Assembly assembly = evaluation::assemble(program.code, program.outputs);
    Entry entry;
    for (std::size_t i = 0; i < assembly.steps.size(); ++i) {
        const evaluation::Step& s = assembly.steps[i];
        entry.steps.push_back({instruction_at({static_cast<Op>(s.op), 0, 0, assembly.data[i]}), s.to, s.a, s.b});
    }
    for (const evaluation::OutputSlot& o : assembly.outputs) {
        const auto of_whole =
            std::ranges::find(whole_.outputs, static_cast<int>(o.phase), [](const Output& w) { return w.phase.index; });
        entry.outputs.push_back(
            {o.phase, static_cast<float>(o.slot), o.sign, static_cast<float>(of_whole - whole_.outputs.begin())});
    }
    slots_ = std::max(slots_, assembly.slots);
    entries_.push_back(std::move(entry));
    return entries_.size() - 1;
}

std::vector<std::size_t> ProgramTable::append_to(std::vector<float>& numbers) const {
    if (functions_.count() > most_functions || slots_ > most_slots)
        throw ModelError("the object is too large for a shader");
    std::vector<std::size_t> offsets;
    numbers.resize((numbers.size() + 3) / 4 * 4, 0.f);
    const auto put = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
        for (const std::size_t v : {a, b, c, d}) numbers.push_back(static_cast<float>(v));
    };
    for (const Entry& e : entries_) {
        offsets.push_back(numbers.size() / 4);
        put(e.steps.size(), e.outputs.size(), 0, 0);
        for (const Step& s : e.steps)
            put(functions_.function(s.instruction) + most_functions * s.to, s.a, s.b, functions_.at(s.instruction));
        for (const auto& o : e.outputs) numbers.insert(numbers.end(), o.begin(), o.end());
    }
    return offsets;
}

std::string ProgramTable::text(bool with_gradients) const {
    const char* const d = with_gradients ? "d_" : "";
    const char* const number = with_gradients ? "vec4" : "float";
    std::string text = fmt::format("{0} pt_{1}slots[{2}];\n", number, d, slots_);
    text += fmt::format("void pt_{}run(int first, int count, vec3 p) {{\n", d);
    for (int i = 0; i < 3; ++i)
        text += with_gradients ? fmt::format("    pt_d_slots[{0}] = vec4({1}, p[{0}]);\n", i,
                                             i == 0   ? "1.0, 0.0, 0.0"
                                             : i == 1 ? "0.0, 1.0, 0.0"
                                                      : "0.0, 0.0, 1.0")
                               : fmt::format("    pt_slots[{0}] = p[{0}];\n", i);
    text += fmt::format(
        "    for (int i = 0; i < count; ++i) {{\n"
        "        vec4 s = pt_four(first + i);\n"
        "        int f = int(s.x), a = int(s.y), b = int(s.z), at = int(s.w), to = f >> 11;\n"
        "        f &= {};\n"
        "        {} x = pt_{}slots[a];\n"
        "        switch (f) {{\n",
        most_functions - 1, number, d);
    const auto slot = [&](const char* index) { return fmt::format("pt_{}slots[{}]", d, index); };
    for (std::uint32_t f = 0; f < functions_.count(); ++f) {
        const Op op = functions_.operation(f);
        std::vector<std::string> arguments{"x"};
        if (op >= Op::first_primitive)
            arguments.insert(arguments.end(), {slot("a + 1"), slot("a + 2")});
        else if (operands(op) > 1)
            arguments.push_back(slot("b"));
        const std::string call = functions_.call_at(f, arguments, "at", with_gradients);
        if (gives_point(op))
            text +=
                fmt::format("            case {0}: {{ {1} q = {2}; {3} = q[0]; {4} = q[1]; {5} = q[2]; break; }}\n", f,
                            with_gradients ? "mat3x4" : "vec3", call, slot("to"), slot("to + 1"), slot("to + 2"));
        else
            text += fmt::format("            case {}: {} = {}; break;\n", f, slot("to"), call);
    }
    return text + "        }\n    }\n}\n";
}

}  // namespace phasetree::glsl
