#include "preparation/prepared_field.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "program/op_traits.hpp"

namespace phasetree::preparation {

using program::traits;

namespace {

// The cost of recording an instruction, in steps.
constexpr std::uint64_t recording = 100;

Program recorded(std::string_view node, const Field& field) {
    try {
        return record(field);
    } catch (const ModelError& e) {
        throw ModelError(fmt::format("{}: {}", node, e.what()));
    }
}

// The cost of an evaluation. A long primitive counts as several steps, and a primitive with data as a quarter of the
// floats that it reads.
std::uint64_t steps_of(const Program& program) {
    std::uint64_t steps = 20;  // for the call
    for (std::size_t i = 1; i < program.instructions.size(); ++i) {
        const Instruction& in = program.instructions[i];
        const std::size_t end =
            i + 1 < program.instructions.size() ? program.instructions[i + 1].data : program.constants.size();
        const std::size_t all = end - in.data, read = traits(in.op).floats_read;
        const std::size_t floats = read == 0 ? all : std::min(read, all);
        steps += std::max<std::uint64_t>(traits(in.op).half_instructions / 2, floats / 4);
    }
    return steps;
}

}  // namespace

PreparedField::PreparedField(std::string_view node, const Field& field, Preparation& preparation)
    : preparation_(preparation),
      evaluator_(recorded(node, field)),
      out_(evaluator_.program().outputs.size()),
      steps_(steps_of(evaluator_.program())) {
    preparation.pay(recording * evaluator_.program().instructions.size());
}

BatchOfFloats PreparedField::operator()(const BatchOfPoints& p) {
    preparation_.pay(steps_);
    evaluator_.evaluate(p.x, p.y, p.z, out_, registers_);
    return out_.back();  // the outputs are the vacuum and the field
}

}  // namespace phasetree::preparation
