#pragma once

#include <vector>

#include "cells/linear_bound.hpp"
#include "cells/proof.hpp"
#include "cells/prune.hpp"

namespace phasetree {

/// Cells found so far, in order, with their programs.
struct Found {
    struct Cell {
        Bounds box;
        LinearBound bound;
        Curvature curvature;
        std::uint32_t first_instruction, instructions, leading, first_output, outputs, first_proof, proof_parts;
    };
    std::vector<Cell> cells;
    std::vector<Instruction> code;
    std::vector<ProgramOutput> outputs;
    std::vector<ProofPart> proofs;

    struct Mark {
        std::size_t cells, code, outputs, proofs;
    };
    Mark mark() const { return {cells.size(), code.size(), outputs.size(), proofs.size()}; }
    void forget_from(const Mark& m) {
        cells.resize(m.cells);
        code.resize(m.code);
        outputs.resize(m.outputs);
        proofs.resize(m.proofs);
    }
    void add(const Bounds& box, const LinearBound& bound, const Curvature& curvature, const WorkingProgram& program,
             std::uint32_t leading, std::span<const ProofPart> proof) {
        const Mark m = mark();
        append(code, program.code);
        append(outputs, program.outputs);
        append(proofs, proof);
        cells.push_back({box, bound, curvature, narrow(m.code), narrow(program.code.size()), leading, narrow(m.outputs),
                         narrow(program.outputs.size()), narrow(m.proofs), narrow(proof.size())});
    }
    void add(const Found& more) {
        const Mark m = mark();
        for (Cell c : more.cells) {
            c.first_instruction += narrow(m.code);
            c.first_output += narrow(m.outputs);
            c.first_proof += narrow(m.proofs);
            cells.push_back(c);
        }
        append(code, std::span(more.code));
        append(outputs, std::span(more.outputs));
        append(proofs, std::span(more.proofs));
    }
    static std::uint32_t narrow(std::size_t n) { return static_cast<std::uint32_t>(n); }

    std::span<const Instruction> code_of(const Cell& c) const {
        return std::span(code).subspan(c.first_instruction, c.instructions);
    }
    std::span<const ProgramOutput> outputs_of(const Cell& c) const {
        return std::span(outputs).subspan(c.first_output, c.outputs);
    }
    std::span<const ProofPart> proof_of(const Cell& c) const {
        return std::span(proofs).subspan(c.first_proof, c.proof_parts);
    }

  private:
    template <class T, class From>
    static void append(std::vector<T>& to, const From& from) {
        to.insert(to.end(), from.begin(), from.end());
    }
};

}  // namespace phasetree
