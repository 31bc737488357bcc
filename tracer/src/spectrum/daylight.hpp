// CIE's illuminant D65: noon daylight, the white of Rec.709's screens.
#pragma once

namespace phasetree::tracer {

/// In proportion to power per nanometre, at a wavelength in nanometres: 100 at 560 nm.
double daylight_at(double wavelength);

}  // namespace phasetree::tracer
