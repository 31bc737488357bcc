// A formula as terms joined by minima, maxima and absolute values. The terms become primitives, and the joining
// operations become instructions of a program.
#pragma once

#include <array>
#include <vector>

#include "nodes/formula/steps.hpp"

namespace phasetree::nodes {

/// A term in the form that is evaluated, and its steps with their positions in the text.
struct TermSteps {
    /// In the format of formula::run(): the number of steps, the factor of the result (1 until the slope is known), and
    /// four floats per step.
    std::vector<float> data;
    std::vector<FormulaStep> steps;

    /// The coordinates on which it depends.
    std::array<bool, 3> axes() const {
        std::array<bool, 3> all{};
        for (const FormulaStep& s : steps)
            if (s.op <= formula::Op::z) all[static_cast<std::size_t>(s.op)] = true;
        return all;
    }
};

struct FormulaTerms {
    std::vector<TermSteps> terms;
    std::vector<Formula::Part> parts;  ///< the last one is the whole formula
};

/// Throws TextError if a term has too many operations.
FormulaTerms divided_into_terms(const std::vector<FormulaStep>& steps);

}  // namespace phasetree::nodes
