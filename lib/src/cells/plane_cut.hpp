#pragma once

#include <algorithm>
#include <cmath>

#include "cells/nearly_linear.hpp"
#include "phasetree/math/bounds.hpp"

namespace phasetree {

/// What a linear bound leaves of boxes:
///     |f(p) − (at_middle + normal·(p − middle))| ≤ slack.
/// Without one the slack is infinite, or not a number, and all is left.
class PlaneCut {
  public:
    PlaneCut() = default;
    /// `margin` is what floats lose.
    PlaneCut(const NearlyLinear& f, const glm::vec3& middle, float margin)
        : middle_(middle),
          at_middle_(static_cast<float>(f.at_centre)),
          slack_(static_cast<float>(f.slack) * (1 + 1e-6f) + margin) {
        for (int i = 0; i < 3; ++i) {
            normal_[i] = static_cast<float>(f.normal[static_cast<std::size_t>(i)]);
            per_slope_[i] = std::abs(normal_[i]) < 1e-3f ? 0 : 1 / std::abs(normal_[i]);
        }
    }

    /// Where f ≤ τ may hold: of each axis what it may, if the others take what they can.
    Bounds below(float tau, const Bounds& box) const { return half_space(1, tau, box); }
    Bounds above(float tau, const Bounds& box) const { return half_space(-1, tau, box); }
    Bounds at(float tau, const Bounds& box) const { return above(tau, below(tau, box)); }

  private:
    /// Where sign · (f − τ) ≤ 0.
    Bounds half_space(float sign, float tau, Bounds box) const {
        if (box.empty() || !(slack_ < 1e30f)) return box;
        const glm::vec3 centre = box.centre(), width = glm::abs(normal_) * (0.5f * box.extent());
        const float takes = width.x + width.y + width.z;
        const float least = sign * (at_middle_ - tau + glm::dot(normal_, centre - middle_)) - slack_;
        if (least > takes) return {};
        if (least <= -takes) return box;
        const glm::vec3 reach = ((takes - least) - width) * per_slope_;
        for (int i = 0; i < 3; ++i) {
            if (per_slope_[i] == 0) continue;
            if ((normal_[i] > 0) == (sign > 0))
                box.high[i] = std::min(box.high[i], centre[i] + reach[i]);
            else
                box.low[i] = std::max(box.low[i], centre[i] - reach[i]);
        }
        return box.empty() ? Bounds() : box;
    }

    glm::vec3 normal_{}, per_slope_{};  ///< 1 / |normal|, 0 where that is too much
    glm::vec3 middle_{};
    float at_middle_ = 0, slack_ = Bounds::infinity;
};

}  // namespace phasetree
