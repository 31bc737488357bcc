// What `solve` prints.
#pragma once

#include <optional>
#include <string>

#include "command/quantity.hpp"
#include "phasetree/measuring/solve.hpp"

namespace phasetree::tracer {

struct SolveReport {
    std::string scene;
    std::string pointer;
    const Quantity& quantity;
    const SolveResult& result;
    std::optional<double> seconds{};  // the time at which an animated scene was measured
};

void print_solution(const SolveReport&);
void print_solution_json(const SolveReport&);

// An interval in the quantity's unit, as in "from 329.8 to 330.1 ml".
std::string interval_text(const Measured&, const Quantity&);

}  // namespace phasetree::tracer
