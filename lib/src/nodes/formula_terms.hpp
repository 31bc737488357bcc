// A formula as terms that minima, maxima and absolute values join: the terms become primitives, and what joins them
// instructions of a program.
#pragma once

#include <array>
#include <vector>

#include "nodes/formula_steps.hpp"

namespace phasetree::nodes {

/// A term as it is evaluated, and where its steps stand in the text.
struct TermSteps {
    /// As formula::run() reads it: the number of steps, the factor of the result (1 until the slope is known), and four
    /// floats for each step.
    std::vector<float> data;
    std::vector<FormulaStep> steps;

    /// Which coordinates it depends on.
    std::array<bool, 3> axes() const {
        std::array<bool, 3> all{};
        for (const FormulaStep& s : steps)
            if (s.op <= formula::Op::z) all[static_cast<std::size_t>(s.op)] = true;
        return all;
    }
};

struct FormulaTerms {
    std::vector<TermSteps> terms;
    std::vector<Formula::Part> parts;  ///< the last is the formula
};

/// Throws TextError where a term has too many operations.
FormulaTerms divided_into_terms(const std::vector<FormulaStep>& steps);

}  // namespace phasetree::nodes
