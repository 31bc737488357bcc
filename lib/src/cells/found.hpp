#pragma once

#include <vector>

#include "cells/linear_bound.hpp"
#include "cells/prune.hpp"

namespace phasetree {

/// Cells found so far, in order, with the routines that they need.
struct Found {
    struct Cell {
        Bounds box;
        LinearBound bound;
        Curvature curvature;
        std::uint32_t first_step, steps, leading, first_output, outputs, slots;
    };
    std::vector<Cell> cells;
    std::vector<Step> steps;
    std::vector<OutputSlot> outputs;

    struct Mark {
        std::size_t cells, steps, outputs;
    };
    Mark mark() const { return {cells.size(), steps.size(), outputs.size()}; }
    void forget_from(const Mark& m) {
        cells.resize(m.cells);
        steps.resize(m.steps);
        outputs.resize(m.outputs);
    }
    void add(const Bounds& box, const LinearBound& bound, const Curvature& curvature, const WorkingProgram& program,
             std::uint32_t leading) {
        const Mark m = mark();
        const std::uint32_t slots = assemble(program.code, program.outputs, steps, outputs);
        cells.push_back({box, bound, curvature, narrow(m.steps), narrow(steps.size() - m.steps), leading,
                         narrow(m.outputs), narrow(outputs.size() - m.outputs), slots});
    }
    void add(const Found& more) {
        const Mark m = mark();
        for (Cell c : more.cells) {
            c.first_step += narrow(m.steps);
            c.first_output += narrow(m.outputs);
            cells.push_back(c);
        }
        steps.insert(steps.end(), more.steps.begin(), more.steps.end());
        outputs.insert(outputs.end(), more.outputs.begin(), more.outputs.end());
    }
    static std::uint32_t narrow(std::size_t n) { return static_cast<std::uint32_t>(n); }
};

}  // namespace phasetree
