#pragma once

#include "phasetree/building/options.hpp"

namespace phasetree::building {

/// What required_saving() asks of a box.
struct BoxKind {
    float relative_size;  ///< the box's diagonal over the object's
    bool has_more_than_two_phases;
    bool is_first_curvature_known;  ///< whether Curvature::bound[0] is known
};

/// The share of the least cost of a box (cost_model.hpp) that its division must be able to save. Small boxes must save
/// more: along an interface there are as many of them as the inverse square of their size, all of them are built, and
/// few rays meet any single one. How fast the share grows was measured (benchmarks/experiments.md): faster where more
/// than two phases meet, and fastest if the first one's distance is well known there, because then mostly rays in the
/// other phases would gain, of which there are fewer than the cost model assumes.
float required_saving(BuildQuality, const BoxKind&);

}  // namespace phasetree::building
