#pragma once

#include <algorithm>
#include <cmath>

#include "bounding/lane_box.hpp"
#include "bounding/nearly_linear.hpp"

namespace phasetree::bounding {

/// What a linear bound leaves of boxes:
///     |f(p) − (at_middle + normal·(p − middle))| ≤ slack.
/// Without one the slack is infinite, or not a number, and all is left.
class PlaneCut {
  public:
    PlaneCut() = default;
    /// `margin` is what floats lose.
    PlaneCut(const NearlyLinear& f, const glm::vec3& middle, float margin)
        : middle_(LaneBox::lanes(middle)),
          at_middle_(static_cast<float>(f.at_centre)),
          slack_(static_cast<float>(f.slack) * (1 + 1e-6f) + margin) {
        const auto slope = [&](std::size_t i) { return static_cast<float>(f.normal[i]); };
        normal_ = Lanes{slope(0), slope(1), slope(2), 0};
        steep_ = normal_ < 0 ? -normal_ : normal_;
        per_slope_ = steep_ < LaneBox::each(1e-3f) ? Lanes{} : LaneBox::each(1) / normal_;
    }

    /// Where f ≤ τ may hold: of each axis what it may, if the others take what they can.
    LaneBox below(float tau, const LaneBox& box) const { return half_space(1, tau, box); }
    LaneBox above(float tau, const LaneBox& box) const { return half_space(-1, tau, box); }
    LaneBox at(float tau, const LaneBox& box) const { return above(tau, below(tau, box)); }

  private:
    using Lanes = LaneBox::Lanes;

    static float sum(const Lanes& v) { return (v[0] + v[1]) + v[2]; }

    /// Where sign · (f − τ) ≤ 0.
    LaneBox half_space(float sign, float tau, const LaneBox& box) const {
        if (box.empty() || !(slack_ < 1e30f)) return box;
        const Lanes half = LaneBox::each(0.5f), centre = (box.low + box.high) * half;
        const Lanes width = steep_ * ((box.high - box.low) * half);
        const float takes = sum(width);
        const float least = sign * (at_middle_ - tau + sum(normal_ * (centre - middle_))) - slack_;
        if (least > takes) return {};
        if (least <= -takes) return box;
        const Lanes per_slope = LaneBox::each(sign) * per_slope_;
        const Lanes farthest = centre + (LaneBox::each(takes - least) - width) * per_slope;
        const LaneBox left{(per_slope < 0 && farthest > box.low) ? farthest : box.low,
                           (per_slope > 0 && farthest < box.high) ? farthest : box.high};
        return left.empty() ? LaneBox() : left;
    }

    Lanes normal_{}, steep_{};  ///< and its absolute values
    Lanes per_slope_{};         ///< its reciprocals, 0 where they are too large
    Lanes middle_{};
    float at_middle_ = 0, slack_ = Bounds::infinity;
};

}  // namespace phasetree::bounding
