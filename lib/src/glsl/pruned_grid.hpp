#pragma once

#include <array>
#include <functional>
#include <vector>

#include "phasetree/math/bounds.hpp"
#include "phasetree/program/program.hpp"
#include "program/program_output.hpp"

namespace phasetree::glsl {

using program::ProgramOutput;

/// What is left of a program in a box.
struct BoxProgram {
    std::vector<Instruction> code;  ///< code[0] is the input point; its constants are those of the whole program
    std::vector<ProgramOutput> outputs;
};

/// The bounds of an object, divided into equal boxes, with the program that is left in each of them after pruning
/// (pruning/prune.hpp). Boxes in which the same is left share a program.
struct PrunedGrid {
    std::array<int, 3> boxes{1, 1, 1};
    Bounds bounds;
    std::vector<BoxProgram> programs;
    /// For each box, x fastest, the index of its program; or −1 − phase where there is but one phase.
    std::vector<std::int32_t> content;

    glm::vec3 box_size() const {
        return (bounds.high - bounds.low) / glm::vec3(glm::ivec3(boxes[0], boxes[1], boxes[2]));
    }
};

/// Divides the bounds so that their longest side has about `along` boxes. The programs are right up to `reach` beyond
/// their boxes. `program` is rewritten, which may append constants to it. `cancelled` is polled; where it
/// says so, BuildCancelled is thrown.
PrunedGrid prune_on_grid(Program& program, const Bounds&, float reach, int along,
                         const std::function<bool()>& cancelled = {});

}  // namespace phasetree::glsl
