// Finds which of several objects contains a point, for the columns that `eval` and `trace` write next to the phase.
#pragma once

#include <string>
#include <vector>

#include "phasetree/evaluation/evaluator.hpp"
#include "scene/placed.hpp"

namespace phasetree::tracer {

class CopiesAt {
  public:
    /// Keeps a reference to the objects.
    explicit CopiesAt(const PlacedObjects&);

    /// ",NAME,NUMBER" of the object and its copy; ",," for a point in the vacuum.
    std::string columns(const glm::vec3& p) const;

  private:
    struct Copy {
        Bounds bounds;
        Transform to_object;
        std::uint32_t object = 0;
    };

    const PlacedObjects& placed_;
    std::vector<Evaluator> evaluators_;  ///< one per object
    std::vector<Copy> copies_;           ///< indexed by copy number
};

}  // namespace phasetree::tracer
