// A number for each wavelength, as it was measured or as a scene file gives it: points, between which it is linear, and
// beyond which it is what it is at the first and the last one.
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

    /// One point at least. Wavelengths rise from each to the next.
    explicit Spectrum(std::vector<Point> points);

    float at(float nanometres) const;
    /// Its mean over the nanometre around a wavelength, so that lines narrower than a nanometre count, too.
    double mean_around(double nanometres) const;
    /// At each of a path's wavelengths.
    glm::vec3 at(const Wavelengths& wavelengths) const;
    float greatest() const;
    /// Red, green and blue of white light, D65, times it: what is reflected, if it is a reflectance. Of colours that
    /// are beyond what red, green and blue can mix some are negative.
    const glm::vec3& colour() const { return colour_; }

  private:
    std::vector<Point> points_;
    glm::vec3 colour_;
};

using SharedSpectrum = std::shared_ptr<const Spectrum>;

}  // namespace phasetree::tracer
