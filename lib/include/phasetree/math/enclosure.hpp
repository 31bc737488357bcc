#pragma once

/// Interval arithmetic with gradients and curvature: a number type as the others (number.hpp).

#include "phasetree/math/enclosure/functions.hpp"    // IWYU pragma: export
#include "phasetree/math/enclosure/length.hpp"       // IWYU pragma: export
#include "phasetree/math/enclosure/number.hpp"       // IWYU pragma: export
#include "phasetree/math/enclosure/range.hpp"        // IWYU pragma: export
#include "phasetree/math/enclosure/value_noise.hpp"  // IWYU pragma: export
