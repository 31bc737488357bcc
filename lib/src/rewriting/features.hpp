#pragma once

#include "rewriting/specialise.hpp"

/// How large the features are that a program's primitives have, and how much work their parts are: by which boxes are
/// judged that are larger than these.
namespace phasetree::rewriting {

/// Whether a program has a grid of voxels (PatternDataPrimitive).
inline bool has_grid(const WorkingProgram& program) {
    return std::ranges::any_of(program.code, [](const Instruction& in) { return traits(in.op).is_voxel_grid; });
}

/// The size of the smallest features among a program's patterns, in the object's space: a pattern's period is divided
/// by the slope of the map into the pattern's own space. Infinity if the program has no pattern.
float finest_pattern(const WorkingProgram&, std::span<const float> constants);

/// How far apart the parts of a program's primitives of parts are at least, in the object's space (PrimitiveOfParts).
/// Infinity if it has no such primitive.
float finest_spacing(const WorkingProgram&, std::span<const float> constants);

/// How much work those specialised primitives are that stand for primitives of parts, in simple instructions.
float work_of_parts(const WorkingProgram&, std::span<const Specialisation>);

}  // namespace phasetree::rewriting
