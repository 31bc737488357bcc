#pragma once

#include <algorithm>
#include <cmath>

#include "bounding/lane_box.hpp"
#include "bounding/nearly_linear.hpp"

namespace phasetree::bounding {

/// Cuts boxes to where a nearly linear field f can be below, at or above a threshold. f satisfies
///     |f(p) − (at_middle + normal·(p − middle))| ≤ slack.
/// The part of a box in a half-space is bounded along each axis separately: a point is farthest along that axis if its
/// other coordinates lower f as much as they can. If nothing is known about f, the slack is infinite or NaN, and boxes
/// are not cut.
class PlaneCut {
  public:
    PlaneCut() = default;
    /// `margin` bounds the rounding error, as a distance: cut_margin().
    PlaneCut(const NearlyLinear& f, const glm::vec3& middle, float margin)
        : middle_(LaneBox::lanes(middle)),
          at_middle_(static_cast<float>(f.at_centre)),
          slack_(static_cast<float>(f.slack) * (1 + 1e-6f) + margin) {
        const auto slope = [&](std::size_t i) { return static_cast<float>(f.normal[i]); };
        normal_ = Lanes{slope(0), slope(1), slope(2), 0};
        steepness_ = normal_ < 0 ? -normal_ : normal_;
        inverse_ = steepness_ < LaneBox::each(1e-3f) ? Lanes{} : LaneBox::each(1) / normal_;
    }

    /// The smallest box around the part of `box` in which f ≤ τ can hold.
    LaneBox below(float tau, const LaneBox& box) const { return half_space(1, tau, box); }
    LaneBox above(float tau, const LaneBox& box) const { return half_space(-1, tau, box); }
    LaneBox at(float tau, const LaneBox& box) const { return above(tau, below(tau, box)); }

  private:
    using Lanes = LaneBox::Lanes;

    static float sum(const Lanes& v) { return (v[0] + v[1]) + v[2]; }

    /// The smallest box around the part of `box` in which sign · (f − τ) ≤ 0 can hold.
    LaneBox half_space(float sign, float tau, const LaneBox& box) const {
        if (box.empty() || !(slack_ < 1e30f)) return box;
        const Lanes half = LaneBox::each(0.5f), centre = (box.low + box.high) * half;
        const Lanes change = steepness_ * ((box.high - box.low) * half);
        const float largest_change = sum(change);  // of f from the box's centre
        const float least_at_centre = sign * (at_middle_ - tau + sum(normal_ * (centre - middle_))) - slack_;
        if (least_at_centre > largest_change) return {};
        if (least_at_centre <= -largest_change) return box;
        const Lanes inverse = LaneBox::each(sign) * inverse_;
        const Lanes farthest = centre + (LaneBox::each(largest_change - least_at_centre) - change) * inverse;
        const LaneBox rest{(inverse < 0 && farthest > box.low) ? farthest : box.low,
                           (inverse > 0 && farthest < box.high) ? farthest : box.high};
        return rest.empty() ? LaneBox() : rest;
    }

    Lanes normal_{}, steepness_{};  ///< the normal and its absolute values
    Lanes inverse_{};               ///< the reciprocals of the normal; 0 along axes on which f hardly depends
    Lanes middle_{};
    float at_middle_ = 0, slack_ = Bounds::infinity;
};

}  // namespace phasetree::bounding
