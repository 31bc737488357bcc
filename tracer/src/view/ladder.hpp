// The first pictures after a change: small ones, of a sample a pixel, each a few times as large as the one before, so
// that something is seen at once and the whole picture soon.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace phasetree::tracer::view {

class Ladder {
  public:
    /// How many times coarser along a side than the whole picture each picture is, the coarsest first, 1 last.
    std::vector<int> scales(const glm::ivec2& resolution) const {
        const double pixels = static_cast<double>(resolution.x) * resolution.y;
        int coarsest = 1;
        while (coarsest < most && pixels / (coarsest * coarsest) > most_seconds * pixels_a_second_) coarsest *= 2;
        std::vector<int> result;
        for (int scale = coarsest; scale > 1; scale /= 4) result.push_back(scale);
        result.push_back(1);
        return result;
    }
    /// Learns how fast pictures are.
    void learn(std::uint64_t pixels, double seconds) {
        if (pixels > 0) pixels_a_second_ = static_cast<double>(pixels) / std::max(seconds, 1e-4);
    }

  private:
    static constexpr int most = 32;
    static constexpr double most_seconds = 0.06;  // for the first

    double pixels_a_second_ = 100'000;  // of a slow scene, until it is known better
};

/// The size of a picture that is this many times coarser.
inline glm::ivec2 coarser(const glm::ivec2& resolution, int scale) {
    return {std::max(1, resolution.x / scale), std::max(1, resolution.y / scale)};
}

}  // namespace phasetree::tracer::view
