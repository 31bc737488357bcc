// The first pictures after a change: small ones with one sample per pixel, each several times larger than the previous
// one, so that something is visible at once and the whole picture soon.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace phasetree::tracer::view {

class Ladder {
  public:
    /// For each picture, how many times coarser it is per side than the whole picture, from the coarsest to 1. The
    /// first one is meant to be complete `goal` seconds after the change, of which `elapsed` have passed.
    std::vector<int> scales(const glm::ivec2& resolution, double elapsed) const {
        const double pixels = static_cast<double>(resolution.x) * resolution.y;
        const double affordable = std::max(least_seconds, goal - elapsed) * pixels_a_second_;
        const int coarsest = static_cast<int>(std::clamp(std::ceil(std::sqrt(pixels / affordable)), 1.0, most));
        std::vector<int> result;
        for (int scale = coarsest; scale > 1; scale /= 4) result.push_back(scale);
        result.push_back(1);
        return result;
    }
    /// Updates the estimated speed.
    void learn(std::uint64_t pixels, double seconds) {
        if (pixels > 0) pixels_a_second_ = static_cast<double>(pixels) / std::max(seconds, 1e-4);
    }

  private:
    static constexpr double most = 32;
    static constexpr double goal = 0.05;
    static constexpr double least_seconds = 0.02;  // so that something can be recognised

    double pixels_a_second_ = 100'000;  // that of a slow scene, until measured
};

/// The size of a picture that is `scale` times coarser.
inline glm::ivec2 coarser(const glm::ivec2& resolution, int scale) {
    return {std::max(1, resolution.x / scale), std::max(1, resolution.y / scale)};
}

}  // namespace phasetree::tracer::view
