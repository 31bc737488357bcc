#pragma once

#include <memory>
#include <optional>
#include <string>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/math/convex_polyhedron.hpp"
#include "phasetree/model/crossing.hpp"

namespace phasetree {

/// The bounds and the resolution with which an object is traced.
struct TraceableObject {
    Bounds bounds;         ///< of the object, with a margin of a few resolutions of vacuum
    float resolution = 0;  ///< in the scene's unit of length
    /// A sentence for people, mostly empty: that coordinates leave few digits, or that the resolution is not the one
    /// that was asked for.
    std::string warning{};
};
/// Finds the bounds of an object and the resolution at which it is traced. For the parameter `resolution` and the
/// errors see InterfaceTracer.
TraceableObject prepare_to_trace(const Phased& object, float resolution = 0);

/// Traces rays from phase to phase through one object, by the program of the whole object. (InterfaceCells finds the
/// same crossings faster.) It is immutable; any thread may use it, each with a Workspace of its own.
class InterfaceTracer {
  public:
    /// `resolution`, in the scene's unit of length, is the thickness of a phase along a ray that is certain to be
    /// found. What is thinner may be passed. So may a phase that is up to 2.75 resolutions thick, if it is deeper than
    /// a sixteenth of a resolution for at most one of them, and a phase in which a ray along its surface is nowhere
    /// deeper than that.
    ///
    /// 0 chooses 2·10⁻⁶ of the object's diagonal, or what float coordinates allow far from the origin. Any other value
    /// is limited: it is no finer than 2.5·10⁻⁷ of the farthest coordinate or of the diagonal, and no coarser than a
    /// hundredth of the diagonal; resolution() and warning() tell what is used.
    ///
    /// Throws ModelError if the object is unbounded or empty, or too far from the origin for its size.
    explicit InterfaceTracer(const Phased& object, float resolution = 0);
    /// The same with half-spaces that all contain all of the object that is not vacuum, as carve() gives them: what of
    /// a ray is outside of them costs no evaluation. Crossings are the same, up to the resolution.
    InterfaceTracer(const Phased& object, std::vector<HalfSpace> around, float resolution = 0);

    /// The first change of phase along a ray, at a distance from the origin within [t_min, t_max]; nothing if there is
    /// none. The direction must be of unit length. `carried` is the phase that the ray is in; without it, that is the
    /// label at the start. If the label at the start differs from the carried phase by more than rounding explains,
    /// there is a crossing at the start. The counters, if there are any, are added to.
    std::optional<Crossing> first_crossing(const glm::vec3& origin, const glm::vec3& direction, float t_min,
                                           float t_max, std::optional<Phase> carried, Evaluator::Workspace&,
                                           TraceCounters* = nullptr) const;

    /// The unit normal of a crossing, which leads from `from` into `to`: see CrossingNormal.
    glm::vec3 normal(const Crossing&, const glm::vec3& direction) const;

    /// The phase at a point; the vacuum outside of bounds().
    Phase label(const glm::vec3& p, Evaluator::Workspace&) const;

    const Evaluator& evaluator() const { return *evaluator_; }
    /// A box around the object with a margin of a few resolutions of vacuum.
    const Bounds& bounds() const { return bounds_; }
    float resolution() const { return resolution_; }
    /// A sentence for people, mostly empty: see TraceableObject.
    const std::string& warning() const { return warning_; }

  private:
    std::shared_ptr<const Evaluator> evaluator_;
    Bounds bounds_;
    float resolution_ = 0;
    std::string warning_;
    std::vector<HalfSpace> around_;
};

}  // namespace phasetree
