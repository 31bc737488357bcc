#pragma once

#include <algorithm>
#include <cmath>

#include "phasetree/math/bounds.hpp"

namespace phasetree::pruning {

/// What the users of a value need to know about it: the exact value if it lies in the interval [low, high], and
/// otherwise only on which side of the interval it lies. The interval of a single number τ requires only the sign of v
/// − τ; the infinite interval requires the value itself; the empty interval, which is the default, requires nothing.
class RequiredInterval {
  public:
    RequiredInterval() = default;
    /// A NaN bound counts as infinite. If low > high, the interval consists of `low` alone, so the result is never
    /// empty.
    RequiredInterval(float low, float high)
        : low_(std::isnan(low) ? -Bounds::infinity : low),
          high_(std::max(low_, std::isnan(high) ? Bounds::infinity : high)) {}
    static RequiredInterval threshold(float tau) { return {tau, tau}; }
    static RequiredInterval all() { return {-Bounds::infinity, Bounds::infinity}; }

    float low() const { return low_; }
    float high() const { return high_; }
    bool is_empty() const { return low_ > high_; }
    /// Whether only the sign is needed. Zero counts as either sign.
    bool is_sign() const { return low_ == 0 && high_ == 0; }
    /// The smallest interval that contains both.
    RequiredInterval hull(const RequiredInterval& other) const {
        return unchecked(std::min(low_, other.low_), std::max(high_, other.high_));
    }
    /// The interval without what is above `bound`. Its lower end is always kept, so it is never empty. NaN leaves the
    /// interval unchanged.
    RequiredInterval below(float bound) const { return unchecked(low_, std::max(low_, bound < high_ ? bound : high_)); }
    /// The interval without what is below `bound`. Its upper end is always kept. NaN leaves the interval unchanged.
    RequiredInterval above(float bound) const { return unchecked(std::min(high_, bound > low_ ? bound : low_), high_); }
    RequiredInterval negated() const { return unchecked(-high_, -low_); }

  private:
    /// An interval whose bounds are known not to be NaN.
    static RequiredInterval unchecked(float low, float high) {
        RequiredInterval r;
        r.low_ = low;
        r.high_ = high;
        return r;
    }

    float low_ = Bounds::infinity, high_ = -Bounds::infinity;
};

}  // namespace phasetree::pruning
