// The functions that a formula may call. functions.cpp contains the list.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "nodes/formula/steps.hpp"

namespace phasetree::nodes {

struct FormulaFunction {
    std::string_view name;
    std::size_t least, most;  ///< number of arguments
    FormulaIndex (*apply)(FormulaSteps&, const std::vector<FormulaIndex>& arguments);
};

std::span<const FormulaFunction> formula_functions();

}  // namespace phasetree::nodes
