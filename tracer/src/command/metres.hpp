// Measures of a scene in metres.
#pragma once

#include "phasetree/measuring/areas.hpp"
#include "phasetree/measuring/measure.hpp"
#include "scene/length_unit.hpp"

namespace phasetree::tracer {

// Converts measures from this unit of length to metres. Densities were in kg/m³, so masses become kilograms. Intervals
// stay certain: they are widened by the rounding errors of the conversion.
void convert_to_metres(MeasureResult&, AreaResult&, const LengthUnit&);

// The same for one number, which is multiplied by a factor whose relative error is at most 10⁻¹⁵.
Measured scaled(const Measured&, double factor);

}  // namespace phasetree::tracer
