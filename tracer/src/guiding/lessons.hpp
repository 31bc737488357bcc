// What one path finds out for a guide, as it is traced.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "guiding/guide.hpp"

namespace phasetree::tracer {

class PathLessons {
  public:
    /// The path leaves a place on a surface, by no delta lobe. `cosine_over_pdf` is the cosine there over the density
    /// of the direction, and `throughput` the luminance of the path's throughput with that direction.
    void leave(const glm::vec3& position, Facing facing, const glm::vec3& direction, float cosine_over_pdf,
               float throughput) {
        if (count_ == places_.size() || !(throughput > 0.0f)) return;
        places_[count_++] = {{position, facing, direction, 0.0f}, cosine_over_pdf / throughput};
    }
    /// The path brings light of this luminance to the camera, which came by all places that it has left.
    void add_light(float luminance) {
        for (std::size_t i = 0; i < count_; ++i) places_[i].finding.light += luminance * places_[i].per_luminance;
    }
    /// The path has ended. Appends what was found, and begins anew.
    void finish(std::vector<Finding>& findings) {
        for (std::size_t i = 0; i < count_; ++i)
            if (places_[i].finding.light > 0.0f && places_[i].finding.light < most_light)
                findings.push_back(places_[i].finding);
        count_ = 0;
    }

  private:
    // What is more has overflowed, or soon will.
    static constexpr float most_light = 1e30f;

    struct Place {
        Finding finding;
        float per_luminance = 0;
    };
    std::array<Place, 16> places_{};  // later places of long paths tell nothing
    std::size_t count_ = 0;
};

}  // namespace phasetree::tracer
