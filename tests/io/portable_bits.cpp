// Results of code in the library that depend on how it was compiled, if the compiler drops the rounding of a double to
// a float (lib/cmake/compile_options.cmake).
#include <doctest/doctest.h>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/io/document.hpp"
#include "phasetree/io/tree.hpp"
#include "phasetree/math/float_mode.hpp"

namespace test_portable_bits {

using namespace phasetree;

TEST_CASE("the distance to a Bezier curve has the bits of all compilers and processors") {
    const FlushSubnormals flush;
    const Phased object = read_tree(Document::from_text(R"({"version": 1, "phases": {"ink": {"diffuse": {}}},
            "tree": {"set": {"phase": "ink", "of": {"extrude": {"height": 1, "of": {"bezier":
                {"points": [[0.1, 0.1], [0.5, 0.1], [0.6, 0.9], [0.3, 0.4]]}}}}}}})",
                                                        "test.json"))
                              .object;
    const Evaluator evaluator(record(object));
    Evaluator::Workspace workspace;
    const auto distance = [&](float x, float y) { return evaluator.distances({x, y, 0}, workspace)[1]; };
    // Computed by programs for x86-64 and arm64, compiled by GCC 12 with -O0 to -O2. Clang 14 gives the same at -O3.
    CHECK(distance(0x1.1f0e6ap-1f, 0x1.7537e6p-1f) == -0x1.9cd864p-7f);
    CHECK(distance(0x1.8c5cdcp-2f, 0x1.5e447p-2f) == -0x1.bc7656p-5f);
}

}  // namespace test_portable_bits
