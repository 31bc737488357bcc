// A spectrum that is measured or given in a scene file: points with linear interpolation, constant beyond the first and
// the last one.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "spectrum/wavelengths.hpp"

namespace phasetree::tracer {

class Spectrum {
  public:
    struct Point {
        float nanometres, value;
    };

    /// There must be at least one point. Wavelengths must be increasing.
    explicit Spectrum(std::vector<Point> points);

    float at(float nanometres) const;
    /// The mean over the nanometre around a wavelength, so that lines narrower than a nanometre count, too.
    double mean_around(double nanometres) const;
    /// The values at each of a path's wavelengths.
    glm::vec3 at(const Wavelengths& wavelengths) const;
    float greatest() const;
    /// Red, green and blue of D65 times the spectrum: the reflected colour, if it is a reflectance. Components are
    /// negative for colours outside of the gamut.
    const glm::vec3& colour() const { return colour_; }

  private:
    std::vector<Point> points_;
    glm::vec3 colour_;
};

using SharedSpectrum = std::shared_ptr<const Spectrum>;

}  // namespace phasetree::tracer
