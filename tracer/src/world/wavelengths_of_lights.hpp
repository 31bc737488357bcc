// The distribution of wavelengths of a scene's paths, adapted to its lights.
//
// Half of the wavelengths are chosen as for D65, and half in proportion to the mean spectrum of all lights. In the
// mean, each light has the same weight, however bright it is; a light without a spectrum counts as D65. So if a scene's
// only lamp has narrow bands, more than half of the paths see light. No wavelength is chosen less than half as often as
// without adaptation, so no sample has more than twice its weight.
#pragma once

#include "scene/scene.hpp"
#include "spectrum/wavelength.hpp"

namespace phasetree::tracer {

WavelengthDistribution wavelengths_of_lights(const Scene& scene);

}  // namespace phasetree::tracer
