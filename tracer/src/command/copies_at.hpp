// Which of several objects holds a point: what `eval` and `trace` write beside the phase.
#pragma once

#include <string>
#include <vector>

#include "phasetree/evaluation/evaluator.hpp"
#include "scene/placed.hpp"

namespace phasetree::tracer {

class CopiesAt {
  public:
    /// Refers to the objects.
    explicit CopiesAt(const PlacedObjects&);

    /// ",NAME,NUMBER" of the object and of its copy; of a point of vacuum ",,".
    std::string columns(const glm::vec3& p) const;

  private:
    struct Copy {
        Bounds bounds;
        Transform to_object;
        std::uint32_t object = 0;
    };

    const PlacedObjects& placed_;
    std::vector<Evaluator> evaluators_;  ///< of the objects
    std::vector<Copy> copies_;           ///< by their numbers
};

}  // namespace phasetree::tracer
