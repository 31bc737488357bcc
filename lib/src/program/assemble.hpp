#pragma once

#include "kernel/kernel.hpp"

namespace phasetree {

/// An output as it comes out of a program. With `negate` the component is minus the value: where only two phases meet,
/// one value tells both.
struct ProgramOutput {
    Phase phase;
    std::uint32_t value = 0;
    bool negate = false;
};

/// Instructions made ready to run: registers assigned, operations resolved.
struct Assembly {
    std::vector<Step> steps;
    std::vector<OutputSlot> outputs;
    std::uint32_t slots = 0;

    Routine routine(const float* constants) const {
        return {steps.data(), steps.size(), constants, outputs.data(), outputs.size()};
    }
};

/// Values whose last use is past give their register to later ones.
Assembly assemble(std::span<const Instruction> code, std::span<const ProgramOutput> outputs);
/// A value that is read after the program has run, though it is no output, and where it is then found.
struct KeptValue {
    std::uint32_t value = 0, slot = 0;
};
/// The same, appended to others; tells how many slots it needs.
std::uint32_t assemble(std::span<const Instruction> code, std::span<const ProgramOutput> outputs,
                       std::span<KeptValue> kept, std::vector<Step>&, std::vector<OutputSlot>&);

std::vector<ProgramOutput> outputs_of(const Program&);

/// How many values an operation takes.
inline int operands(Op op) {
    switch (op) {
        case Op::input:
            return 0;
        case Op::add:
        case Op::subtract:
        case Op::minimum:
        case Op::maximum:
        case Op::farther:
        case Op::smooth_minimum:
        case Op::guarded:
        case Op::corner:
            return 2;
        default:
            return 1;
    }
}
/// Whether an operation's result is a point and not a number.
bool gives_point(Op);

/// Whether an operation is a primitive whose equation is long (concepts.hpp).
bool is_long_primitive(Op);
/// Whether it is a neural field: Siren::Network.
bool is_network(Op);
/// Whether an operation is a fold of space, which jumps.
bool is_fold(Op);

/// Gradient of one component at a point, by dual numbers.
glm::vec3 gradient(const Routine&, std::uint32_t slots, const glm::vec3& p, Phase);

}  // namespace phasetree
