#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "enclosure/enclosure.hpp"
#include "kernel/kernel.hpp"
#include "rewriting/arena.hpp"

namespace phasetree::trace {

/// The component of a ray's phase (the signed distance of that phase, negative inside it) as a function of the distance
/// t along the ray, bounded over stretches of it. The routine is run with Enclosures (intervals with derivatives) of
/// the single variable t.
class ComponentAlongRay {
  public:
    /// The ray starts at `origin`; `phase` is the one that it is in, as in OutputSlot. The routine must outlive this
    /// object.
    ComponentAlongRay(const kernel::Routine&, const glm::dvec3& origin, const glm::dvec3& direction, float phase);

    /// An upper bound on the component between two distances along the ray; Interval::most, which stands for
    /// "unbounded", if none is known. The caller does not need a bound that is tighter than `precision`.
    double upper_bound(double t_low, double t_high, double precision);

  private:
    bool run(double t_low, double t_high, double precision, std::vector<double>* centres);

    friend std::vector<double> centres_at(const kernel::Routine&, const glm::dvec3&);

    const kernel::Routine& routine_;
    glm::dvec3 direction_, origin_;
    const kernel::OutputSlot* output_ = nullptr;  ///< null if the phase is absent
    std::vector<enclosure::Enclosure> registers_;
    rewriting::Arena scratch_;
};

/// The values that the steps of a routine compute at a point with the arithmetic of Enclosure: the centres of the
/// enclosures, in the order of the steps. A step that computes a point contributes three numbers.
std::vector<double> centres_at(const kernel::Routine&, const glm::dvec3&);

}  // namespace phasetree::trace
