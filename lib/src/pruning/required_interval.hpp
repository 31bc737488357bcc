#pragma once

#include <algorithm>
#include <cmath>

#include "phasetree/math/bounds.hpp"

namespace phasetree::pruning {

/// What the users of a value need to know of it: its exact value where that lies in the interval [low, high], and
/// otherwise only on which side of the interval it lies. An interval of one number τ asks for the sign of v − τ alone,
/// the infinite interval for the value itself; the empty interval, which is the default, asks for nothing.
class RequiredInterval {
  public:
    RequiredInterval() = default;
    /// A bound that is NaN counts as infinite. An interval whose bounds are exchanged is that of `low` alone, so the
    /// result is never empty.
    RequiredInterval(float low, float high)
        : low_(std::isnan(low) ? -Bounds::infinity : low),
          high_(std::max(low_, std::isnan(high) ? Bounds::infinity : high)) {}
    static RequiredInterval threshold(float tau) { return {tau, tau}; }
    static RequiredInterval all() { return {-Bounds::infinity, Bounds::infinity}; }

    float low() const { return low_; }
    float high() const { return high_; }
    bool is_empty() const { return low_ > high_; }
    /// Whether only the sign is needed. A value of zero may be taken for either sign.
    bool is_sign() const { return low_ == 0 && high_ == 0; }
    /// The smallest interval around both.
    RequiredInterval hull(const RequiredInterval& other) const {
        return unchecked(std::min(low_, other.low_), std::max(high_, other.high_));
    }
    /// The part below a number, but at least the lower bound; nothing changes if the number is NaN.
    RequiredInterval below(float bound) const { return unchecked(low_, std::max(low_, bound < high_ ? bound : high_)); }
    /// The part above a number, but at least the upper bound.
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
