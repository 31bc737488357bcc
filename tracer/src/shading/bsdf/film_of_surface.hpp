// The ranges of film thickness and roughness with which a surface is made. Both may vary over the surface.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace phasetree::tracer {

/// The range of a parameter over a surface.
struct ValueRange {
    float least = 0.0f, greatest = 0.0f;

    float middle() const { return 0.5f * (least + greatest); }
    bool operator==(const ValueRange&) const = default;
};

/// The roughnesses of the tables for a range. The loss at an angle depends on the ratio of roughness and cosine, so
/// nodes are denser for small roughness: they are equidistant in the eighth root.
class RoughnessNodes {
  public:
    explicit RoughnessNodes(const ValueRange& range) : first_(root(range.least)), step_(root(range.greatest) - first_) {
        constexpr float widest_step = 1.0f / 80.0f;
        intervals_ = step_ > 0.0f ? static_cast<std::size_t>(std::ceil(step_ / widest_step)) : 0;
        if (intervals_ > 0) step_ /= static_cast<float>(intervals_);
    }

    std::size_t size() const { return intervals_ + 1; }
    float roughness(std::size_t i) const {
        const float r = first_ + step_ * static_cast<float>(i);
        const float r2 = r * r;
        return (r2 * r2) * (r2 * r2);
    }
    /// The node below, and the fraction towards the next; there is a next node unless there is only one.
    struct Place {
        std::size_t below;
        float part;
    };
    Place place(float roughness) const {
        if (intervals_ == 0) return {0, 0.0f};
        const float at = std::clamp((root(roughness) - first_) / step_, 0.0f, static_cast<float>(intervals_));
        const std::size_t below = std::min(static_cast<std::size_t>(at), intervals_ - 1);
        return {below, at - static_cast<float>(below)};
    }

  private:
    static float root(float x) { return std::sqrt(std::sqrt(std::sqrt(x))); }

    float first_, step_;
    std::size_t intervals_;
};

/// A thin film (thin_film.hpp) whose thickness is in nanometres.
struct FilmOfSurface {
    float ior = 1.33f;
    ValueRange thickness;

    bool operator==(const FilmOfSurface&) const = default;
};

}  // namespace phasetree::tracer
