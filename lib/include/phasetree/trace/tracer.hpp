#pragma once

#include <memory>
#include <optional>

#include "phasetree/program/evaluator.hpp"

namespace phasetree {

/// A change of phase along a ray, as a bracket: the label is certified at both ends, and nothing that is thicker than
/// the resolution lies between. A reflected ray starts at p_in and stays in `from`, a refracted one at p_out in `to`;
/// no offset along a normal, no second evaluation, no self-hit.
struct Crossing {
    float t_in = 0;  ///< distances from the ray's origin
    float t_out = 0;
    glm::vec3 p_in{0};  ///< the very points that were evaluated
    glm::vec3 p_out{0};
    Phase from;
    Phase to;
};

/// What tracing cost, for --stats.
struct TraceCounters {
    std::uint64_t rays = 0;
    std::uint64_t batches = 0;   ///< evaluations of sixteen points
    std::uint64_t phantoms = 0;  ///< steps by the resolution that met no change of label
};

/// Traces rays from phase to phase through one object. Immutable; any thread may use it, each with its own Workspace.
class InterfaceTracer {
  public:
    /// `resolution`: nothing thinner along a ray is guaranteed to be seen; 0 chooses 2·10⁻⁶ of the object's diagonal
    /// or what float coordinates allow where the object is far from the origin.
    /// Throws ModelError if the object is unbounded or empty.
    explicit InterfaceTracer(const Phased& object, float resolution = 0);

    /// The first change of phase at a distance within [t_min, t_max] of the origin; direction of unit length.
    /// `carried` is the phase the ray is in; without it, the label at its start. If the label at the start differs
    /// from the carried phase beyond what rounding explains, that is a crossing at the start.
    std::optional<Crossing> first_crossing(const glm::vec3& origin, const glm::vec3& direction, float t_min,
                                           float t_max, std::optional<Phase> carried, Evaluator::Workspace&,
                                           TraceCounters* = nullptr) const;

    /// Unit normal of a crossing, from `from` into `to`.
    glm::vec3 normal(const Crossing&, const glm::vec3& direction) const;

    /// The phase at a point; vacuum outside the bounds.
    Phase label(const glm::vec3& p, Evaluator::Workspace&) const;

    const Evaluator& evaluator() const { return *evaluator_; }
    /// A box around the object with a margin of a few resolutions of vacuum.
    const Bounds& bounds() const { return bounds_; }
    float resolution() const { return resolution_; }

  private:
    std::shared_ptr<const Evaluator> evaluator_;
    Bounds bounds_;
    float resolution_ = 0;
};

}  // namespace phasetree
