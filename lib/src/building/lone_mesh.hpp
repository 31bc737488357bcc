#pragma once

#include <array>
#include <optional>

#include "phasetree/math/affine_map.hpp"
#include "rewriting/working_program.hpp"

/// Programs that are a single mesh. Two phases then meet exactly at the mesh's faces, so a ray finds the change of
/// phase by intersecting these, and evaluates no distance (trace/faces.hpp).
namespace phasetree::building {

using rewriting::Arena, rewriting::WorkingProgram;

/// The corners of a triangle, counterclockwise as seen from the first output's phase.
struct FaceCorners {
    std::array<glm::vec3, 3> corner;
};

/// A mesh under affine maps, and the sign of its distance, which alone separate two phases.
struct LoneMesh {
    const float* tree;             ///< a mesh::PieceTree
    AffineMap::Inverse to_object;  ///< from the mesh's space to the object's
    bool is_first_phase_outside;   ///< which of the outputs is the outside of the mesh
};
/// Recognises a program that is only that.
std::optional<LoneMesh> lone_mesh(const WorkingProgram&, std::span<const float> constants);

/// The faces that touch a box, in the object's space, and the smallest box around the parts of them that are in it.
struct FacesInBox {
    std::span<const FaceCorners> faces;
    Bounds box;
};
/// Finds the faces that touch a box. The result is allocated in the arena; nullopt if there are more than most_faces.
///
/// Vertices are rounded to floats after the map to the object's space, each in the same way for all faces around it. So
/// the mapped surface is as closed as the mesh's.
std::optional<FacesInBox> faces_in_box(const LoneMesh&, const Bounds&, Arena&);

}  // namespace phasetree::building
