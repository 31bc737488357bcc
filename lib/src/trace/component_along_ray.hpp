#pragma once

#include <vector>

#include "enclosure/enclosure.hpp"
#include "kernel/kernel.hpp"
#include "rewriting/arena.hpp"

namespace phasetree::trace {

/// The component of a ray's phase as a function of the distance t along the ray, bounded over stretches of it. The
/// routine is run with Enclosures (intervals with derivatives) of the single variable t.
class ComponentAlongRay {
  public:
    /// For a search that was left unfinished in the phase RayCrossing::from. The visit's routine must outlive this
    /// object.
    ComponentAlongRay(const kernel::Visit&, const kernel::RayCrossing&);

    /// An upper bound of the component between two distances along the ray; Interval::most if none is known. The caller
    /// does not need a bound that is tighter than `precision`.
    double upper_bound(float t_low, float t_high, double precision);

  private:
    const kernel::Routine& routine_;
    glm::vec3 direction_, origin_;
    const kernel::OutputSlot* output_ = nullptr;  ///< null if the phase is absent
    std::vector<enclosure::Enclosure> registers_;
    rewriting::Arena scratch_;
};

}  // namespace phasetree::trace
