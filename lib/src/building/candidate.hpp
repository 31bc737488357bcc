#pragma once

#include <optional>

#include "building/build_context.hpp"
#include "building/cost_model.hpp"
#include "building/lone_mesh.hpp"
#include "building/subdivision_policy.hpp"
#include "building/worker_pool.hpp"

namespace phasetree::building {

using rewriting::RequiredOfLocal, rewriting::Specialisation;

/// A cell that a box could become.
struct Candidate {
    WorkingProgram program;
    CellFacts facts{};  ///< its box encloses the interfaces, and may be smaller than the node's box
    std::span<const CertificateStep> certificate{};
    std::span<const Specialisation> specialisations{};
    Work work{};
    float cost = 0;
    /// Whether each sample is a search among many parts (PrimitiveOfParts). This is so if too many parts matter in the
    /// box, and the box is so large that fewer will matter in smaller ones.
    bool is_searched = false;
    /// The work of its lists of balls or of mesh pieces (PrimitiveOfParts), if that is a large part of its work and
    /// none of them is searched; otherwise 0.
    float work_of_parts = 0;
    /// If the program is a single mesh (lone_mesh.hpp), the faces that touch the box; empty if there are too many. Rays
    /// then intersect these, and the program is not specialised.
    std::span<const FaceCorners> faces{};
};

/// A box of the recursive subdivision, with the part of the object's program that is left in it.
struct BuildNode {
    Bounds box;
    WorkingProgram program;
    std::span<const Specialisation> specialisations{};  ///< in this box; before prepare(), in the parent's box
    std::span<const RequiredOfLocal> required{};        ///< of local primitives, in this box
    int depth = 0;
    /// The number of consecutive divisions without a gain. The count restarts at a box that is always divided.
    int futile_divisions = 0;
    SubdivisionPolicy policy{};
    /// The cost of the cells here, divided by that of the ancestor since which no division has saved a fifth.
    float cost_ratio = 1;
    float fold_period = Bounds::infinity;     ///< the smallest period of the folds that may still jump: finest_jump()
    float pattern_period = Bounds::infinity;  ///< the size of the smallest features of patterns: finest_pattern()
    /// The result of a trial for boxes as small as a pattern's features, made here or for an ancestor; nothing without
    /// a trial.
    std::optional<bool> is_small_cheaper{};
    double share = 1;  ///< approximate share of this box's subdivision in the whole build
    Candidate cell{};  ///< the cell that the box becomes if it is not divided
};

/// Prunes a node's program in its box, cuts the box to the interfaces, and finds the cell that it could become. False
/// if no ray can meet an interface there. Results are allocated in the worker's arena of programs.
bool prepare(BuildNode&, const BuildContext&, Worker&);

}  // namespace phasetree::building
