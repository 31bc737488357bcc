#pragma once

/// Interval arithmetic with gradients and curvature: a number type as the others (number.hpp).

#include "enclosure/functions.hpp"    // IWYU pragma: export
#include "enclosure/length.hpp"       // IWYU pragma: export
#include "enclosure/number.hpp"       // IWYU pragma: export
#include "enclosure/range.hpp"        // IWYU pragma: export
#include "enclosure/value_noise.hpp"  // IWYU pragma: export
