#pragma once

#include <cmath>
#include <glm/geometric.hpp>

#include "evaluation/component.hpp"
#include "phasetree/model/crossing.hpp"

namespace phasetree::trace {

using evaluation::Component;

/// The normal of a crossing, from the gradients of the components on its two sides.
///
/// At the bracket's ends components are mostly half a resolution from zero, and sometimes zero to rounding. There a
/// gradient may be of anything: a distance √(x² + z²) of coordinates that are an ulp each points along an axis, one of
/// zeros nowhere; and by an edge it may be a face's that the ray does not cross. So a gradient is believed if the
/// component's value is what it says: that of a plane which the ray crosses within the bracket. If the one at the near
/// end is not, it is sought before the bracket, aside, away from the interface, and on its other side.
///
/// `component(p, phase)` gives a component, and `holds(p)` tells whether it can at that point.
template <class ComponentAt, class Holds>
class NormalOf {
  public:
    NormalOf(const Crossing& c, const glm::vec3& direction, float resolution, const ComponentAt& component,
             const Holds& holds)
        : c_(c),
          direction_(direction),
          resolution_(resolution),
          width_(glm::dot(c.p_out - c.p_in, direction)),
          component_(component),
          holds_(holds) {}

    CrossingNormal operator()() const {
        const Sample s = sample(near_side, glm::vec3(0));
        if (s.is_sound && s.cosine > 0) [[likely]]
            return {s.normal, s.steepness * s.normal};
        const glm::vec3 found = sought(s);
        // Of two that agree the near end's, which is where the ray is reflected.
        return {along_the_ray(glm::dot(s.normal, found) > 0.9999f ? s.normal : found)};
    }

  private:
    /// Where a component is asked for: `from` about the near end, where it grows along the normal, or `to` about the
    /// far end, where it falls.
    enum Side { near_side, far_side };
    /// A ray that creeps along an interface, where its label is a matter of rounding, may cross it against its normal
    /// by so little.
    static constexpr float least_cosine = -0.1f;

    struct Sample {
        glm::vec3 normal{0};
        float steepness = 0;  ///< the gradient's length
        float depth = 0;      ///< how far the component is below zero
        float cosine = -2;    ///< of the normal to the ray; less than any if there is no normal
        bool is_sound = false;
    };

    /// The component of a side, so far away from that end of the bracket. It is sound if a field of this slope that is
    /// zero within the bracket has the value, but for rounding, and if it is farther from zero than that.
    Sample sample(Side side, const glm::vec3& away) const {
        const bool is_near = side == near_side;
        const Component c = component_((is_near ? c_.p_in : c_.p_out) + away, is_near ? c_.from : c_.to);
        Sample s;
        s.steepness = glm::length(c.gradient);
        if (!(s.steepness > 0)) return s;
        s.normal = c.gradient * ((is_near ? 1 : -1) / s.steepness);
        s.cosine = glm::dot(s.normal, direction_);
        s.depth = -c.value / s.steepness;
        // What is asked for at an end of the bracket must be all the more certain.
        const bool is_end = away == glm::vec3(0);
        const float rounding = (is_end ? 1.f / 16 : 1.f / 8) * resolution_, across = glm::dot(s.normal, away);
        const float at_end = s.depth + (is_near ? across : -across), most = width_ * s.cosine;
        s.is_sound =
            s.depth >= rounding && at_end >= std::min(most, 0.f) - rounding && at_end <= std::max(most, 0.f) + rounding;
        return s;
    }

    /// Where the near end does not tell.
    glm::vec3 sought(const Sample& near) const {
        Sample best = near;
        const auto is_found = [&](const Sample& s) {
            if (s.is_sound && s.cosine > least_cosine) {
                best = s;
                return true;
            }
            if (s.cosine > best.cosine) best = s;
            return false;
        };
        const auto at = [&](Side side, const glm::vec3& away) {
            const bool is_held = holds_((side == near_side ? c_.p_in : c_.p_out) + away);
            return is_held ? sample(side, away) : Sample();
        };
        const float far = resolution_;
        const auto aside = [&](Side side, const Sample& s) {
            return at(side, (side == near_side ? -far : far) * s.normal);
        };
        if (is_found(near)) return best.normal;
        const Sample before = at(near_side, -far * direction_);
        if (is_found(before) || is_found(aside(near_side, before)) || is_found(aside(near_side, near)))
            return best.normal;
        const Sample beyond = at(far_side, glm::vec3(0)), behind = at(far_side, far * direction_);
        if (is_found(beyond) || is_found(behind) || is_found(aside(far_side, behind))) return best.normal;

        // Not where either's gradient leads: then all around, as deep as can be.
        Sample deepest;
        for (const Side side : {near_side, far_side})
            for (int i = 0; i < 6; ++i) {
                glm::vec3 away(0);
                away[i / 2] = i % 2 == 0 ? 2 * far : -2 * far;
                const Sample s = at(side, away);
                if (is_found(s) && s.depth > deepest.depth) deepest = s;
            }
        return deepest.is_sound ? deepest.normal : best.normal;
    }

    /// Normals point along the ray. One that does not by rounding is turned by as little as that takes; one that points
    /// back is of the other face of something thin.
    glm::vec3 along_the_ray(const glm::vec3& n) const {
        const float cosine = glm::dot(n, direction_);
        if (cosine > 0) return n;
        if (n == glm::vec3(0)) return direction_;  // nothing around has a gradient
        if (cosine < least_cosine) return -n;
        return glm::normalize(n + (1e-6f - cosine) * direction_);
    }

    const Crossing& c_;
    const glm::vec3& direction_;
    float resolution_;
    float width_;
    const ComponentAt& component_;
    const Holds& holds_;
};

}  // namespace phasetree::trace
