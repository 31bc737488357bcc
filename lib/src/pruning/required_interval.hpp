#pragma once

#include <algorithm>
#include <cmath>

#include "phasetree/math/bounds.hpp"

namespace phasetree::pruning {

/// What a value is wanted for: itself between two numbers, and else which of them it is beyond. If both are a
/// threshold, its sign relative to that; if they are infinite, itself; if nothing is between, nothing.
class RequiredInterval {
  public:
    RequiredInterval() = default;
    /// What is not a number is no bound. It is never nothing that is demanded so.
    RequiredInterval(float least, float most)
        : least_(std::isnan(least) ? -Bounds::infinity : least),
          most_(std::max(least_, std::isnan(most) ? Bounds::infinity : most)) {}
    static RequiredInterval threshold(float tau) { return {tau, tau}; }
    static RequiredInterval value() { return {-Bounds::infinity, Bounds::infinity}; }

    float least() const { return least_; }
    float most() const { return most_; }
    bool is_none() const { return least_ > most_; }
    /// A zero's sign means nothing.
    bool is_sign() const { return least_ == 0 && most_ == 0; }
    /// Both this and another one.
    RequiredInterval with(const RequiredInterval& other) const {
        return between(std::min(least_, other.least_), std::max(most_, other.most_));
    }
    /// No more of it than is below or above a number.
    RequiredInterval below(float most) const { return between(least_, std::max(least_, most < most_ ? most : most_)); }
    RequiredInterval above(float least) const {
        return between(std::min(most_, least > least_ ? least : least_), most_);
    }
    RequiredInterval negated() const { return between(-most_, -least_); }

  private:
    /// Of numbers.
    static RequiredInterval between(float least, float most) {
        RequiredInterval d;
        d.least_ = least;
        d.most_ = most;
        return d;
    }

    float least_ = Bounds::infinity, most_ = -Bounds::infinity;
};

}  // namespace phasetree::pruning
