// How a luminaire spreads its light, as a photometric file of the IES tells it (ANSI/IES LM-63: 1986, 1991, 1995, 2002,
// 2019).
//
// Files of type C are understood, those of nearly all luminaires: candelas for angles from straight down, and planes
// about the vertical. A file may leave out planes that are like others: one plane is for all, planes to 90° are for
// each quarter, and planes to 180° for each half. Between the file's angles candelas are interpolated linearly in both,
// and beyond its vertical angles it is dark.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace phasetree::tracer {

class IesProfile {
  public:
    /// Throws std::runtime_error, whose what() says the line and what is wrong there, for a text that is no such file.
    explicit IesProfile(std::string_view text);

    /// The candelas at an angle in [0, 180] degrees from straight down, and at any angle about the vertical, as a share
    /// of the greatest in the file.
    float relative_intensity(double vertical_degrees, double horizontal_degrees) const;
    double greatest_candelas() const { return greatest_; }

  private:
    double symmetric(double horizontal_degrees) const;

    std::vector<double> vertical_, horizontal_;  ///< degrees, increasing
    std::vector<double> candelas_;               ///< [plane · vertical angles + vertical angle]
    double greatest_ = 0.0;
};

}  // namespace phasetree::tracer
