#pragma once

#include <string>
#include <vector>

#include "nodes/formula/steps.hpp"

namespace phasetree::nodes {

/// Parses a formula into steps without duplicates, the last of which is the result (FormulaSteps). Throws TextError.
std::vector<FormulaStep> read_formula(const std::string& text);

}  // namespace phasetree::nodes
