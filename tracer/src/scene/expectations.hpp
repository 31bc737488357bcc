// What a scene file expects of its object: statements that `phasetree check --prove` proves or refutes.
#pragma once

#include <string>
#include <vector>

#include "scene/expectation_kinds.hpp"

namespace phasetree::tracer {

struct Expectation : MadeStatement {
    std::string text;        // as it is written in the file
    std::size_t offset = 0;  // of its text, in bytes
};

// Reads "expect". Throws SceneError for statements that are malformed or name unknown phases.
std::vector<Expectation> read_expectations(const Document&, const ExpectationContext&);

}  // namespace phasetree::tracer
