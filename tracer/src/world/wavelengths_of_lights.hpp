// Which wavelengths paths of a scene are to have: those at which its lights shine.
//
// Half of the wavelengths are chosen as for light of D65, and half in proportion to the mean spectrum of all lights, of
// which each counts alike, however bright it is; a light without a spectrum is of D65. So of a scene's only lamp, with
// narrow bands, more than half of the paths see light; and no wavelength is chosen less than half as often as it would
// be without, so no sample weighs more than twice what it would.
#pragma once

#include "scene/scene.hpp"
#include "spectrum/wavelength.hpp"

namespace phasetree::tracer {

WavelengthDistribution wavelengths_of_lights(const Scene& scene);

}  // namespace phasetree::tracer
