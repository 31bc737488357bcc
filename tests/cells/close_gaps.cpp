// Cells of an object whose gaps are closed, against the object.
#include "phasetree/nodes/phased/close_gaps.hpp"

#include <doctest/doctest.h>

#include "phasetree/cells/cells.hpp"
#include "support/compared_crossings.hpp"
#include "support/compared_labels.hpp"
#include "support/glass_of_water.hpp"

namespace test_close_gaps {

using namespace phasetree;
using namespace phasetree::tests;
using namespace phasetree::tests::glass_of_water;

TEST_CASE("cells of a glass of water whose gap is closed have its labels, and rays meet the same interfaces in them") {
    Random rng(705);
    const std::size_t cells_of_exact = InterfaceCells(exact()).size();
    for (const float larger_by : {excess, 0.f, -excess}) {
        CAPTURE(larger_by);
        const Phased object = closed(filled(hollow(), water_larger_by(larger_by)));
        const InterfaceCells cells(object);
        const Disagreements found = compare_labels(cells, 64);
        CHECK(found.points > 10'000);
        CHECK(found.wrong == 0);
        Compared all;
        compare_crossings(object, {}, 500, rng, all);
        CHECK(all.crossings > all.rays);
        CHECK(all.different == 0);
        MESSAGE(cells.size(), " cells; ", cells_of_exact, " of the exact tree; ",
                cells.statistics().median_instructions, " instructions in the median, ",
                cells.statistics().max_instructions, " at most");
    }
}

}  // namespace test_close_gaps
