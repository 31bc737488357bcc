// The wavelengths of a path, and whether it has been dispersed (spectrum/wavelengths.hpp).
#pragma once

#include <optional>

#include "spectrum/wavelengths.hpp"

namespace phasetree::tracer {

class PathWavelengths {
  public:
    /// For an RGB path in a scene where nothing disperses.
    PathWavelengths() = default;
    /// For a path that is spectral or may be dispersed.
    explicit PathWavelengths(const Wavelengths& all) : all_(all) {}

    /// The wavelengths of the path: in use from the start if it is spectral, otherwise from dispersion on; null if it
    /// has none.
    const Wavelengths* all() const { return all_ ? &*all_ : nullptr; }
    /// The wavelengths to which the three numbers of the path belong; null if these are red, green and blue.
    const Wavelengths* now() const { return all_ && (is_dispersed_ || all_->is_spectral) ? &*all_ : nullptr; }

    bool is_dispersed() const { return is_dispersed_; }
    /// From here on, the path carries its hero wavelength only. Requires all().
    void disperse() { is_dispersed_ = true; }

  private:
    std::optional<Wavelengths> all_;
    bool is_dispersed_ = false;
};

}  // namespace phasetree::tracer
