// Cells give the same labels as the whole program, with each kind of node at the root.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

#include "cells/traceable.hpp"
#include "phasetree/cells/cells.hpp"
#include "phasetree/model/handle.hpp"
#include "support/compared_labels.hpp"

namespace test_kinds {

using namespace phasetree;
using namespace phasetree::tests;

TEST_CASE("a cell's program gives the whole object's labels with each kind of node at the root") {
    const int trees = long_tests() ? 200 : 1;
    int number = 0;
    for (const NodeKind& kind : node_kinds()) {
        ++number;
        Random rng = random_for(8, kind);
        CAPTURE(kind.name);
        std::size_t points = 0;
        for (int i = 0, attempt = 0; i < trees && attempt < 50 * trees; ++attempt) {
            CAPTURE(i);
            const Phased object = cut_to_size(kind.object(rng, 2 + (i + number) % 3));
            // Some draws are empty.
            if (bounds(object).empty()) continue;
            const InterfaceCells cells(object);
            if (cells.size() == 0) continue;
            ++i;
            const Disagreements d = compare_labels(cells, 8);
            REQUIRE(d.wrong == 0);
            points += d.points;
        }
        CHECK(points > 50);
    }
}

}  // namespace test_kinds
