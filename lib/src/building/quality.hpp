#pragma once

#include "phasetree/building/options.hpp"

namespace phasetree::building {

/// The properties of a box that required_saving() depends on.
struct BoxKind {
    float relative_size;  ///< the box's diagonal divided by the object's
    bool has_more_than_two_phases;
    bool is_first_curvature_known;  ///< whether Curvature::bound[0] is known
};

/// The fraction of a box's least cost (cost_model.hpp) that its division must be able to save. Small boxes must save
/// more: their number along an interface grows with the inverse square of their size, all of them are built, and few
/// rays meet any single one.
///
/// How fast the fraction grows was measured (benchmarks/experiments.md). It grows faster where more than two phases
/// meet, and fastest if the first one's distance is well known there. In that case mostly rays in the other phases
/// would gain, of which there are fewer than the cost model assumes.
float required_saving(BuildQuality, const BoxKind&);

}  // namespace phasetree::building
