// Which wavelengths paths of a scene are to have: those at which its lights shine.
//
// Wavelengths are chosen half as for light of D65, and half in proportion to the mean spectrum of all lights, of which
// each counts alike; a light without a spectrum is of D65. So of a lamp with narrow bands more than half of the paths
// see light, and no wavelength is chosen less than half as often as it would be without.
#pragma once

#include "scene/scene.hpp"
#include "spectrum/wavelength.hpp"

namespace phasetree::tracer {

WavelengthDistribution wavelengths_of_lights(const Scene& scene);

}  // namespace phasetree::tracer
