// Tests that may take long run in a short form unless the environment requests the long form (tests/README.md).
#pragma once

#include <cstdlib>

namespace phasetree::tests {

/// Whether to run the long form of a test: many times the samples, for a run overnight.
inline bool long_tests() {
    return std::getenv("PHASETREE_LONG_TESTS") != nullptr;
}

}  // namespace phasetree::tests
