#pragma once

#include <optional>

#include "building/build_context.hpp"
#include "building/cost_model.hpp"
#include "building/subdivision_policy.hpp"
#include "building/worker_pool.hpp"

namespace phasetree::building {

using rewriting::RequiredOfLocal, rewriting::Specialisation;

/// A cell that a box could become.
struct Candidate {
    WorkingProgram program;
    CellFacts facts{};  ///< its box is around the interfaces, and may be smaller than the one it was made for
    std::span<const CertificateStep> certificate{};
    std::span<const Specialisation> specialisations{};
    Work work{};
    float cost = 0;
    /// Whether each sample in it is a search among many parts (PrimitiveOfParts), because too many matter in the box,
    /// and the box is so large that few will in smaller ones.
    bool is_searched = false;
    /// The work of its lists of balls or of pieces of a mesh (PrimitiveOfParts), if that is much of all its work and
    /// none of them is searched; else 0.
    float work_of_parts = 0;
};

/// A box of the recursive subdivision, with what is left of the object's program in it.
struct BuildNode {
    Bounds box;
    WorkingProgram program;
    std::span<const Specialisation> specialisations{};  ///< in this box; until prepare(), in the box around it
    std::span<const RequiredOfLocal> required{};        ///< of local primitives, in this box
    int depth = 0;
    /// How many divisions in a row have had no gain. The count starts again at a box that is divided in any case.
    int futile_divisions = 0;
    SubdivisionPolicy policy{};
    /// The cost of the cells here divided by that of the box around it from which on no division has saved a fifth.
    float cost_ratio = 1;
    float fold_period = Bounds::infinity;     ///< the smallest period of the folds that still may jump: finest_jump()
    float pattern_period = Bounds::infinity;  ///< the size of the smallest features of patterns: finest_pattern()
    /// What a trial has found of boxes as small as that, here or in a box around this one; nothing without a trial.
    std::optional<bool> is_small_cheaper{};
    double share = 1;  ///< about how much of the whole build the subdivision of this box is
    Candidate cell{};  ///< what the box becomes if it is not divided
};

/// Prunes a node's program in its box, cuts the box to the interfaces, and finds the cell that it could become. False
/// if no ray can meet an interface there. What is kept is in the worker's arena of programs.
bool prepare(BuildNode&, const BuildContext&, Worker&);

}  // namespace phasetree::building
