// Collects what one path finds, as it is traced, for the next guide.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "guiding/guide.hpp"

namespace phasetree::tracer {

class PathFindings {
  public:
    /// The path leaves a point of a surface in a direction that no delta lobe gave. `cosine_over_pdf` is the cosine
    /// there over the density of the direction, and `throughput` the luminance of the path's throughput with that
    /// direction. It is to be called before roulette: what roulette multiplies survivors by is part of the light that
    /// they find.
    void leave(const glm::vec3& point, Facing facing, const glm::vec3& direction, float cosine_over_pdf,
               float throughput) {
        if (count_ == points_.size() || !(throughput > 0.0f)) return;
        points_[count_++] = {{point, facing, direction, 0.0f}, cosine_over_pdf / throughput};
    }
    /// The path brings light of this luminance to the camera. It came by way of all points that the path has left.
    void add_light(float luminance) {
        for (std::size_t i = 0; i < count_; ++i) points_[i].finding.light += luminance * points_[i].per_luminance;
    }
    /// The path has ended. Appends what it found, and starts again.
    void take(std::vector<Finding>& findings) {
        for (std::size_t i = 0; i < count_; ++i)
            if (points_[i].finding.light > 0.0f && points_[i].finding.light < most_light)
                findings.push_back(points_[i].finding);
        count_ = 0;
    }

  private:
    // More light than this is infinite, or will be when it is added up.
    static constexpr float most_light = 1e30f;

    struct Point {
        Finding finding;
        float per_luminance = 0;
    };
    std::array<Point, 16> points_{};  // Later points of a longer path are left out.
    std::size_t count_ = 0;
};

}  // namespace phasetree::tracer
