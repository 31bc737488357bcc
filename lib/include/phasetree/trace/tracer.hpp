#pragma once

#include <memory>
#include <optional>
#include <string>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/crossing.hpp"

namespace phasetree {

/// What tracing needs to know of an object beforehand.
struct TraceableObject {
    Bounds bounds;  ///< with a margin of a few resolutions of vacuum
    float resolution = 0;
    /// For people: that coordinates leave few digits, or that the resolution is not the one that was asked for. Mostly
    /// empty.
    std::string warning{};
};
/// Throws ModelError if the object is unbounded or empty, or too far from the origin for its size. For `resolution` see
/// InterfaceTracer.
TraceableObject prepare_to_trace(const Phased& object, float resolution = 0);

/// Traces rays from phase to phase through one object. Immutable; any thread may use it, each with its own Workspace.
class InterfaceTracer {
  public:
    /// `resolution`: nothing thinner along a ray is guaranteed to be seen, nor what is up to 2.75 times as thick and
    /// deeper than a sixteenth of it for no longer than it, nor what a ray within a surface is nowhere deeper in than
    /// that; 0 chooses 2·10⁻⁶ of the object's diagonal or what float coordinates allow far from the origin. Any other
    /// is used as near as possible: no finer than 2.5·10⁻⁷ of the farthest coordinate or the diagonal, no coarser than
    /// a hundredth of the diagonal; resolution() and warning() tell. Throws ModelError if the object is unbounded or
    /// empty, or too far from the origin for its size.
    explicit InterfaceTracer(const Phased& object, float resolution = 0);

    /// The first change of phase at a distance within [t_min, t_max] of the origin; direction of unit length.
    /// `carried` is the phase the ray is in; without it, the label at its start. If the label at the start differs
    /// from the carried phase beyond what rounding explains, that is a crossing at the start.
    std::optional<Crossing> first_crossing(const glm::vec3& origin, const glm::vec3& direction, float t_min,
                                           float t_max, std::optional<Phase> carried, Evaluator::Workspace&,
                                           TraceCounters* = nullptr) const;

    /// Unit normal of a crossing, from `from` into `to`: see CrossingNormal.
    glm::vec3 normal(const Crossing&, const glm::vec3& direction) const;

    /// The phase at a point; vacuum outside the bounds.
    Phase label(const glm::vec3& p, Evaluator::Workspace&) const;

    const Evaluator& evaluator() const { return *evaluator_; }
    /// A box around the object with a margin of a few resolutions of vacuum.
    const Bounds& bounds() const { return bounds_; }
    float resolution() const { return resolution_; }
    /// See TraceableObject.
    const std::string& warning() const { return warning_; }

  private:
    std::shared_ptr<const Evaluator> evaluator_;
    Bounds bounds_;
    float resolution_ = 0;
    std::string warning_;
};

}  // namespace phasetree
