#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "phasetree/nodes/fields/formula.hpp"

namespace phasetree::nodes {

/// One operation of a formula, on values before it.
struct FormulaStep {
    formula::Op op{};
    std::uint32_t a = 0, b = 0, c = 0;
    double value = 0;        ///< of a constant; the radius of a smooth minimum
    std::size_t offset = 0;  ///< where in the text it stands, in bytes
};

/// How many values an operation takes.
int operands(formula::Op);

/// The formula as steps without duplicates, of which the last is the result; constants are computed, and roots of sums
/// of squares are lengths, whose slope is bounded where the root's is not. Throws TextError.
std::vector<FormulaStep> read_formula(const std::string& text);

}  // namespace phasetree::nodes
