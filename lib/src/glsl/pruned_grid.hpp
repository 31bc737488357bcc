#pragma once

#include <array>
#include <functional>
#include <vector>

#include "phasetree/math/bounds.hpp"
#include "phasetree/program/program.hpp"
#include "program/program_output.hpp"

namespace phasetree::glsl {

using program::ProgramOutput;

/// The part of a program that is left in a box.
struct BoxProgram {
    std::vector<Instruction> code;  ///< code[0] is the input point; constants are those of the whole program
    std::vector<ProgramOutput> outputs;
};

/// The bounds of an object, divided into equal boxes, each with the program that is left in it after pruning
/// (pruning/prune.hpp). Boxes with equal programs share one.
struct PrunedGrid {
    std::array<int, 3> boxes{1, 1, 1};
    Bounds bounds;
    std::vector<BoxProgram> programs;
    /// For each box, x fastest: the index of its program, or −1 − phase if it contains a single phase.
    std::vector<std::int32_t> content;

    glm::vec3 box_size() const {
        return (bounds.high - bounds.low) / glm::vec3(glm::ivec3(boxes[0], boxes[1], boxes[2]));
    }
};

/// Divides the bounds so that their longest side has about `along` boxes. Each program is valid up to `reach` beyond
/// its box. `program` is rewritten, which may append constants to it. `cancelled` is polled; if it returns true,
/// BuildCancelled is thrown.
PrunedGrid prune_on_grid(Program& program, const Bounds&, float reach, int along,
                         const std::function<bool()>& cancelled = {});

}  // namespace phasetree::glsl
