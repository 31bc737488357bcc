// Tests that may take long run in a bounded form unless the environment asks for the long one (tests/README.md).
#pragma once

#include <cstdlib>

namespace phasetree::tests {

/// The long form of a test: many times the samples, for a run over night.
inline bool long_tests() {
    return std::getenv("PHASETREE_LONG_TESTS") != nullptr;
}

}  // namespace phasetree::tests
