// Collects the samples of one path while it is traced, to train the next guide.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "guiding/guide.hpp"

namespace phasetree::tracer {

class PathGuideSamples {
  public:
    /// Reports that the path leaves a point of a surface in a direction that was not sampled from a delta lobe.
    /// `cosine_over_pdf` is the cosine there over the pdf of the direction, and `throughput` the luminance of the
    /// path's throughput including that direction. Call it before roulette: the factor for survivors is part of the
    /// light that they find.
    void leave(const glm::vec3& point, Facing facing, const glm::vec3& direction, float cosine_over_pdf,
               float throughput) {
        if (count_ == points_.size() || !(throughput > 0.0f)) return;
        points_[count_++] = {{point, facing, direction, 0.0f}, cosine_over_pdf / throughput};
    }
    /// Reports light of this luminance at the camera. It came through all points that the path has left.
    void add_light(float luminance) {
        for (std::size_t i = 0; i < count_; ++i) points_[i].sample.light += luminance * points_[i].per_luminance;
    }
    /// Ends the path: appends its samples, and resets this object.
    void take(std::vector<GuideSample>& samples) {
        for (std::size_t i = 0; i < count_; ++i)
            if (points_[i].sample.light > 0.0f && points_[i].sample.light < most_light)
                samples.push_back(points_[i].sample);
        count_ = 0;
    }

  private:
    // More light than this is infinite, or will be when summed.
    static constexpr float most_light = 1e30f;

    struct Point {
        GuideSample sample;
        float per_luminance = 0;
    };
    std::array<Point, 16> points_{};  // further points of a longer path are ignored
    std::size_t count_ = 0;
};

}  // namespace phasetree::tracer
