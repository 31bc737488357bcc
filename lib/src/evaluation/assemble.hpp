#pragma once

#include <array>

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
    std::vector<std::uint32_t> data;  ///< for each step where its constants are
    std::vector<OutputSlot> outputs;
    std::uint32_t slots = 0;

    Routine routine(const float* constants) const {
        return {steps.data(), data.data(), constants, steps.size(), outputs.data(), outputs.size()};
    }
};

/// A value that is read after the program has run, though it is no output, and where it is then found.
struct KeptValue {
    std::uint32_t value = 0, slot = 0;
};
/// Values whose last use is past give their register to later ones.
Assembly assemble(std::span<const Instruction> code, std::span<const ProgramOutput> outputs,
                  std::span<KeptValue> kept = {});

std::vector<ProgramOutput> outputs_of(const Program&);

/// What is known of an operation.
struct OpTraits {
    std::uint8_t operands = 1;       ///< how many values it takes
    std::uint16_t half_works = 2;    ///< how much work it is, in halves of a simple one
    bool gives_point = false;        ///< its result is a point and not a number
    bool is_long_primitive = false;  ///< a primitive whose equation is long (concepts.hpp)
    bool is_network = false;         ///< a neural field: Siren::Network
    bool is_fold = false;            ///< a fold of space, which jumps
    bool is_pattern = false;         ///< a PatternPrimitive
    bool is_local = false;           ///< a LocalPrimitive
    bool is_near = false;            ///< and what it becomes in a small box
};
/// Of every operation, those of fused.hpp too.
inline constexpr std::size_t most_operations = 256;
extern const std::array<OpTraits, most_operations> op_traits;

inline const OpTraits& traits(Op op) {
    return op_traits[static_cast<std::size_t>(op)];
}
inline int operands(Op op) {
    return traits(op).operands;
}
inline bool gives_point(Op op) {
    return traits(op).gives_point;
}
inline bool is_long_primitive(Op op) {
    return traits(op).is_long_primitive;
}
inline bool is_fold(Op op) {
    return traits(op).is_fold;
}

/// A component's value at a point, and its gradient.
struct Component {
    float value = 0;
    glm::vec3 gradient{0};
};
/// By dual numbers; zero if the phase is absent.
Component component(const Routine&, std::uint32_t slots, const glm::vec3& p, Phase);

}  // namespace phasetree
