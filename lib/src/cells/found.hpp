#pragma once

#include <vector>

#include "cells/linear_bound.hpp"
#include "cells/proof.hpp"
#include "cells/prune.hpp"

namespace phasetree {

/// Cells found so far, in order, with the routines that they need.
struct Found {
    struct Cell {
        Bounds box;
        LinearBound bound;
        Curvature curvature;
        std::uint32_t first_step, steps, leading, first_output, outputs, slots, first_proof,
            proof_steps;
    };
    std::vector<Cell> cells;
    std::vector<Step> steps;
    std::vector<OutputSlot> outputs;
    std::vector<ProofStep> proofs;

    struct Mark {
        std::size_t cells, steps, outputs, proofs;
    };
    Mark mark() const { return {cells.size(), steps.size(), outputs.size(), proofs.size()}; }
    void forget_from(const Mark& m) {
        cells.resize(m.cells);
        steps.resize(m.steps);
        outputs.resize(m.outputs);
        proofs.resize(m.proofs);
    }
    void add(const Bounds& box, const LinearBound& bound, const Curvature& curvature, const WorkingProgram& program,
             std::uint32_t leading, std::span<const ProofPart> proof) {
        const Mark m = mark();
        std::array<KeptValue, most_proof_steps> kept;
        for (std::size_t i = 0; i < proof.size(); ++i) kept[i].value = proof[i].value;
        const std::uint32_t slots =
            assemble(program.code, program.outputs, std::span(kept).first(proof.size()), steps, outputs);
        for (std::size_t i = 0; i < proof.size(); ++i) proofs.push_back(proof[i].step(kept[i].slot));
        cells.push_back({box, bound, curvature, narrow(m.steps), narrow(steps.size() - m.steps), leading,
                         narrow(m.outputs), narrow(outputs.size() - m.outputs), slots, narrow(m.proofs),
                         narrow(proof.size())});
    }
    void add(const Found& more) {
        const Mark m = mark();
        for (Cell c : more.cells) {
            c.first_step += narrow(m.steps);
            c.first_output += narrow(m.outputs);
            c.first_proof += narrow(m.proofs);
            cells.push_back(c);
        }
        steps.insert(steps.end(), more.steps.begin(), more.steps.end());
        outputs.insert(outputs.end(), more.outputs.begin(), more.outputs.end());
        proofs.insert(proofs.end(), more.proofs.begin(), more.proofs.end());
    }
    static std::uint32_t narrow(std::size_t n) { return static_cast<std::uint32_t>(n); }
};

}  // namespace phasetree
