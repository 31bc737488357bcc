#pragma once

#include <string>
#include <vector>

#include "nodes/formula_steps.hpp"

namespace phasetree::nodes {

/// The formula as steps without duplicates, of which the last is the result (FormulaSteps). Throws TextError.
std::vector<FormulaStep> read_formula(const std::string& text);

}  // namespace phasetree::nodes
