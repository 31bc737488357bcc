#pragma once

#include <cmath>
#include <glm/geometric.hpp>

#include "evaluation/component.hpp"
#include "phasetree/model/crossing.hpp"

namespace phasetree::trace {

using evaluation::Component;

/// The normal of a crossing, from the gradients of the components (the signed distances of phases, negative inside) on
/// its two sides.
///
/// At the bracket's ends, components are usually half a resolution from zero. Sometimes they are zero up to rounding
/// errors, where the gradient is meaningless. For example, if all that rounding leaves of x and of z is one ulp or
/// zero, the gradient of √(x² + z²) is along an axis or a diagonal, whatever the true direction, and zero if both are
/// zero. Near an edge, the gradient may be that of a face that the ray does not cross. So a gradient is accepted only
/// if it agrees with the component's value: a plane with this normal and distance must cross the ray within the
/// bracket. If the gradient at the near end does not, others are tried, in this order:
///  * a resolution before the bracket on the ray;
///  * a resolution from the near end into `from`: opposite to the normal found by the previous point, then opposite to
///    the near end's own normal;
///  * the far end; a resolution beyond it on the ray; and a resolution from the far end into `to`, along the normal
///    found by the previous point;
///  * two resolutions from each end in both directions of each coordinate axis, taking the point deepest in its phase.
/// If none agrees, the normal with the smallest angle to the ray is taken.
///
/// `component(p, phase)` returns a component and its gradient, and `holds(p)` says whether it is valid at p.
template <class ComponentAt, class Holds>
class NormalOf {
  public:
    NormalOf(const Crossing& c, const glm::vec3& direction, float resolution, const ComponentAt& component,
             const Holds& holds)
        : c_(c),
          direction_(direction),
          resolution_(resolution),
          width_(glm::dot(c.p_to - c.p_from, direction)),
          component_(component),
          holds_(holds) {}

    CrossingNormal operator()() const {
        const Sample s = sample(near_side, glm::vec3(0));
        if (s.is_sound && s.cosine > 0) [[likely]]
            return {s.normal, s.steepness * s.normal};
        const glm::vec3 found = sought(s);
        // If the near end's normal is nearly the one found, use it, because the ray is reflected at the near end.
        return {along_the_ray(glm::dot(s.normal, found) > 0.9999f ? s.normal : found)};
    }

  private:
    /// The side of the crossing on which a component is evaluated. On the near side, it is the component of `from`,
    /// which increases along the normal; on the far side, that of `to`, which decreases.
    enum Side { near_side, far_side };
    /// The smallest accepted cosine between a normal and the ray. It is negative, because a ray that creeps along an
    /// interface, where rounding errors determine its label, may cross it slightly against its normal.
    static constexpr float least_cosine = -0.1f;

    struct Sample {
        glm::vec3 normal{0};
        float steepness = 0;    ///< the gradient's length
        float depth = 0;        ///< how far the component is below zero
        float cosine = -2;      ///< between the normal and the ray; below −1 if there is no normal
        bool is_sound = false;  ///< whether the gradient agrees with the value
    };

    /// The component of a side at an offset from that end of the bracket. It is sound under two conditions: the
    /// component, divided by the length of its gradient, is below zero by at least the rounding error, and the plane
    /// given by this value and gradient crosses the ray within the bracket, up to rounding errors.
    Sample sample(Side side, const glm::vec3& away) const {
        const bool is_near = side == near_side;
        const Component c = component_((is_near ? c_.p_from : c_.p_to) + away, is_near ? c_.from : c_.to);
        Sample s;
        s.steepness = glm::length(c.gradient);
        if (!(s.steepness > 0)) return s;
        s.normal = c.gradient * ((is_near ? 1 : -1) / s.steepness);
        s.cosine = glm::dot(s.normal, direction_);
        s.depth = -c.value / s.steepness;
        // The gradient is wrong more often at an end of the bracket, so its plane must agree more closely there. The
        // required depth is smaller, because an end is usually only half a resolution deep.
        const bool is_end = away == glm::vec3(0);
        const float rounding_error = (is_end ? 1.f / 16 : 1.f / 8) * resolution_, across = glm::dot(s.normal, away);
        // The sample's plane puts this end of the bracket at depth_at_end. This depth would be 0 if the plane crossed
        // the ray exactly at this end, and bracket_depth if it crossed it exactly at the other.
        const float depth_at_end = s.depth + (is_near ? across : -across), bracket_depth = width_ * s.cosine;
        s.is_sound = s.depth >= rounding_error && depth_at_end >= std::min(bracket_depth, 0.f) - rounding_error &&
                     depth_at_end <= std::max(bracket_depth, 0.f) + rounding_error;
        return s;
    }

    /// Finds a normal if the gradient at the near end is not sound.
    glm::vec3 sought(const Sample& near) const {
        Sample best = near;
        // Accepts a sample and returns true if it is sound. Otherwise, keeps it if it points more along the ray.
        const auto take = [&](const Sample& s) {
            if (s.is_sound && s.cosine > least_cosine) {
                best = s;
                return true;
            }
            if (s.cosine > best.cosine) best = s;
            return false;
        };
        const auto at = [&](Side side, const glm::vec3& away) {
            const bool is_held = holds_((side == near_side ? c_.p_from : c_.p_to) + away);
            return is_held ? sample(side, away) : Sample();
        };
        const float offset = resolution_;
        // The sample a resolution from that side's end, straight into its phase along the normal of s.
        const auto aside = [&](Side side, const Sample& s) {
            return at(side, (side == near_side ? -offset : offset) * s.normal);
        };
        if (take(near)) return best.normal;
        const Sample before = at(near_side, -offset * direction_);
        if (take(before) || take(aside(near_side, before)) || take(aside(near_side, near))) return best.normal;
        const Sample at_far_end = at(far_side, glm::vec3(0)), beyond = at(far_side, offset * direction_);
        if (take(at_far_end) || take(beyond) || take(aside(far_side, beyond))) return best.normal;

        // None of these is sound. Take the deepest of the sound ones along the coordinate axes.
        Sample deepest;
        for (const Side side : {near_side, far_side})
            for (int i = 0; i < 6; ++i) {
                glm::vec3 away(0);
                away[i / 2] = i % 2 == 0 ? 2 * offset : -2 * offset;
                const Sample s = at(side, away);
                if (take(s) && s.depth > deepest.depth) deepest = s;
            }
        return deepest.is_sound ? deepest.normal : best.normal;
    }

    /// Makes a normal point along the ray. A normal that fails to do so because of rounding errors is rotated as little
    /// as needed. One that clearly points back belongs to the opposite face of something thin, and is reversed.
    glm::vec3 along_the_ray(const glm::vec3& n) const {
        const float cosine = glm::dot(n, direction_);
        if (cosine > 0) return n;
        if (n == glm::vec3(0)) return direction_;  // no gradient was found
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
