#pragma once

#include "rewriting/specialise.hpp"

/// The sizes of the features of a program's primitives, and the work of their parts. They are used to judge boxes that
/// are larger than these features.
namespace phasetree::rewriting {

/// Whether a program has a grid of voxels (PatternDataPrimitive).
inline bool has_grid(const WorkingProgram& program) {
    return std::ranges::any_of(program.code, [](const Instruction& in) { return traits(in.op).is_voxel_grid; });
}

/// The size of the smallest features among a program's patterns, in the object's space: a pattern's period divided by
/// the slope of the map into the pattern's own space. Infinity if the program has no pattern.
float finest_pattern(const WorkingProgram&, std::span<const float> constants);

/// The smallest spacing between the parts of a program's primitives of parts (PrimitiveOfParts), in the object's space.
/// Infinity if it has no such primitive.
float finest_spacing(const WorkingProgram&, std::span<const float> constants);

/// The work, in simple instructions, of the specialised primitives that replace primitives of parts.
float work_of_parts(const WorkingProgram&, std::span<const Specialisation>);

}  // namespace phasetree::rewriting
