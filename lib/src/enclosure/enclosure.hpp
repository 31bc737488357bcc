// Interval arithmetic with gradients and curvatures: a number type like those of phasetree/math/number.hpp.
#pragma once

#include "enclosure/elementary.hpp"   // IWYU pragma: export
#include "enclosure/functions.hpp"    // IWYU pragma: export
#include "enclosure/interval.hpp"     // IWYU pragma: export
#include "enclosure/length.hpp"       // IWYU pragma: export
#include "enclosure/number.hpp"       // IWYU pragma: export
#include "enclosure/value_noise.hpp"  // IWYU pragma: export
