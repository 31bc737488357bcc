// CIE illuminant D65: noon daylight, and the white of Rec.709.
#pragma once

namespace phasetree::tracer {

/// Relative power per nanometre, at a wavelength in nanometres: 100 at 560 nm.
double daylight_at(double wavelength);

}  // namespace phasetree::tracer
