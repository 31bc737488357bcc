// The distribution of a luminaire from an IES photometric file (ANSI/IES LM-63: 1986, 1991, 1995, 2002, 2019).
//
// Reads files of type C, which nearly all luminaires use: candelas by the angle from straight down and by planes around
// the vertical. A file may omit planes that follow by symmetry: a single plane stands for all, planes from 0° to 90°
// for every quadrant, and planes from 0° to 180° for both halves. Candelas are interpolated linearly in both angles,
// and are 0 beyond the file's vertical angles.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace phasetree::tracer {

class IesProfile {
  public:
    /// Throws std::runtime_error, whose what() gives the line and the problem, if the text is not such a file.
    explicit IesProfile(std::string_view text);

    /// The candelas at an angle in [0, 180] degrees from straight down, and at any angle around the vertical, as a
    /// share of the greatest in the file.
    float relative_intensity(double vertical_degrees, double horizontal_degrees) const;
    double greatest_candelas() const { return greatest_; }

  private:
    double symmetric(double horizontal_degrees) const;

    std::vector<double> vertical_, horizontal_;  ///< degrees, increasing
    std::vector<double> candelas_;               ///< [plane · vertical angles + vertical angle]
    double greatest_ = 0.0;
};

}  // namespace phasetree::tracer
